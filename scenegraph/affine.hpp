#pragma once
// The matrices of the scene graph: affine maps that may scale, shear and mirror.
#include <Eigen/Geometry>
#include <array>

namespace pantin {

using Vector3 = Eigen::Vector3d;
using Matrix3 = Eigen::Matrix3d;
using Quaternion = Eigen::Quaterniond;  ///< (w, x, y, z) in constructors and text

/// M_PN: maps coordinates of N to coordinates of P, p_P = M_PN * p_N. Column vectors.
using Affine = Eigen::Affine3d;

/// The upper three rows of an affine matrix, row-major: how the scene stores locals and worlds.
struct Matrix34 {
  std::array<double, 12> m{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};

  static Matrix34 from(const Affine& M);
  [[nodiscard]] Affine affine() const;
  /// No entry is infinite or not a number.
  [[nodiscard]] bool is_finite() const noexcept {
    // 0 times a finite number is 0 and times any other is none; four sums at once, without a branch.
    std::array<double, 4> zeros{};
    for (std::size_t row = 0; row < 12; row += 4)
      for (std::size_t column = 0; column < 4; ++column) zeros[column] += 0 * m[row + column];
    return (zeros[0] + zeros[1]) + (zeros[2] + zeros[3]) == 0;
  }
  friend bool operator==(const Matrix34&, const Matrix34&) = default;
};

}  // namespace pantin

#pragma once
// Seeded random affine matrices that scale, shear and mirror, but never nearly singular.
#include <random>

#include <pantin/scenegraph/affine.hpp>

namespace pantin::test {

inline double uniform(std::mt19937_64& random, double low, double high) {
  return std::uniform_real_distribution<double>{low, high}(random);
}

inline std::size_t pick(std::mt19937_64& random, std::size_t count) {
  return std::uniform_int_distribution<std::size_t>{0, count - 1}(random);
}

inline Quaternion random_rotation(std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  Quaternion q{normal(random), normal(random), normal(random), normal(random)};
  return q.normalized();
}

inline Vector3 random_vector(std::mt19937_64& random) {
  return {uniform(random, -1, 1), uniform(random, -1, 1), uniform(random, -1, 1)};
}

/// Rotation times scales of 0.6 .. 1.6, of any sign, times shears up to 0.4; translation within +-1.
inline Affine random_affine(std::mt19937_64& random) {
  Matrix3 shear = Matrix3::Identity();
  Vector3 scale;
  for (int i = 0; i < 3; ++i) {
    scale[i] = uniform(random, 0.6, 1.6) * (pick(random, 4) == 0 ? -1 : 1);
    for (int j = i + 1; j < 3; ++j) shear(i, j) = uniform(random, -0.4, 0.4);
  }
  Affine M = Affine::Identity();
  M.linear() = random_rotation(random).toRotationMatrix() * scale.asDiagonal() * shear;
  M.translation() = random_vector(random);
  return M;
}

/// Greatest difference of entries over the greatest entry of `expected` (or 1 if that is smaller).
inline double relative_error(const Affine& actual, const Affine& expected) {
  return (actual.affine() - expected.affine()).cwiseAbs().maxCoeff() /
         std::max(1.0, expected.affine().cwiseAbs().maxCoeff());
}

}  // namespace pantin::test

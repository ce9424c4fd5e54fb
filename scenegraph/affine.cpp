#include <pantin/scenegraph/affine.hpp>

namespace pantin {

Matrix34 Matrix34::from(const Affine& M) {
  Matrix34 out;
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 4; ++column)
      out.m[static_cast<std::size_t>(4 * row + column)] = M(row, column);
  return out;
}

Affine Matrix34::affine() const {
  Affine M = Affine::Identity();
  M.affine() = Eigen::Map<const Eigen::Matrix<double, 3, 4, Eigen::RowMajor>>(m.data());
  return M;
}

}  // namespace pantin

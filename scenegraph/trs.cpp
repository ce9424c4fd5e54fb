#include <cmath>

#include <pantin/scenegraph/rotation.hpp>
#include <pantin/scenegraph/trs.hpp>

namespace pantin {
namespace {

constexpr double kShearTolerance = 1e-6;  // |cosine| between columns; float matrices have about 1e-7

/// Gives columns that are 0 a direction, so that all three are orthonormal to round-off.
void complete(Matrix3& directions, const Vector3& lengths) {
  for (int i = 0; i < 3; ++i) {
    if (lengths[i] > 0) continue;
    const int j = (i + 1) % 3;
    const int k = (i + 2) % 3;
    const Vector3 a = directions.col(j);
    const Vector3 b = directions.col(k);
    if (!a.isZero(0) && !b.isZero(0)) directions.col(i) = a.cross(b).normalized();
    else if (!a.isZero(0)) directions.col(i) = a.unitOrthogonal();
    else if (!b.isZero(0)) directions.col(i) = b.unitOrthogonal();
    else directions.col(i) = Vector3::Unit(i);
  }
}

}  // namespace

std::optional<Trs> decompose(const Affine& M) {
  Trs out;
  out.translation = M.translation();
  out.scale = M.linear().colwise().stableNorm();
  Matrix3 directions = Matrix3::Zero();
  for (int i = 0; i < 3; ++i)
    if (out.scale[i] > 0) directions.col(i) = M.linear().col(i) / out.scale[i];
  for (int i = 0; i < 3; ++i)
    if (std::abs(directions.col(i).dot(directions.col((i + 1) % 3))) > kShearTolerance) return std::nullopt;
  complete(directions, out.scale);
  if (directions.determinant() < 0) {
    out.scale.x() = -out.scale.x();
    directions.col(0) = -directions.col(0);
  }
  out.rotation = nearest_rotation(directions);
  return out;
}

}  // namespace pantin

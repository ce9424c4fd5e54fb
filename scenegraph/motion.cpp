// The rotation matrix of a unit quaternion is a quadratic form, R(q) = B(q, q) with B bilinear and symmetric,
// so
//   R' = 2 B(q, q'),   R'' = 2 B(q', q') + 2 B(q, q'').
// About a fixed axis k, K its cross product matrix: R' = a' K R,  R'' = (a'' K + a'^2 K K) R.
#include <pantin/scenegraph/motion.hpp>

namespace pantin {
namespace {

using Vector4 = Eigen::Vector4d;

struct VectorMotion {
  Vector3 value{Vector3::Zero()};
  Vector3 first{Vector3::Zero()};
  Vector3 second{Vector3::Zero()};
};

struct RotationMotion {
  Matrix3 value{Matrix3::Identity()};
  Matrix3 first{Matrix3::Zero()};
  Matrix3 second{Matrix3::Zero()};
};

/// B(a, b), quaternions as (w, x, y, z).
Matrix3 rotation_form(const Vector4& a, const Vector4& b) {
  const Eigen::Matrix4d p =
      (a * b.transpose() + b * a.transpose()) / 2;  // p(i, j): the product of entries i and j
  Matrix3 B;
  B << p(0, 0) + p(1, 1) - p(2, 2) - p(3, 3), 2 * (p(1, 2) - p(0, 3)), 2 * (p(1, 3) + p(0, 2)),  //
      2 * (p(1, 2) + p(0, 3)), p(0, 0) - p(1, 1) + p(2, 2) - p(3, 3), 2 * (p(2, 3) - p(0, 1)),   //
      2 * (p(1, 3) - p(0, 2)), 2 * (p(2, 3) + p(0, 1)), p(0, 0) - p(1, 1) - p(2, 2) + p(3, 3);
  return B;
}

RotationMotion rotation_at(const TrackSample& sample, std::size_t first) {
  const Eigen::Map<const Vector4> q{sample.value.data() + first};
  const Eigen::Map<const Vector4> q1{sample.first.data() + first};
  const Eigen::Map<const Vector4> q2{sample.second.data() + first};
  return {rotation_form(q, q), 2 * rotation_form(q, q1),
          2 * rotation_form(q1, q1) + 2 * rotation_form(q, q2)};
}

VectorMotion vector_at(const TrackSample& sample) {
  return {Vector3{sample.value.data()}, Vector3{sample.first.data()}, Vector3{sample.second.data()}};
}

/// Rotation about a fixed axis by the sample's number at `i`.
RotationMotion pivot_at(const Vector3& axis, const TrackSample& sample, std::size_t i) {
  RotationMotion R;
  R.value = Eigen::AngleAxisd{sample.value[i], axis}.toRotationMatrix();
  Matrix3 K;
  K << 0, -axis.z(), axis.y(), axis.z(), 0, -axis.x(), -axis.y(), axis.x(), 0;
  const double rate = sample.first[i];
  R.first = rate * K * R.value;
  R.second = (sample.second[i] * K + rate * rate * K * K) * R.value;
  return R;
}

/// Translation along a fixed direction by the sample's number at `i`.
VectorMotion slide_at(const Vector3& direction, const TrackSample& sample, std::size_t i) {
  return {sample.value[i] * direction, sample.first[i] * direction, sample.second[i] * direction};
}

VectorMotion operator+(const VectorMotion& a, const VectorMotion& b) {
  return {a.value + b.value, a.first + b.first, a.second + b.second};
}

RotationMotion operator*(const RotationMotion& a, const RotationMotion& b) {
  return {a.value * b.value, a.first * b.value + a.value * b.first,
          a.second * b.value + 2 * a.first * b.first + a.value * b.second};
}

/// M_PJ * [R t; 0 0] * M_JN for a derivative of T, whose lower row is 0.
Eigen::Matrix<double, 3, 4> between(const Link& link, const Matrix3& R, const Vector3& t) {
  Eigen::Matrix<double, 3, 4> out;
  out.leftCols<3>() = link.M_PJ.linear() * R * link.M_JN.linear();
  out.col(3) = link.M_PJ.linear() * (R * link.M_JN.translation() + t);
  return out;
}

}  // namespace

LocalMotion trs_motion(const Trs& rest, const TrsSamples& samples) {
  VectorMotion T{.value = rest.translation};
  RotationMotion R{.value = rest.rotation.toRotationMatrix()};
  VectorMotion S{.value = rest.scale};
  if (samples.translation) T = vector_at(*samples.translation);
  if (samples.rotation) R = rotation_at(*samples.rotation, 0);
  if (samples.scale) S = vector_at(*samples.scale);
  LocalMotion M;
  M.value.leftCols<3>() = R.value * S.value.asDiagonal();
  M.first.leftCols<3>() = R.first * S.value.asDiagonal();
  M.first.leftCols<3>() += R.value * S.first.asDiagonal();
  M.second.leftCols<3>() = R.second * S.value.asDiagonal();
  M.second.leftCols<3>() += 2 * (R.first * S.first.asDiagonal());
  M.second.leftCols<3>() += R.value * S.second.asDiagonal();
  M.value.col(3) = T.value;
  M.first.col(3) = T.first;
  M.second.col(3) = T.second;
  return M;
}

LocalMotion link_motion(const Link& link, const TrackSample& sample) {
  RotationMotion R;
  VectorMotion t;
  switch (link.kind) {
    case LinkKind::Fixed:
      break;
    case LinkKind::Pivot:
      R = pivot_at(link.axis, sample, 0);
      break;
    case LinkKind::Slider:
      t = slide_at(link.axis, sample, 0);
      break;
    case LinkKind::Ball:
      R = rotation_at(sample, 0);
      break;
    case LinkKind::Cylindrical:
      R = pivot_at(link.axis, sample, 0);
      t = slide_at(link.axis, sample, 1);
      break;
    case LinkKind::Universal:
      R = pivot_at(link.axis, sample, 0) * pivot_at(link.axis2, sample, 1);
      break;
    case LinkKind::Planar:
      R = pivot_at(link.axis, sample, 2);
      t = slide_at(link.axis2, sample, 0) + slide_at(link.axis.cross(link.axis2), sample, 1);
      break;
    case LinkKind::Screw:
      R = pivot_at(link.axis, sample, 0);
      t = slide_at(link.pitch * link.axis, sample, 0);
      break;
    case LinkKind::Free:
      t = vector_at(sample);
      R = rotation_at(sample, 3);
      break;
  }
  LocalMotion M;
  const std::size_t size = static_cast<std::size_t>(value_size(link.kind));
  // Not from R and t, so that a link played at a value has the bits of one set to it.
  M.value = local_matrix(link, LinkValue{std::span<const double>{sample.value.data(), size}}).affine();
  M.first = between(link, R.first, t.first);
  M.second = between(link, R.second, t.second);
  return M;
}

}  // namespace pantin

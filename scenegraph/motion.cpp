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

/// B(q, q), with the same bits.
Matrix3 rotation_matrix(const double* q) {
  const double ww = q[0] * q[0], xx = q[1] * q[1], yy = q[2] * q[2], zz = q[3] * q[3];
  const double wx = q[0] * q[1], wy = q[0] * q[2], wz = q[0] * q[3];
  const double xy = q[1] * q[2], xz = q[1] * q[3], yz = q[2] * q[3];
  Matrix3 R;
  R << ww + xx - yy - zz, 2 * (xy - wz), 2 * (xz + wy),  //
      2 * (xy + wz), ww - xx + yy - zz, 2 * (yz - wx),   //
      2 * (xz - wy), 2 * (yz + wx), ww - xx - yy + zz;
  return R;
}

RotationMotion rotation_at(const ChannelValue<Jet>& value, std::size_t first) {
  Vector4 q, q1, q2;
  for (int j = 0; j < 4; ++j) {
    const Jet& number = value[first + static_cast<std::size_t>(j)];
    q[j] = number.value;
    q1[j] = number.first;
    q2[j] = number.second;
  }
  return {rotation_matrix(q.data()), 2 * rotation_form(q, q1),
          2 * rotation_form(q1, q1) + 2 * rotation_form(q, q2)};
}

VectorMotion vector_at(const ChannelValue<Jet>& value) {
  VectorMotion v;
  for (int j = 0; j < 3; ++j) {
    const Jet& number = value[static_cast<std::size_t>(j)];
    v.value[j] = number.value;
    v.first[j] = number.first;
    v.second[j] = number.second;
  }
  return v;
}

/// Rotation about a fixed axis.
RotationMotion pivot_at(const Vector3& axis, const Jet& angle) {
  RotationMotion R;
  R.value = Eigen::AngleAxisd{angle.value, axis}.toRotationMatrix();
  Matrix3 K;
  K << 0, -axis.z(), axis.y(), axis.z(), 0, -axis.x(), -axis.y(), axis.x(), 0;
  const double rate = angle.first;
  R.first = rate * K * R.value;
  R.second = (angle.second * K + rate * rate * K * K) * R.value;
  return R;
}

/// Translation along a fixed direction.
VectorMotion slide_at(const Vector3& direction, const Jet& distance) {
  return {distance.value * direction, distance.first * direction, distance.second * direction};
}

VectorMotion operator+(const VectorMotion& a, const VectorMotion& b) {
  return {a.value + b.value, a.first + b.first, a.second + b.second};
}

RotationMotion operator*(const RotationMotion& a, const RotationMotion& b) {
  return {a.value * b.value, a.first * b.value + a.value * b.first,
          a.second * b.value + 2 * a.first * b.first + a.value * b.second};
}

}  // namespace

LocalMotion trs_motion(const NodePose<Jet>& pose) {
  const VectorMotion T = vector_at(at(pose, Channel::Translation));
  const RotationMotion R = rotation_at(at(pose, Channel::Rotation), 0);
  const VectorMotion S = vector_at(at(pose, Channel::Scale));
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

Eigen::Matrix<double, 3, 4> trs_matrix(const NodePose<double>& pose) {
  Eigen::Matrix<double, 3, 4> M;
  const Eigen::Map<const Vector3> scale{at(pose, Channel::Scale).data()};
  M.leftCols<3>() = rotation_matrix(at(pose, Channel::Rotation).data()) * scale.asDiagonal();
  M.col(3) = Eigen::Map<const Vector3>{at(pose, Channel::Translation).data()};
  return M;
}

LinkValue link_value(const Link& link, const ChannelValue<double>& value) {
  return LinkValue{std::span<const double>{value.data(), static_cast<std::size_t>(value_size(link.kind))}};
}

LocalMotion between(const Affine& A, const LocalMotion& M, const Affine& B) {
  LocalMotion out;
  const auto derivative = [&](const Eigen::Matrix<double, 3, 4>& D) {
    Eigen::Matrix<double, 3, 4> product;
    product.leftCols<3>() = A.linear() * D.leftCols<3>() * B.linear();
    product.col(3) = A.linear() * (D.leftCols<3>() * B.translation() + D.col(3));
    return product;
  };
  out.value = derivative(M.value);
  out.value.col(3) += A.translation();
  out.first = derivative(M.first);
  out.second = derivative(M.second);
  return out;
}

LocalMotion link_motion(const Link& link, const ChannelValue<Jet>& value) {
  RotationMotion R;
  VectorMotion t;
  switch (link.kind) {
    case LinkKind::Fixed:
      break;
    case LinkKind::Pivot:
      R = pivot_at(link.axis, value[0]);
      break;
    case LinkKind::Slider:
      t = slide_at(link.axis, value[0]);
      break;
    case LinkKind::Ball:
      R = rotation_at(value, 0);
      break;
    case LinkKind::Cylindrical:
      R = pivot_at(link.axis, value[0]);
      t = slide_at(link.axis, value[1]);
      break;
    case LinkKind::Universal:
      R = pivot_at(link.axis, value[0]) * pivot_at(link.axis2, value[1]);
      break;
    case LinkKind::Planar:
      R = pivot_at(link.axis, value[2]);
      t = slide_at(link.axis2, value[0]) + slide_at(link.axis.cross(link.axis2), value[1]);
      break;
    case LinkKind::Screw:
      R = pivot_at(link.axis, value[0]);
      t = slide_at(link.pitch * link.axis, value[0]);
      break;
    case LinkKind::Free:
      t = vector_at(value);
      R = rotation_at(value, 3);
      break;
  }
  ChannelValue<double> numbers{};
  for (std::size_t i = 0; i < numbers.size(); ++i) numbers[i] = value[i].value;
  LocalMotion T;
  T.first << R.first, t.first;
  T.second << R.second, t.second;
  LocalMotion M = between(link.M_PJ, T, link.M_JN);
  // Not from R and t, so that a link played at a value has the bits of one set to it.
  M.value = local_matrix(link, link_value(link, numbers)).affine();
  return M;
}

}  // namespace pantin

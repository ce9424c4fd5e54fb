#pragma once
// The rows of closures (closure.hpp) on any scalar T, a double or a register of several: what they are made
// of, and which of them a joint has. Holds nothing that is not a template on the scalar, so that the sources
// of the lane kernels do not share code.
#include <pantin/physics/constraints/joint.hpp>
#include <pantin/physics/constraints/kernel_math.hpp>

namespace pantin::kernel {

/// A frame's motion in the world.
template <class T>
struct MovingFrame {
  Mat3<T> R{};
  Vec3<T> p{}, w{}, v{};
  Vec3<T> al{}, a{};
};

/// Motion of a frame fixed at (R_LJ, p_LJ) in another.
template <class T>
inline MovingFrame<T> carried(const MovingFrame<T>& L, const Mat3<T>& R_LJ, const Vec3<T>& p_LJ) {
  const Vec3<T> r = L.R * p_LJ, w_x_r = cross(L.w, r);
  MovingFrame<T> J;
  J.R = L.R * R_LJ;
  J.p = L.p + r;
  J.w = L.w, J.al = L.al;
  J.v = L.v + w_x_r;
  J.a = L.a + cross(L.al, r) + cross(L.w, w_x_r);
  return J;
}

/// Motion of B in the world from that of A and of B in A.
template <class T>
inline MovingFrame<T> composed(const MovingFrame<T>& A, const MovingFrame<T>& B) {
  MovingFrame<T> out = carried(A, B.R, B.p);
  const Vec3<T> v = A.R * B.v, w = A.R * B.w;
  out.w += w;
  out.v += v;
  out.al += cross(A.w, w) + A.R * B.al;
  out.a += T(2) * cross(A.w, v) + A.R * B.a;
  return out;
}

/// R_A^T R_B
template <class T>
inline Mat3<T> relative_rotation(const Mat3<T>& A, const Mat3<T>& B) {
  Mat3<T> R;
  for (int j = 0; j < 3; ++j) {
    const Vec3<T> column = transposed_times(A, B.column(j));
    R.m[j] = column.x, R.m[3 + j] = column.y, R.m[6 + j] = column.z;
  }
  return R;
}

/// A row: by a multiplier of one it acts with `force` at p_b and `torque` on B.
template <class T>
struct RowTerms {
  Vec3<T> force{}, torque{};
  T gap{}, rate{}, acceleration{};
};

/// What the rows between Ja and Jb are made of.
template <class T>
class FramePair {
 public:
  FramePair(const MovingFrame<T>& a, const MovingFrame<T>& b) : a_{a}, b_{b}, d_{b.p - a.p} {
    const Vec3<T> d_dot = b.v - a.v, w_x_d = cross(a.w, d_);
    rate_ = d_dot - w_x_d;
    acceleration_ = b.a - a.a - cross(a.al, d_) + cross(a.w, w_x_d) - T(2) * cross(a.w, d_dot);
  }

  /// d along an axis of A.
  [[nodiscard]] RowTerms<T> along(const Vec3<T>& n) const {
    return {n, {}, dot(n, d_), dot(n, rate_), dot(n, acceleration_)};
  }
  /// Axis i of Ja times axis j of Jb.
  [[nodiscard]] RowTerms<T> square(int i, int j) const {
    const Vec3<T> m = a_.R.column(i), t = b_.R.column(j), m_x_t = cross(m, t), w = a_.w - b_.w;
    const Vec3<T> turning = cross(cross(a_.w, m), t) + cross(m, cross(b_.w, t));
    return {{}, cross(t, m), dot(m, t), dot(w, m_x_t), dot(a_.al - b_.al, m_x_t) + dot(w, turning)};
  }
  /// Turning relative to A about an axis that A carries, or B; without the angle.
  [[nodiscard]] RowTerms<T> about(const Vec3<T>& axis, const Vec3<T>& w_carrier) const {
    const Vec3<T> w = b_.w - a_.w;
    return {{}, axis, T(0), dot(axis, w), dot(axis, b_.al - a_.al) + dot(cross(w_carrier, axis), w)};
  }

  [[nodiscard]] const MovingFrame<T>& a() const { return a_; }
  [[nodiscard]] const MovingFrame<T>& b() const { return b_; }

 private:
  const MovingFrame<T>&a_, &b_;
  Vec3<T> d_, rate_{}, acceleration_{};
};

/// Calls the verbs of `rows` for a cut joint: across(i), axis i of Ja times d; square(i, j); threaded(), axis
/// 2 of Ja times d less pitch times the angle about it.
template <class Rows>
inline void list_rows(JointKind kind, Rows& rows) {
  const auto all_across = [&] { rows.across(0), rows.across(1), rows.across(2); };
  const auto same_z = [&] { rows.square(2, 0), rows.square(2, 1); };
  const auto same_axes = [&] { rows.square(0, 1), rows.square(1, 2), rows.square(2, 0); };
  switch (kind) {
    case JointKind::Slider:
      rows.across(0), rows.across(1), same_axes();
      break;
    case JointKind::Fixed:
    case JointKind::Driven:
      all_across(), same_axes();
      break;
    case JointKind::Cylindrical:
      rows.across(0), rows.across(1), same_z();
      break;
    case JointKind::Planar:
      rows.across(2), same_z();
      break;
    case JointKind::Screw:
      rows.across(0), rows.across(1), same_z(), rows.threaded();
      break;
    case JointKind::Pivot:
      all_across(), same_z();
      break;
    case JointKind::Universal:
      all_across(), rows.square(2, 0);
      break;
    case JointKind::Ball:
    case JointKind::Free:  // which holds nothing and is never cut
      all_across();
      break;
  }
}

/// Rotors of a cut joint, by rate.
struct Rotors {
  double armature[3]{};  ///< as the joint has them [kg m^2 or kg]; 0 = none
  bool slides[3]{};      ///< along the column of the rate, not about it
};

/// Calls rows.rotor(terms, armature) for each rotor of a cut joint. `model` is the joint's.
template <class T, class Model, class Rows>
inline void list_rotors(const Model& model, JointKind kind, const Rotors& rotors, const FramePair<T>& pair,
                        Rows& rows) {
  if constexpr (Model::kRates > 0 && Model::kRates <= 3) {
    Vec3<T> angular[Model::kRates], linear[Model::kRates];
    model.columns(relative_rotation(pair.a().R, pair.b().R), angular, linear);
    for (int j = 0; j < Model::kRates; ++j) {
      if (rotors.armature[j] == 0) continue;
      const bool on_b = kind == JointKind::Universal && j == 1;
      const Vec3<T> column = pair.a().R * (rotors.slides[j] ? linear[j] : angular[j]);
      rows.rotor(rotors.slides[j] ? pair.along(column) : pair.about(column, on_b ? pair.b().w : pair.a().w),
                 rotors.armature[j]);
    }
  }
}

}  // namespace pantin::kernel

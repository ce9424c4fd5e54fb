#include <pantin/physics/constraints/closure.hpp>

#include <cmath>

#include <pantin/physics/constraints/joint_models.hpp>

namespace pantin {

namespace {

using kernel::cross;
using kernel::dot;
using kernel::Mat3;
using Vec = kernel::Vec3<double>;

Vec vec(const Vector3& v) { return {v.x(), v.y(), v.z()}; }
Mat3<double> mat(const Quaternion& q) {
  const double c[4] = {q.w(), q.x(), q.y(), q.z()};
  return kernel::rotation_of(c);
}

double length(const Vec& v) { return std::sqrt(dot(v, v)); }

/// Motion of a frame fixed at (R_LJ, p_LJ) in another.
FrameMotion carried(const FrameMotion& L, const Mat3<double>& R_LJ, const Vec& p_LJ) {
  const Vec r = L.R * p_LJ, w_x_r = cross(L.w, r);
  FrameMotion J;
  J.R = L.R * R_LJ;
  J.p = L.p + r;
  J.w = L.w, J.al = L.al;
  J.v = L.v + w_x_r;
  J.a = L.a + cross(L.al, r) + cross(L.w, w_x_r);
  return J;
}

/// Motion of B in the world from that of A and of B in A.
FrameMotion composed(const FrameMotion& A, const RigidMotion& B) {
  FrameMotion out = carried(A, mat(B.X_AB.q), vec(B.X_AB.p));
  const Vec v = A.R * vec(B.v_AB), w = A.R * vec(B.w_AB);
  out.w += w;
  out.v += v;
  out.al += cross(A.w, w) + A.R * vec(B.alpha_AB);
  out.a += 2.0 * cross(A.w, v) + A.R * vec(B.a_AB);
  return out;
}

FrameMotion motion_of(const ClosureEnd& end, const Articulated& kernel,
                      std::span<const RigidMotion> grounds) {
  FrameMotion L;
  L.R = Mat3<double>::identity();
  if (end.link >= 0) {
    const LinkWork& work = kernel.link(end.link);
    L = {work.R, work.p, work.w, work.v, work.al + work.dal, work.a + work.da};
  } else if (end.ground >= 0) {
    const RigidMotion& ground = grounds[static_cast<std::size_t>(end.ground)];
    L = {mat(ground.X_AB.q), vec(ground.X_AB.p),   vec(ground.w_AB),
         vec(ground.v_AB),   vec(ground.alpha_AB), vec(ground.a_AB)};
  }
  return carried(L, end.R_LJ, end.p_LJ);
}

/// Writes the rows of one closure.
class Rows {
 public:
  Rows(const ClosureMotion& m, ClosureRow* out)
      : a_{m.a}, b_{m.b}, d_{m.b.p - m.a.p}, rows_{out}, next_{out} {
    const Vec d_dot = b_.v - a_.v, w_x_d = cross(a_.w, d_);
    rate_ = d_dot - w_x_d;
    acceleration_ = b_.a - a_.a - cross(a_.al, d_) + cross(a_.w, w_x_d) - 2.0 * cross(a_.w, d_dot);
    size_ = length(a_.p) + length(b_.p);
    speed_ = length(a_.v) + length(b_.v);
    spin_ = length(a_.w) + length(b_.w);
  }

  /// Axis i of Ja times d.
  void across(int i) {
    const Vec n = a_.R.column(i);
    *next_++ = {{n, {}, b_.p}, dot(n, d_), dot(n, rate_), dot(n, acceleration_), size_, speed_};
  }
  /// Axis i of Ja times axis j of Jb.
  void square(int i, int j) {
    const Vec m = a_.R.column(i), t = b_.R.column(j), m_x_t = cross(m, t), w = a_.w - b_.w;
    const Vec turning = cross(cross(a_.w, m), t) + cross(m, cross(b_.w, t));
    *next_++ = {{{}, cross(t, m), b_.p},
                dot(m, t),
                dot(w, m_x_t),
                dot(a_.al - b_.al, m_x_t) + dot(w, turning),
                1.0,
                spin_};
  }
  void all_across() {
    for (int i = 0; i < 3; ++i) across(i);
  }
  /// z of one stays z of the other.
  void same_z() {
    square(2, 0);
    square(2, 1);
  }
  void same_axes() {
    square(0, 1);
    square(1, 2);
    square(2, 0);
  }
  /// The last row loses pitch times the angle about z.
  void thread(double pitch) {
    ClosureRow& row = next_[-1];
    const Vec z = row.wrench.force, w = b_.w - a_.w;
    const Vec x = a_.R.column(0), y = a_.R.column(1), x_b = b_.R.column(0), y_b = b_.R.column(1);
    const double angle = std::atan2(dot(y, x_b) - dot(x, y_b), dot(x, x_b) + dot(y, y_b));
    const double turns =
        pitch == 0 ? 0 : std::round((row.gap / pitch - angle) / (2 * M_PI));  // the nearest thread
    row.wrench.torque = -pitch * z;
    row.gap -= pitch * (angle + 2 * M_PI * turns);
    row.rate -= pitch * dot(z, w);
    row.acceleration -= pitch * (dot(z, b_.al - a_.al) + dot(cross(a_.w, z), w));
  }
  [[nodiscard]] std::size_t count() const { return static_cast<std::size_t>(next_ - rows_); }

 private:
  const FrameMotion &a_, &b_;
  Vec d_, rate_{}, acceleration_{};
  double size_{0}, speed_{0}, spin_{0};
  ClosureRow *rows_, *next_;
};

}  // namespace

ClosureMotion motion_of(const Closure& closure, const Articulated& kernel,
                        std::span<const RigidMotion> grounds, Instant at) {
  ClosureMotion motion{motion_of(closure.a, kernel, grounds), motion_of(closure.b, kernel, grounds)};
  if (closure.driver != nullptr) motion.a = composed(motion.a, closure.driver->motion(at.t, at.side));
  return motion;
}

void write_rows(const Closure& closure, const ClosureMotion& motion, std::span<ClosureRow> out) {
  Rows rows{motion, out.data()};
  switch (closure.kind) {
    case JointKind::Slider:
      rows.across(0), rows.across(1), rows.same_axes();
      break;
    case JointKind::Fixed:
    case JointKind::Driven:
      rows.all_across(), rows.same_axes();
      break;
    case JointKind::Cylindrical:
      rows.across(0), rows.across(1), rows.same_z();
      break;
    case JointKind::Planar:
      rows.across(2), rows.same_z();
      break;
    case JointKind::Screw:
      rows.across(0), rows.across(1), rows.same_z(), rows.across(2), rows.thread(closure.pitch);
      break;
    default:  // Ball, Pivot, Universal, and Free, which holds nothing and is never cut
      rows.all_across();
      if (closure.kind == JointKind::Pivot) rows.same_z();
      if (closure.kind == JointKind::Universal) rows.square(2, 0);
  }
}

ClosureWrench damping_of(const Closure& closure, const ClosureMotion& m) {
  // The columns of a joint are at right angles, so that the generalised forces of damping are the components
  // of one wrench. On a screw it is all torque.
  ClosureWrench wrench;
  const FrameMotion &a = m.a, &b = m.b;
  const Vec w = transposed_times(a.R, b.w - a.w);
  const Vec v = transposed_times(a.R, b.v - a.v - cross(a.w, b.p - a.p));
  const Mat3<double> R{[&] {
    Mat3<double> to;
    for (int j = 0; j < 3; ++j) {
      const Vec column = transposed_times(a.R, b.R.column(j));
      to.m[j] = column.x, to.m[3 + j] = column.y, to.m[6 + j] = column.z;
    }
    return to;
  }()};
  with_model(closure, [&](auto model) {
    using Model = decltype(model);
    if constexpr (Model::kRates > 0 && Model::kRates <= 3) {
      Vec angular[Model::kRates], linear[Model::kRates];
      model.columns(R, angular, linear);
      for (int j = 0; j < Model::kRates; ++j) {
        const double c = closure.damping[static_cast<std::size_t>(j)];
        const bool turns = dot(angular[j], angular[j]) > 0;
        if (turns) wrench.torque += (-c * dot(angular[j], w)) * (a.R * angular[j]);
        else wrench.force += (-c * dot(linear[j], v)) * (a.R * linear[j]);
      }
    }
  });
  return wrench;
}

}  // namespace pantin

#include <pantin/physics/constraints/closure.hpp>

#include <cmath>

#include <pantin/physics/constraints/joint_models.hpp>

namespace pantin {

namespace {

using kernel::cross;
using kernel::dot;
using kernel::Mat3;
using Vec = kernel::Vec3<double>;

double length(const Vec& v) { return std::sqrt(dot(v, v)); }

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
  /// Rotor that turns, relative to A, about a column of the joint given in the world and carried by A or B.
  void turning_rotor(const Vec& c, const Vec& w_carrier, double armature) {
    const Vec w = b_.w - a_.w;
    const double acceleration = dot(c, b_.al - a_.al) + dot(cross(w_carrier, c), w);
    *next_++ = {{{}, c, b_.p}, 0, 0, acceleration, 1, 1, 1 / armature, dot(c, w)};
  }
  /// The same of one that moves along an axis of A.
  void sliding_rotor(const Vec& n, double armature) {
    *next_++ = {{n, {}, b_.p}, 0, 0, dot(n, acceleration_), 1, 1, 1 / armature, dot(n, rate_)};
  }

 private:
  const FrameMotion &a_, &b_;
  Vec d_, rate_{}, acceleration_{};
  double size_{0}, speed_{0}, spin_{0};
  ClosureRow *rows_, *next_;
};

}  // namespace

namespace {

void write_rotors(const Closure& closure, const ClosureMotion& motion, Rows& rows) {
  if (closure.armature == std::array<double, 3>{}) return;
  const RelativeMotion B = relative(motion);
  with_model(closure, [&](auto model) {
    using Model = decltype(model);
    if constexpr (Model::kRates > 0 && Model::kRates <= 3) {
      Vec angular[Model::kRates], linear[Model::kRates];
      model.columns(B.R, angular, linear);
      for (int j = 0; j < Model::kRates; ++j) {
        const double armature = closure.armature[static_cast<std::size_t>(j)];
        const bool on_b = closure.kind == JointKind::Universal && j == 1;
        if (armature == 0) continue;
        if (dot(angular[j], angular[j]) > 0)
          rows.turning_rotor(motion.a.R * angular[j], on_b ? motion.b.w : motion.a.w, armature);
        else rows.sliding_rotor(motion.a.R * linear[j], armature);
      }
    }
  });
}

}  // namespace

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
  write_rotors(closure, motion, rows);
}

}  // namespace pantin

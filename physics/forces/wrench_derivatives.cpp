#include <pantin/physics/forces/wrench_derivatives.hpp>

#include <algorithm>

#include <pantin/physics/forces/force_law.hpp>

namespace pantin {
namespace {

constexpr double kChange = 1e-5;  // [m], [rad], [m/s], [rad/s]; of central differences
constexpr std::size_t kNumbers = 12;

/// The columns of position, turn, velocity and spin in turn.
auto column(ByMotion& by, std::size_t number) {
  Matrix3* const blocks[] = {&by.position, &by.turn, &by.velocity, &by.spin};
  return blocks[number / 3]->col(static_cast<Eigen::Index>(number % 3));
}

BodyKinematics moved_by(std::size_t number, double change, BodyKinematics body) {
  const Vector3 axis = Vector3::Unit(static_cast<Eigen::Index>(number % 3));
  switch (number / 3) {
    case 0:
      body.p_WBcm += change * axis;
      break;
    case 1:
      body.R_WB = Eigen::AngleAxisd{change, axis} * body.R_WB;
      break;
    case 2:
      body.v_WBcm += change * axis;
      break;
    default:
      body.w_WB += change * axis;
      break;
  }
  return body;
}

}  // namespace

WrenchDerivative& WrenchDerivatives::add(std::size_t on, std::size_t by) {
  return parts_.emplace_back(static_cast<std::uint32_t>(on), static_cast<std::uint32_t>(by));
}

WrenchDerivatives::Point WrenchDerivatives::point_of(const BodiesAt& at, const Attachment& attachment) {
  if (!attachment.body) return {};
  const std::size_t i = at.index(attachment.body);
  const BodyKinematics& k = at.kinematics[i];
  const Matrix3 arm = cross_matrix(k.R_WB * (attachment.p_BQ - at.mass[i].p_BBcm));
  return {i, arm, cross_matrix(k.w_WB) * arm};
}

void WrenchDerivatives::add_pair(const BodiesAt& at, const Attachment& a, const Attachment& b,
                                 const PairForce& pair) {
  add_pair(point_of(at, a), point_of(at, b), pair);
}

void WrenchDerivatives::add_pair(const BodiesAt& at, std::size_t a, const Attachment& b,
                                 const PairForce& pair) {
  add_pair(Point{a}, point_of(at, b), pair);
}

void WrenchDerivatives::add_pair(const Point& a, const Point& b, const PairForce& pair) {
  for (const Point* on : {&a, &b}) {
    if (!on->body) continue;
    const double on_sign = on == &a ? 1 : -1;
    for (const Point* by : {&a, &b}) {
      if (!by->body) continue;
      // d = p_b - p_a grows with what moves b, and shrinks with what moves a.
      const double sign = by == &a ? -on_sign : on_sign;
      const Matrix3 K = sign * pair.by_distance, C = sign * pair.by_rate;
      WrenchDerivative& part = add(*on->body, *by->body);
      part.force = {.position = K, .turn = -K * by->arm - C * by->swing, .velocity = C, .spin = -C * by->arm};
      part.torque = {.position = on->arm * part.force.position,
                     .turn = on->arm * part.force.turn,
                     .velocity = on->arm * part.force.velocity,
                     .spin = on->arm * part.force.spin};
      // The arm turns with its body: d (r x F) = (turn x r) x F + r x dF.
      if (on == by) part.torque.turn += cross_matrix(on_sign * pair.force_a) * on->arm;
    }
  }
}

bool WrenchDerivatives::add_differences(const ForceLaw& law, const BodiesAt& at) {
  const Coupling coupling = law.coupling();
  if (coupling.reach == Coupling::Reach::All) return false;
  moved_.assign(at.kinematics.begin(), at.kinematics.end());
  const auto is_simulated = [&](std::size_t i) { return at.kind[i] == BodyKind::Simulated; };
  std::size_t begin = parts_.size();
  if (coupling.reach == Coupling::Reach::Each) {
    for (std::size_t i = 0; i < at.size(); ++i) {
      if (is_simulated(i)) add(i, i);
    }
    take_differences(law, at, std::span{parts_}.subspan(begin));
    return true;
  }
  for (const BodyId by : coupling.bodies) {
    if (!by || !is_simulated(at.index(by))) continue;
    begin = parts_.size();
    for (const BodyId on : coupling.bodies) {
      if (on && is_simulated(at.index(on))) add(at.index(on), at.index(by));
    }
    take_differences(law, at, std::span{parts_}.subspan(begin));
  }
  return true;
}

void WrenchDerivatives::take_differences(const ForceLaw& law, const BodiesAt& at,
                                         std::span<WrenchDerivative> parts) {
  BodiesAt moved = at;
  moved.kinematics = moved_;
  for (std::size_t number = 0; number < kNumbers; ++number) {
    for (const std::size_t side : {0u, 1u}) {
      for (const WrenchDerivative& part : parts)
        moved_[part.by] = moved_by(number, side == 0 ? kChange : -kChange, at.kinematics[part.by]);
      wrenches_[side].assign(at.size(), {});
      law.add_wrenches(moved, wrenches_[side]);
    }
    for (WrenchDerivative& part : parts) {
      const Wrench &plus = wrenches_[0][part.on], &minus = wrenches_[1][part.on];
      column(part.force, number) = (plus.force - minus.force) / (2 * kChange);
      column(part.torque, number) = (plus.torque - minus.torque) / (2 * kChange);
      moved_[part.by] = at.kinematics[part.by];
    }
  }
}

}  // namespace pantin

// Couplings of joints: what the constraint manager knows and says of them.
#include <algorithm>
#include <cmath>

#include <pantin/physics/constraints/constraint_manager.hpp>
#include <pantin/physics/setting_checks.hpp>

namespace pantin {

namespace {

/// How far the numbers of the two joints are from what a coupling asks, in b's unit.
double misfit(const GearSettings& gear, double q_a, double q_b) {
  return q_b - gear.ratio * q_a - gear.offset;
}

}  // namespace

CouplingId ConstraintManager::add(const BodyStore& bodies, GearSettings gear) {
  const std::size_t a = at(gear.a), b = at(gear.b);
  if (counts_turns(joints_[b]->kind, gear.axis_b) && !couplings_.has(gear.b)) {
    last_[b] = numbers(bodies, b);
    double& q_b = last_[b].q[gear.axis_b];
    q_b -= 2 * M_PI * std::round(misfit(gear, numbers(bodies, a).q[gear.axis_a], q_b) / (2 * M_PI));
  }
  return couplings_.add(std::move(gear));
}

std::vector<JointCoupling> ConstraintManager::placed_couplings() const {
  std::vector<JointCoupling> placed;
  for (std::size_t k = 0; k < couplings_.size(); ++k) {
    const GearSettings& gear = couplings_[k];
    placed.push_back({.a = static_cast<std::uint32_t>(at(gear.a)),
                      .axis_a = static_cast<std::uint32_t>(gear.axis_a),
                      .b = static_cast<std::uint32_t>(at(gear.b)),
                      .axis_b = static_cast<std::uint32_t>(gear.axis_b),
                      .ratio = gear.ratio,
                      .offset = gear.offset});
  }
  return placed;
}

bool ConstraintManager::is_idle(const BodyStore& bodies, std::size_t j) const {
  const auto is_simulated = [&](BodyId id) {
    return id && bodies.kinds[bodies.at(id)] == BodyKind::Simulated;
  };
  return !is_simulated(joints_[j]->a) && !is_simulated(joints_[j]->b);
}

void ConstraintManager::add_coupling_drift(const BodyStore& bodies, JointDrift& drift) const {
  for (std::size_t k = 0; k < couplings_.size(); ++k) {
    const GearSettings& gear = couplings_[k];
    const std::size_t a = at(gear.a), b = at(gear.b);
    if (is_idle(bodies, a) || is_idle(bodies, b)) continue;
    const double off =
        std::abs(misfit(gear, numbers(bodies, a).q[gear.axis_a], numbers(bodies, b).q[gear.axis_b]));
    double& most = is_length(joints_[b]->kind, gear.axis_b) ? drift.distance : drift.angle;
    most = std::max(most, off);
  }
}

SettingsProblem ConstraintManager::problem_with_coupling(const OpenLoop& loop) const {
  const GearSettings& gear = couplings_[static_cast<std::size_t>(loop.coupling)];
  const JointDefinition &a = *joints_[at(gear.a)], &b = *joints_[at(gear.b)];
  const std::string subject = "gear '" + gear.name + "' between " + std::string{to_string(a.kind)} + " '" +
                              a.name + "' and " + std::string{to_string(b.kind)} + " '" + b.name + "' ";
  if (layout_.cut_coupling == loop.coupling) {
    return {ProblemCode::OpenLoop,
            subject + "cannot be held: all joints of a closed loop are coupled, and one has to be cut",
            "leave one joint of the loop uncoupled"};
  }
  return {ProblemCode::OpenLoop,
          subject + "cannot be met: however the bodies are moved, it is missed by at least " +
              text_of(loop.gap) + " (m or rad)",
          "correct its ratio or offset, place the joints nearer to it, or leave it or another coupling out"};
}

}  // namespace pantin

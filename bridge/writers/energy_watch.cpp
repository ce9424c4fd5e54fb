#include <pantin/bridge/writers/energy_watch.hpp>

#include <algorithm>
#include <cmath>

namespace pantin {

bool conserves_energy(const PhysicsManager& physics) {
  const auto is_animated = [&](BodyId id) { return id && physics.body(id).kind() == BodyKind::Animated; };
  const std::vector<JointId> joints = physics.joints();
  return std::none_of(joints.begin(), joints.end(), [&](JointId id) {
    const JointDefinition& joint = physics.joint(id);
    for (int axis = 0; axis < axis_count(joint.kind); ++axis)
      if (physics.motor(id, axis)) return true;
    const bool is_braked = std::any_of(joint.axes.begin(), joint.axes.end(),
                                       [](const JointAxis& axis) { return axis.friction > 0; });
    return is_braked || joint.damping != std::array<double, 3>{} || joint.kind == JointKind::Driven ||
           is_animated(joint.a) || is_animated(joint.b);
  });
}

void EnergyWatch::begin(const Energy& energy, bool conserved) {
  conserved_ = conserved_ && conserved;
  deviations_ += deviation_;
  deviation_ = 0;
  start_ = energy;
  see(energy);
}

void EnergyWatch::see(const Energy& energy) {
  deviation_ = std::max(deviation_, std::abs(energy.total() - start_.total()));
  exchange_ = std::max({exchange_, energy.kinetic, std::abs(energy.potential - start_.potential)});
}

std::optional<double> EnergyWatch::drift() const {
  if (!conserved_) return std::nullopt;
  const double sum = deviations_ + deviation_;
  return sum == 0 ? 0 : sum / exchange_;
}

}  // namespace pantin

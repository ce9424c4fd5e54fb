// Springs, rotors and motors as the constraint manager keeps them: settings, energies, efforts, and the
// momentum that rotors bring along.
#include <algorithm>

#include <pantin/physics/constraints/constraint_manager.hpp>
#include <pantin/physics/constraints/joint_models.hpp>

namespace pantin {

void ConstraintManager::set_motor(std::size_t j, int axis, const MotorSettings& motor) {
  const bool is_first = motors_[j] == nullptr;
  if (is_first) motors_[j] = std::make_unique<JointMotors>();
  (*motors_[j])[static_cast<std::size_t>(axis)] = motor;
  if (is_first) list_motors();
}

void ConstraintManager::clear_motor(std::size_t j, int axis) {
  if (motors_[j] == nullptr) return;
  (*motors_[j])[static_cast<std::size_t>(axis)].reset();
  if (std::any_of(motors_[j]->begin(), motors_[j]->end(), [](const auto& m) { return m.has_value(); }))
    return;
  motors_[j].reset();
  list_motors();
}

void ConstraintManager::list_motors() {
  if (stale_) return;
  loads_.list(layout_, joints_, motors_);
  ++layout_revision_;
}

std::optional<MotorSettings> ConstraintManager::motor(std::size_t j, int axis) const {
  return motors_[j] == nullptr ? std::nullopt : (*motors_[j])[static_cast<std::size_t>(axis)];
}

void ConstraintManager::list_storing() {
  storing_.clear();
  for (std::size_t j = 0; j < joints_.size(); ++j) {
    const auto& axes = joints_[j]->axes;
    const bool stores = std::any_of(axes.begin(), axes.end(), [](const JointAxis& axis) {
      return axis.stiffness > 0 || axis.armature > 0;
    });
    if (stores) storing_.push_back(static_cast<std::uint32_t>(j));
  }
}

Energy ConstraintManager::energy(const BodyStore& bodies) const {
  Energy sum;
  const auto is_simulated = [&](BodyId id) {
    return id && bodies.kinds[bodies.at(id)] == BodyKind::Simulated;
  };
  for (const std::uint32_t j : storing_) {
    const JointDefinition& joint = *joints_[j];
    if (!is_simulated(joint.a) && !is_simulated(joint.b)) continue;
    Numbers n = numbers(bodies, j);
    if (stale_ || layout_.link_of_joint[j] < 0) {
      const JointNumbers measured = rate(bodies, j);
      std::copy(measured.numbers().begin(), measured.numbers().end(), n.v);
    } else if (const TreeLink& link = layout_.links[static_cast<std::size_t>(layout_.link_of_joint[j])];
               link.kind == JointKind::Planar) {
      std::copy_n(bodies.state.rates.data() + link.v, 3, n.v);  // those that its rotors turn with
    }
    for (std::size_t i = 0; i < joint.axes.size(); ++i) {
      const JointAxis& axis = joint.axes[i];
      const double off = n.q[i] - axis.rest;
      sum.kinetic += 0.5 * axis.armature * n.v[i] * n.v[i];
      sum.potential += 0.5 * axis.stiffness * off * off;
    }
  }
  return sum;
}

JointNumbers ConstraintManager::effort(const BodyStore& bodies, std::size_t j) const {
  const Numbers n = numbers(bodies, j);
  JointNumbers out = rate(bodies, j);
  double v[6] = {};
  std::copy(out.numbers().begin(), out.numbers().end(), v);
  const std::array<double, 3> effort =
      joint_efforts(*joints_[j], motors_[j].get(), {bodies.state.time, Side::After}, n.q, v, true);
  for (int i = 0; i < out.size(); ++i) out[i] = effort[static_cast<std::size_t>(i)];
  return out;
}

void ConstraintManager::measure_rotors(BodyStore& bodies, const Tree& tree) const {
  for (std::uint32_t i = tree.links_begin; i < tree.links_end; ++i) {
    const TreeLink& link = layout_.links[i];
    if (link.armature == std::array<double, 3>{}) continue;
    const auto j = static_cast<std::size_t>(link.joint);
    Numbers n = numbers(bodies, j);
    const JointNumbers measured = rate(bodies, j);
    std::copy(measured.numbers().begin(), measured.numbers().end(), n.v);
    with_model(link, [&](auto model) {
      if (link.reversed) model.reverse(n.q, n.v);
      std::copy_n(n.v, decltype(model)::kRates, bodies.state.rates.data() + link.v);
    });
  }
}

std::span<const double> ConstraintManager::rotor_momenta(std::span<const double> rates) {
  if (!loads_.on_links()) return {};
  loads_.write_rotor_momenta(layout_, rates, efforts_);
  return efforts_;
}

void ConstraintManager::keep_cut_rotors(const BodyStore& bodies, const Tree& tree,
                                        std::span<const RigidMotion> grounds, Instant at) {
  const auto begin = layout_.closures.begin();
  const bool any = std::any_of(begin + tree.closures_begin, begin + tree.closures_end,
                               [](const Closure& c) { return c.armature != std::array<double, 3>{}; });
  if (!any) return;
  kernel_.place(layout_, tree, grounds, at, bodies.state.coordinates, bodies.state.rates);
  loops_.solver().measure(layout_, tree, kernel_, grounds, at,
                          {bodies.state.coordinates, bodies.state.rates, {}});
  loops_.solver().keep_rotor_rates(tree);
}

}  // namespace pantin

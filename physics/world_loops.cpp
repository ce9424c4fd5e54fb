// What closed loops of joints add to the dynamics of trees.
#include <algorithm>

#include <pantin/physics/world_dynamics.hpp>

namespace pantin {

void WorldDynamics::evaluate_loops(Instant at, const Tree& tree, std::span<double> v_dot) {
  ClosureSolver& solver = loops_.solver();
  solver.measure(layout_, tree, kernel_, grounds_, at);
  solver.factor(layout_, tree, kernel_);
  loop_margin = std::min(loop_margin, solver.margin(tree));
  solver.solve(layout_, tree, ClosureLevel::Acceleration, kernel_);
  kernel_.substitute(layout_, tree, v_dot);
}

void WorldDynamics::settle_loops(Instant at, std::span<double> q, std::span<double> v) {
  open_loop_ = {};
  place_grounds(at);
  for (const Tree& tree : layout_.trees) {
    if (!tree.has_closures()) continue;
    loops_.settle({layout_, tree, kernel_, grounds_, at}, q, v);
    const OpenLoop open = loops_.open_loop(layout_, tree);
    if (open.joint >= 0) open_loop_ = open;
  }
}

CutWrench WorldDynamics::cut_wrench(std::uint32_t c) const {
  const Closure& closure = layout_.closures[c];
  // Cut joints are damped at the motion that the kernel holds.
  const ClosureMotion motion =
      motion_of(closure, kernel_, grounds_, {bodies_.state.time, Side::After});
  const ClosureWrench held = loops_.solver().wrench(c), damped = damping_of(closure, motion);
  const auto eigen = [](const kernel::Vec3<double>& x) { return Vector3{x.x, x.y, x.z}; };
  return {eigen(motion.b.p), eigen(held.force + damped.force), eigen(held.torque + damped.torque)};
}

}  // namespace pantin

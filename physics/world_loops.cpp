// What closed loops and couplings of joints add to the dynamics of trees.
#include <algorithm>

#include <pantin/physics/constraints/joint_models.hpp>
#include <pantin/physics/world_dynamics.hpp>

namespace pantin {

void WorldDynamics::evaluate_loops(Instant at, const Tree& tree, std::span<const double> q,
                                   std::span<const double> v, std::span<double> v_dot) {
  ClosureSolver& solver = loops_.solver();
  solver.measure(layout_, tree, kernel_, grounds_, at, {q, v, v_dot});
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
    for (std::uint32_t c = tree.closures_begin; c < tree.closures_end; ++c) {
      const Closure& closure = layout_.closures[c];
      measure(closure, relative(motion_of(closure, kernel_, grounds_, at)),
              cut_near_.data() + std::size_t{kMostCoordinates} * c);
    }
  }
}

CutWrench WorldDynamics::cut_wrench(std::uint32_t c) const {
  const Closure& closure = layout_.closures[c];
  // Springs, motors and damping act at the motion that the kernel holds.
  const ClosureMotion motion = motion_of(closure, kernel_, grounds_, {bodies_.state.time, Side::After});
  const ClosureWrench held = loops_.solver().wrench(c);
  const ClosureWrench loaded = loads_.on_closure(layout_, c, motion, {bodies_.state.time, Side::After},
                                                 cut_near_.data() + std::size_t{kMostCoordinates} * c);
  const auto eigen = [](const kernel::Vec3<double>& x) { return Vector3{x.x, x.y, x.z}; };
  return {eigen(motion.b.p), eigen(held.force + loaded.force), eigen(held.torque + loaded.torque)};
}

}  // namespace pantin

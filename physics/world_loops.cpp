// What closed loops and couplings of joints add to the dynamics of trees.
#include <algorithm>

#include <pantin/physics/constraints/joint_models.hpp>
#include <pantin/physics/world_dynamics.hpp>

namespace pantin {

void WorldDynamics::evaluate_loops(Instant at, const Tree& tree, std::span<const double> q,
                                   std::span<const double> v, std::span<double> v_dot) {
  const TreeLayout& layout = constraints_.layout();
  Articulated& kernel = constraints_.kernel();
  ClosureSolver& solver = constraints_.loops().solver();
  solver.measure(layout, tree, kernel, grounds_, at, {q, v, v_dot});
  solver.factor(layout, tree, kernel);
  loop_margin = std::min(loop_margin, solver.margin(tree));
  solver.solve(layout, tree, ClosureLevel::Acceleration, kernel);
  kernel.substitute(layout, tree, v_dot);
}

void WorldDynamics::settle_loops(Instant at, std::span<double> q, std::span<double> v) {
  const TreeLayout& layout = constraints_.layout();
  LoopCloser& loops = constraints_.loops();
  open_loop_ = {};
  place_grounds(at);
  for (const Tree& tree : layout.trees) {
    if (!tree.has_closures()) continue;
    loops.settle({layout, tree, constraints_.kernel(), grounds_, at}, q, v);
    const OpenLoop open = loops.open_loop(layout, tree);
    if (open.joint >= 0) open_loop_ = open;
    for (std::uint32_t c = tree.closures_begin; c < tree.closures_end; ++c) {
      const Closure& closure = layout.closures[c];
      measure(closure, relative(motion_of(closure, constraints_.kernel(), grounds_, at)),
              cut_near_.data() + std::size_t{kMostCoordinates} * c);
    }
  }
}

CutWrench WorldDynamics::cut_wrench(std::uint32_t c) const {
  const Closure& closure = constraints_.layout().closures[c];
  // Springs, motors and damping act at the motion that the kernel holds.
  const ClosureMotion motion =
      motion_of(closure, constraints_.kernel(), grounds_, {bodies_.state.time, Side::After});
  const ClosureWrench held = constraints_.loops().solver().wrench(c);
  const ClosureWrench loaded = constraints_.loads().on_closure(
      constraints_.layout(), c, motion, {bodies_.state.time, Side::After},
      bodies_.state.cut_coordinates.data() + std::size_t{kMostCoordinates} * c);
  const auto eigen = [](const kernel::Vec3<double>& x) { return Vector3{x.x, x.y, x.z}; };
  return {eigen(motion.b.p), eigen(held.force + loaded.force), eigen(held.torque + loaded.torque)};
}

}  // namespace pantin

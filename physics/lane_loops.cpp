// Closed loops and couplings of joints in lanes: what the lane kernel needs to know of them, stage by stage.
#include <algorithm>

#include <pantin/physics/world_dynamics.hpp>

namespace pantin {

std::int32_t WorldDynamics::fit_loops(const lanes::Kernel& kernel, std::int32_t given) {
  const RowLayout& rows = loops_.solver().row_layout();
  const std::int32_t motions = lanes::fill_closures(layout_, rows, bodies_, given, lane_.closures);
  lane_.loop_sizes = {};
  for (const Tree& tree : layout_.trees) lane_.loop_sizes.include(layout_, rows, tree);
  lane_.loop_work.resize(kernel.loop_size(lane_.loop_sizes));
  const auto couplings = static_cast<std::size_t>(std::count_if(
      lane_.closures.begin(), lane_.closures.end(), [](const auto& c) { return c.coupling >= 0; }));
  lane_.couplings.resize(couplings * lanes::kCouplingNumbers * static_cast<std::size_t>(kernel.lanes));
  return motions;
}

void WorldDynamics::given_loop_motions(const Stages& stages, std::size_t first, std::size_t count) {
  for (std::size_t i = 0; i < lane_.closures.size(); ++i) {
    const lanes::ClosureConstants& c = lane_.closures[i];
    const Closure& closure = layout_.closures[i];
    for (std::size_t lane = 0; lane < count; ++lane) {
      const Instant& at = stages.at[first + lane];
      const auto put = [&](std::int32_t number, const RigidMotion& motion) {
        lanes::put_motion(
            motion, count,
            lane_.motions.data() + static_cast<std::size_t>(number) * lanes::kMotionNumbers * count + lane);
      };
      if (c.a.ground >= 0) put(c.a.ground, motion_of_ground(closure.a.ground, at));
      if (c.b.ground >= 0) put(c.b.ground, motion_of_ground(closure.b.ground, at));
      if (c.given >= 0) put(c.given, closure.driver->motion(at.t, at.side));
    }
  }
  if (!lane_.couplings.empty()) coupling_numbers(stages, first, count);
}

void WorldDynamics::coupling_numbers(const Stages& stages, std::size_t first, std::size_t count) {
  for (std::size_t lane = 0; lane < count; ++lane) {
    take_stage(stages, first + lane);
    const CoordinateMotion motion{.q = std::span<const double>{lane_.q}.last(layout_.coordinates),
                                  .v = std::span<const double>{lane_.v}.last(layout_.rates)};
    for (std::size_t i = 0; i < lane_.closures.size(); ++i) {
      if (lane_.closures[i].coupling < 0) continue;
      const ClosureRow row = coupling_row(layout_, layout_.closures[i], motion);
      double* out = lane_.couplings.data() +
                    static_cast<std::size_t>(lane_.closures[i].coupling) * lanes::kCouplingNumbers * count +
                    lane;
      for (const Articulated::JointEffort& effort : row.wrench.efforts) {
        for (const double weight : effort.by_rate) *out = weight, out += count;
      }
      *out = row.acceleration;
    }
  }
}

lanes::LoopTask WorldDynamics::loop_task(const Tree& tree) {
  return {.closures = lane_.closures.data(),
          .begin = tree.closures_begin,
          .end = tree.closures_end,
          .paths = layout_.paths.data(),
          .couplings = lane_.couplings.data(),
          .envelope = loops_.solver().row_layout().envelope(tree),
          .sizes = lane_.loop_sizes,
          .work = lane_.loop_work.data()};
}

}  // namespace pantin

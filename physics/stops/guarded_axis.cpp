#include <pantin/physics/stops/guarded_axis.hpp>

#include <pantin/physics/stops/axis_mode.hpp>
#include <pantin/physics/stops/coupled_axes.hpp>
#include <pantin/physics/stops/joint_event.hpp>

namespace pantin {

namespace {

bool is_guarded(const JointAxis& axis) { return axis.has_stops() || axis.friction > 0; }

}  // namespace

std::string_view to_string(AxisMode mode) noexcept {
  constexpr std::string_view names[] = {"free",  "sliding forward",    "sliding backward",
                                        "stuck", "held at lower stop", "held at upper stop"};
  return names[static_cast<std::size_t>(mode)];
}

std::string_view to_string(JointEventKind kind) noexcept {
  constexpr std::string_view names[] = {"stop hit", "stop left", "stuck", "slipped", "broken"};
  return names[static_cast<std::size_t>(kind)];
}

AxisPlace place_of_axis(JointKind kind, int axis, bool reversed) {
  if (!reversed) return {axis, 1, true};
  // As the models' reverse says.
  if (kind == JointKind::Universal) return {1 - axis, -1, true};
  return {axis, -1, kind != JointKind::Planar || axis == 2};
}

std::vector<GuardedAxis> guarded_axes(const TreeLayout& layout,
                                      std::span<const JointDefinition* const> joints) {
  const std::vector<std::array<JointAxis, 3>> axes = axes_by_leader(layout, joints);
  std::vector<GuardedAxis> out;
  for (std::uint32_t l = 0; l < layout.links.size(); ++l) {
    const TreeLink& link = layout.links[l];
    if (link.joint < 0) continue;
    const std::array<JointAxis, 3>& of_joint = axes[static_cast<std::size_t>(link.joint)];
    for (int i = 0; i < static_cast<int>(of_joint.size()); ++i) {
      const JointAxis& axis = of_joint[static_cast<std::size_t>(i)];
      const AxisPlace place = place_of_axis(link.kind, i, link.reversed);
      if (!is_guarded(axis) || !place.known) continue;
      const auto number = static_cast<std::uint32_t>(place.number);
      out.push_back({.joint = static_cast<std::uint32_t>(link.joint),
                     .axis = i,
                     .link = l,
                     .q = link.q + number,
                     .v = link.v + number,
                     .sense = place.sense,
                     .lower = place.sense > 0 ? axis.lower : -axis.upper,
                     .upper = place.sense > 0 ? axis.upper : -axis.lower,
                     .restitution = axis.restitution,
                     .friction = axis.friction});
    }
  }
  return out;
}

std::vector<std::pair<std::uint32_t, int>> unguarded_axes(const TreeLayout& layout,
                                                          std::span<const JointDefinition* const> joints) {
  std::vector<std::pair<std::uint32_t, int>> out;
  for (std::uint32_t j = 0; j < joints.size(); ++j) {
    const std::int32_t link = layout.link_of_joint[j];
    const bool is_cut = layout.closure_of_joint[j] >= 0;
    if (link < 0 && !is_cut) continue;
    const bool reversed = link >= 0 && layout.links[static_cast<std::size_t>(link)].reversed;
    for (int i = 0; i < static_cast<int>(joints[j]->axes.size()); ++i) {
      if (!is_guarded(joints[j]->axes[static_cast<std::size_t>(i)])) continue;
      if (is_cut || !place_of_axis(joints[j]->kind, i, reversed).known) out.emplace_back(j, i);
    }
  }
  return out;
}

}  // namespace pantin

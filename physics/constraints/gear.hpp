#pragma once
// Gear: ties one number of a joint to one of another, exactly and without loss,
//
//   q_b = ratio * q_a + offset.
//
// Two pivots make a pair of gears (external ones have a ratio < 0), a pivot and a slider a rack and pinion, a
// driven pair of sliders the fingers of a gripper. What it does to one joint it does to the other through the
// ratio: a generalised force f on b and -ratio * f on a, between the bodies of each joint, so that its work
// is zero and momentum is kept. Numbers are those of joint_value, with the turns that angles count.
#include <optional>
#include <string>

#include <pantin/physics/constraints/joint.hpp>
#include <pantin/physics/ids.hpp>
#include <pantin/physics/problem.hpp>

namespace pantin {

struct GearSettings {
  std::string name{};
  JointId a{};       ///< leads, in the formula; any joint but ball, fixed and driven
  int axis_a{0};     ///< which of its numbers, from 0: below their count
  JointId b{};       ///< another joint of these kinds
  int axis_b{0};     ///< the same for b
  double ratio{1};   ///< finite: rad or m of b for one rad or m of a; 0 holds b where it is
  double offset{0};  ///< finite [rad] or [m], as b has
};

/// What can be said without the joints: finite numbers, ids given, two different joints.
[[nodiscard]] std::optional<SettingsProblem> problem_with(const GearSettings& settings);
/// The same, and whether these joints have the numbers that it couples.
[[nodiscard]] std::optional<SettingsProblem> problem_with(const GearSettings& settings,
                                                          const JointDefinition& a, const JointDefinition& b);

}  // namespace pantin

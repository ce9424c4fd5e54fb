// Links that mimic others while both are simulated: the rule of the link graph, value_f = m value_l + o, as a
// gear between the joints of physics, whose numbers are metres_per_value times the links' values.
#include <algorithm>
#include <cmath>
#include <numbers>

#include <pantin/bridge/bridge_impl.hpp>

namespace pantin {
namespace {

constexpr double kApart = 1e-6;  // [rad] or [m]: above it, the user is told that joints are brought together

bool are_same(const GearSettings& x, const GearSettings& y) {
  return x.a == y.a && x.b == y.b && x.ratio == y.ratio && x.offset == y.offset;
}

}  // namespace

bool Bridge::Impl::is_held_by_gear(NodeId follower) const {
  const auto gear = gears.find(follower);
  return gear != gears.end() && physics.contains(gear->second);
}

bool Bridge::Impl::has_link_joint(NodeId id) const {
  const Binding* binding = find(id);
  return binding != nullptr && binding->drive == Drive::Physics &&
         binding->tie.kind == JointTie::Kind::Link && physics.contains(binding->joint);
}

GearSettings Bridge::Impl::wanted_gear(const Binding& follower,
                                       const std::unordered_map<NodeId, Follower>& leaders) const {
  Follower rule{follower.node, 1, 0};  // value of the follower by that of this node
  std::unordered_set<NodeId> seen{follower.node};
  for (auto up = leaders.find(rule.node); up != leaders.end(); up = leaders.find(rule.node)) {
    const Follower& next = up->second;
    rule = {next.node, rule.multiplier * next.multiplier, rule.multiplier * next.offset + rule.offset};
    if (!seen.insert(rule.node).second) break;
    const Binding* leader = find(rule.node);
    if (has_link_joint(rule.node)) {
      const double metres = follower.metres_per_value[0];
      return {.name = scene.link(follower.node)->name,
              .a = leader->joint,
              .b = follower.joint,
              .ratio = rule.multiplier * metres / leader->metres_per_value[0],
              .offset = rule.offset * metres};
    }
    const bool follows = leader == nullptr || leader->drive == Drive::Scene;
    if (!follows || is_played(rule.node)) break;
  }
  return {};
}

void Bridge::Impl::couple(std::vector<Diagnostic>& notes) {
  if (followers.empty()) return;
  std::unordered_map<NodeId, Follower> leaders;  // by follower
  for (const auto& [leader, direct] : followers) {
    for (const Follower& follower : direct) {
      leaders.insert({follower.node, {leader, follower.multiplier, follower.offset}});
    }
  }
  std::vector<NodeId> led;  // in the order of the scene, which decides the bits of the result
  std::unordered_map<NodeId, GearSettings> wanted;
  for (const Binding* binding : ordered()) {
    if (!leaders.contains(binding->node) || !has_link_joint(binding->node)) continue;
    GearSettings gear = wanted_gear(*binding, leaders);
    if (!gear.a) continue;
    led.push_back(binding->node);
    wanted.insert({binding->node, std::move(gear)});
  }
  drop_gears(wanted, notes);
  std::erase_if(led, [this](NodeId id) { return gears.contains(id); });
  for (const NodeId id : led) {
    const GearSettings& gear = wanted.at(id);
    note_distance(id, gear, notes);
    gears[id] = physics.add(gear);
  }
  leave_out_unmet(std::move(led), notes);
}

void Bridge::Impl::drop_gears(const std::unordered_map<NodeId, GearSettings>& wanted,
                              std::vector<Diagnostic>& notes) {
  for (const Binding* binding : ordered()) {
    if (!gears.contains(binding->node) || wanted.contains(binding->node)) continue;
    if (!has_link_joint(binding->node)) continue;
    notes.push_back(note_on_joint(binding->node,
                                  "what it mimics is not simulated any more: it moves on its own from now on",
                                  "take it back too, or hand over what leads it again"));
  }
  std::erase_if(gears, [&](const auto& gear) {
    if (!physics.contains(gear.second)) return true;
    const auto found = wanted.find(gear.first);
    if (found != wanted.end() && are_same(physics.coupling(gear.second), found->second)) return false;
    physics.remove(gear.second);
    return true;
  });
}

void Bridge::Impl::note_distance(NodeId follower, const GearSettings& gear,
                                 std::vector<Diagnostic>& notes) const {
  double off = physics.joint_value(gear.b) - (gear.ratio * physics.joint_value(gear.a) + gear.offset);
  if (counts_turns(physics.joint(gear.b).kind, 0)) off = std::remainder(off, 2 * std::numbers::pi);
  if (std::abs(off) <= kApart * (1 + std::abs(gear.offset))) return;
  notes.push_back(note_on_joint(follower,
                                "it stands " + std::to_string(std::abs(off)) + " (rad or m) off what it " +
                                    "mimics: both are brought together",
                                "set what leads it before handing them over, and it follows"));
}

void Bridge::Impl::leave_out_unmet(std::vector<NodeId> added, std::vector<Diagnostic>& notes) {
  while (!added.empty()) {
    const auto problems = physics.singular_joints();
    const auto open = std::find_if(problems.begin(), problems.end(), [](const auto& problem) {
      return problem.second.code == ProblemCode::OpenLoop;
    });
    if (open == problems.end()) return;
    auto culprit =
        std::find_if(added.begin(), added.end(), [&](NodeId id) { return find(id)->joint == open->first; });
    if (culprit == added.end()) culprit = added.end() - 1;
    const auto gear = gears.find(*culprit);
    notes.push_back(
        note_on_joint(*culprit, open->second.text + "; it moves on its own", open->second.remedy));
    physics.remove(gear->second);
    gears.erase(gear);
    added.erase(culprit);
  }
}

Diagnostic Bridge::Impl::note_on_joint(NodeId follower, std::string problem, std::string remedy) const {
  Diagnostic said = note(Severity::Warning, follower, std::move(problem), std::move(remedy));
  said.subject = "joint '" + physics.joint(find(follower)->joint).name + "'";
  return said;
}

}  // namespace pantin

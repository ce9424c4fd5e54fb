#include <pantin/bridge/cli/configure_links.hpp>

#include <cmath>
#include <optional>
#include <unordered_set>

#include <pantin/bridge/mimic.hpp>
#include <pantin/bridge/writers/link_keys.hpp>

#include <pantin/bridge/cli/arguments.hpp>
#include <pantin/bridge/cli/near_names.hpp>
#include <pantin/bridge/cli/text_table.hpp>

namespace pantin::cli {
namespace {

constexpr const char* kOption = "--joint";

struct Setting {
  NodeId node{};
  LinkValue value{};
};

/// The numbers as a value of the link, quaternions normalised; nothing and a note where they do not fit.
std::optional<LinkValue> value_for(const Link& link, const std::vector<double>& numbers) {
  if (numbers.size() != static_cast<std::size_t>(value_size(link.kind))) return std::nullopt;
  std::vector<double> fitted = numbers;
  if (fitted.size() >= 4) {  // the quaternion comes last
    double norm = 0;
    for (std::size_t i = fitted.size() - 4; i < fitted.size(); ++i) norm = std::hypot(norm, fitted[i]);
    if (!(norm > 0)) return std::nullopt;
    for (std::size_t i = fitted.size() - 4; i < fitted.size(); ++i) fitted[i] /= norm;
  }
  return LinkValue{std::span<const double>{fitted}};
}

std::string wanted_of(LinkKind kind) {
  switch (kind) {
    case LinkKind::Pivot:
    case LinkKind::Screw:
      return "give one angle in rad";
    case LinkKind::Cylindrical:
      return "give an angle in rad and a distance in m: angle,distance";
    case LinkKind::Universal:
      return "give two angles in rad: first,second";
    case LinkKind::Planar:
      return "give x,y in m and an angle in rad";
    case LinkKind::Slider:
      return "give one distance in m";
    case LinkKind::Ball:
      return "give a quaternion w,x,y,z that is not 0";
    case LinkKind::Free:
      return "give x,y,z in m and a quaternion w,x,y,z that is not 0";
    case LinkKind::Fixed:
      break;
  }
  return "leave it out";
}

std::vector<Diagnostic> resolve(const Scene& scene, const LinkKeys& keys, const std::string& text,
                                std::vector<Setting>& settings) {
  const JointArgument argument = parse_joint(text).value_or(JointArgument{});
  const NodeId node = keys.find(argument.name);
  const Link* link = node ? scene.link(node) : nullptr;
  if (link == nullptr)
    return {argument_error(kOption, text, node ? "this node has no link" : "no link has this name",
                           suggestion(argument.name, keys.all()))};
  const std::string kind{to_string(link->kind)};
  if (link->kind == LinkKind::Fixed)
    return {argument_error(kOption, text, "the link is fixed and has no value", wanted_of(link->kind))};
  for (const Setting& earlier : settings)
    if (earlier.node == node)
      return {
          argument_error(kOption, text, "the link '" + keys.key(node) + "' is set twice", "give it once")};
  const std::optional<LinkValue> value = value_for(*link, argument.value);
  if (!value)
    return {argument_error(kOption, text, "the value does not fit a " + kind, wanted_of(link->kind))};
  settings.push_back({node, *value});
  return {};
}

/// Warns where a number leaves its limits.
void judge_limits(const Scene& scene, const LinkKeys& keys, const Setting& setting,
                  std::vector<Diagnostic>& notes) {
  const Link& link = *scene.link(setting.node);
  for (int i = 0; i < limit_count(link.kind); ++i) {
    const double value = setting.value[i];
    const LinkLimits& limits = link.limits[static_cast<std::size_t>(i)];
    if (limits.contain(value)) continue;
    notes.push_back({Severity::Warning, "command line", "joint '" + keys.key(setting.node) + "'",
                     "the value " + short_number(value) + " is outside the limits " +
                         short_number(limits.lower) + " to " + short_number(limits.upper) +
                         "; it was set nevertheless",
                     "give a value within the limits"});
  }
}

/// Sets what follows the named links.
void follow_mimics(Scene& scene, const std::vector<NodeId>& model, const std::vector<Setting>& settings) {
  Followers followers;
  add_followers(scene, model, followers);
  std::unordered_set<NodeId> named;
  for (const Setting& setting : settings) named.insert(setting.node);
  for (const Setting& setting : settings) {
    if (setting.value.size() != 1) continue;
    for (const Follower& follower : all_followers(followers, setting.node, named))
      scene.set_link_value(follower.node, follower.multiplier * setting.value[0] + follower.offset);
  }
}

}  // namespace

std::vector<Diagnostic> configure_links(Scene& scene, const std::vector<std::string>& arguments,
                                        const std::vector<std::vector<NodeId>>& models) {
  std::vector<Diagnostic> notes;
  if (arguments.empty()) return notes;
  const LinkKeys keys{scene};
  std::vector<Setting> settings;
  for (const std::string& text : arguments) {
    const std::vector<Diagnostic> errors = resolve(scene, keys, text, settings);
    notes.insert(notes.end(), errors.begin(), errors.end());
  }
  if (has_error(notes)) return notes;
  for (const Setting& setting : settings) {
    judge_limits(scene, keys, setting, notes);
    scene.set_link_value(setting.node, setting.value);
  }
  for (const std::vector<NodeId>& model : models) follow_mimics(scene, model, settings);
  return notes;
}

}  // namespace pantin::cli

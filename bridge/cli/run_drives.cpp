#include <pantin/bridge/cli/run_drives.hpp>

#include <algorithm>

#include <pantin/bridge/cli/clips.hpp>
#include <pantin/bridge/cli/near_names.hpp>

namespace pantin::cli {
namespace {

/// A clip of a model on the nodes at and below one of them; a null node = all.
struct PlannedClip {
  const PlacedModel* placed{nullptr};
  std::size_t clip{0};
  NodeId top{};
};

std::vector<NodeId> targets_of(const Scene& scene, const PlannedClip& planned) {
  std::vector<NodeId> targets = planned.placed->instance.nodes;
  if (planned.top)
    for (NodeId& target : targets)
      if (!scene.is_above(planned.top, target)) target = NodeId{};
  return targets;
}

bool animates_anything(const Scene& scene, const PlannedClip& planned) {
  const std::vector<NodeId> targets = targets_of(scene, planned);
  const std::vector<Track>& tracks = planned.placed->model.clips[planned.clip].tracks;
  return std::any_of(tracks.begin(), tracks.end(),
                     [&](const Track& track) { return static_cast<bool>(targets[track.target]); });
}

/// The first split of PATH[=CLIP] whose left side is a path; '=' may stand in both.
struct AnimateArgument {
  NodeId node{};
  std::optional<std::string> clip{};
};
AnimateArgument split_animate(const Scene& scene, const std::string& text) {
  if (const NodeId whole = scene.find(text)) return {whole, std::nullopt};
  for (std::size_t at = text.find('='); at != std::string::npos; at = text.find('=', at + 1))
    if (const NodeId node = scene.find(text.substr(0, at))) return {node, text.substr(at + 1)};
  return {};
}

/// The model that a node belongs to; null for a node above several models.
const PlacedModel* model_of(const RunWorld& world, NodeId id) {
  for (const PlacedModel& placed : world.models) {
    const std::vector<NodeId>& nodes = placed.instance.nodes;
    if (id == placed.instance.root || std::find(nodes.begin(), nodes.end(), id) != nodes.end())
      return &placed;
  }
  return nullptr;
}

void plan_clip(const RunWorld& world, const std::string& text, std::vector<PlannedClip>& plan,
               Ledger& ledger) {
  const AnimateArgument argument = split_animate(world.scene, text);
  if (!argument.node)
    return ledger.add(unknown_path(world.scene, "--animate", text.substr(0, text.find('='))));
  const PlacedModel* placed = model_of(world, argument.node);
  PlannedClip planned{placed, 0, argument.node};
  if (placed == nullptr || placed->model.clips.empty())
    return ledger.add(argument_error("--animate", text, "the model has no clips", "leave it out"));
  if (argument.clip) {
    const std::optional<std::size_t> clip = find_clip(placed->model, *argument.clip);
    if (!clip) return ledger.add(unknown_clip(placed->model, "--animate", *argument.clip));
    planned.clip = *clip;
  } else {
    while (planned.clip + 1 < placed->model.clips.size() && !animates_anything(world.scene, planned))
      ++planned.clip;
  }
  if (!animates_anything(world.scene, planned))
    return ledger.add(argument_error("--animate", text, "the clip moves nothing at or below this node",
                                     "name a node above those that it moves, or another clip"));
  plan.push_back(planned);
}

std::vector<PlannedClip> plan_clips(const RunOptions& options, const RunWorld& world, Ledger& ledger) {
  std::vector<PlannedClip> plan;
  const std::vector<std::string> wanted =
      options.animate.empty() ? std::vector<std::string>{"all"} : options.animate;
  for (const std::string& text : wanted) {
    if (text == "none") continue;
    if (text != "all") {
      plan_clip(world, text, plan, ledger);
      continue;
    }
    for (const PlacedModel& placed : world.models)
      if (!placed.model.clips.empty()) plan.push_back({&placed, 0, NodeId{}});
  }
  return plan;
}

std::vector<NodeId> plan_simulated(const RunOptions& options, const RunWorld& world, Ledger& ledger) {
  std::vector<NodeId> nodes;
  for (const std::string& path : options.simulate) {
    if (path == "all") {
      nodes.push_back(world.scene.root());
    } else if (const NodeId node = world.scene.find(path)) {
      nodes.push_back(node);
    } else {
      ledger.add(unknown_path(world.scene, "--simulate", path));
    }
  }
  return nodes;
}

std::vector<PlannedToggle> plan_toggles(const RunOptions& options, const RunWorld& world, Ledger& ledger) {
  std::vector<PlannedToggle> plan;
  for (const ToggleArgument& toggle : options.toggles) {
    if (const NodeId node = world.scene.find(toggle.path))
      plan.push_back({toggle.time, node, toggle.path, toggle.drive});
    else ledger.add(unknown_path(world.scene, "--toggle", toggle.path));
  }
  std::stable_sort(plan.begin(), plan.end(),
                   [](const PlannedToggle& a, const PlannedToggle& b) { return a.time < b.time; });
  return plan;
}

/// Plays the clip, and binds what it moves so that its bodies are seen by physics and samples.
void play(const PlannedClip& planned, RunWorld& world, Ledger& ledger) {
  const Clip& clip = planned.placed->model.clips[planned.clip];
  const std::vector<NodeId> targets = targets_of(world.scene, planned);
  ledger.add(world.bridge.play(clip, targets));
  for (const NodeId node : targets) {
    if (!node || !world.bridge.is_played(node) || world.bridge.drive_of(node)) continue;
    for (Diagnostic note : world.bridge.follow(node)) {
      if (note.severity == Severity::Error) {  // it still moves; only physics and samples do not see it
        note.severity = Severity::Warning;
        note.remedy = "the node stays animated and is left out of samples";
      }
      ledger.add(std::move(note));
    }
  }
}

}  // namespace

std::vector<PlannedToggle> assign_drives(const RunOptions& options, RunWorld& world, Ledger& ledger) {
  const std::vector<PlannedClip> clips = plan_clips(options, world, ledger);
  const std::vector<NodeId> simulated = plan_simulated(options, world, ledger);
  std::vector<PlannedToggle> toggles = plan_toggles(options, world, ledger);
  if (ledger.has_error()) return toggles;
  for (const PlannedClip& planned : clips) play(planned, world, ledger);
  for (const NodeId node : simulated) ledger.add(world.bridge.hand_over(node, Scope::Subtree));
  if (clips.empty() && simulated.empty() && toggles.empty())
    ledger.add({Severity::Warning, "command line", "run", "nothing is simulated and nothing is animated",
                "--simulate all hands everything to physics"});
  return toggles;
}

std::vector<Diagnostic> carry_out(RunWorld& world, const PlannedToggle& toggle) {
  const std::vector<NodeId> nodes = world.scene.subtree(toggle.node);
  const auto simulated = [&] {
    return std::count_if(nodes.begin(), nodes.end(),
                         [&](NodeId id) { return world.bridge.drive_of(id) == Drive::Physics; });
  };
  const auto before = simulated();
  std::vector<Diagnostic> notes = toggle.drive == Drive::Physics
                                      ? world.bridge.hand_over(toggle.node, Scope::Subtree)
                                      : world.bridge.take_back(toggle.node, Scope::Subtree);
  if (!has_error(notes) && simulated() == before)
    notes.push_back({Severity::Warning, "command line", "--toggle '" + toggle.path + "'",
                     toggle.drive == Drive::Physics ? "changes nothing: it was simulated already"
                                                    : "changes nothing: no node at or below it was simulated",
                     "leave it out, or name another node or time"});
  return notes;
}

}  // namespace pantin::cli

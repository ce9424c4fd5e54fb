#include <pantin/bridge/cli/run_world.hpp>

#include <filesystem>
#include <limits>

#include <pantin/bridge/cli/configure_links.hpp>
#include <pantin/physics/forces/gravity.hpp>

namespace pantin::cli {
namespace {

constexpr double kStandardGravity = 9.81;  // [m/s^2]

Vector3 direction_of(UpAxis axis) { return Vector3::Unit(static_cast<int>(axis)); }

std::string stem_of(const std::string& file) { return std::filesystem::path{file}.stem().string(); }

void place(PlacedModel& placed, const RunOptions& options, RunWorld& world, Ledger& ledger) {
  InstantiateSettings settings{.base = options.base};
  if (options.models.size() > 1) settings.prefix = stem_of(placed.file);
  if (placed.model.up_axis != world.up) {
    settings.prefix = stem_of(placed.file);
    settings.M_PM = rotation_between(placed.model.up_axis, world.up);
    ledger.add({Severity::Note, placed.file, "up axis",
                std::string{to_string(placed.model.up_axis)} + " is up in the file, " +
                    std::string{to_string(world.up)} + " in the scene: the node '" + settings.prefix +
                    "' above the model carries the rotation",
                "--up " + std::string{to_string(placed.model.up_axis)} + " keeps the file's own"});
  }
  placed.instance = world.bridge.instantiate(placed.model, world.scene.root(), settings);
}

}  // namespace

ClockSettings RunWorld::clock_of(const RunOptions& options) {
  // Nobody waits for a frame here, so no update is ever dropped.
  return {.step = options.step,
          .max_updates = std::numeric_limits<int>::max(),
          .stepping = options.adaptive ? Stepping::Adaptive : Stepping::Fixed,
          .watch_stability = !options.unwatched};
}

Affine rotation_between(UpAxis from, UpAxis to) {
  Affine M = Affine::Identity();
  if (from == to) return M;
  const int a = static_cast<int>(from);
  const int b = static_cast<int>(to);
  M.linear().col(a) = direction_of(to);
  M.linear().col(b) = -direction_of(from);
  return M;
}

void build_world(const RunOptions& options, RunWorld& world, Ledger& ledger) {
  for (const std::string& file : options.models) {
    Loaded<Model> loaded = load(file, options.common);
    ledger.add(loaded.notes);
    if (loaded.value) world.models.push_back({file, std::move(*loaded.value), {}});
  }
  if (ledger.has_error()) return;
  world.up = options.up.value_or(world.models.front().model.up_axis);
  world.bridge.leave_joints_free(options.free_joints);
  for (PlacedModel& placed : world.models) place(placed, options, world, ledger);
  std::unique_ptr<Integrator> controlled = make_integrator(options.integrator, options.tolerance);
  world.physics.set_integrator(controlled ? std::move(controlled) : make_integrator(options.integrator));
  world.physics.forces().add(
      Gravity{.g_W = options.gravity.value_or(-kStandardGravity * direction_of(world.up))});

  std::vector<std::vector<NodeId>> nodes;
  for (const PlacedModel& placed : world.models) nodes.push_back(placed.instance.nodes);
  ledger.add(configure_links(world.scene, options.joints, nodes));
}

}  // namespace pantin::cli

#pragma once
// The scene of `pantin run`: models placed under one up axis, gravity, initial joint values.
#include <memory>
#include <string>
#include <vector>

#include <pantin/bridge/bridge.hpp>
#include <pantin/bridge/cli/ledger_text.hpp>
#include <pantin/bridge/cli/run_options.hpp>

namespace pantin::cli {

/// A model and the nodes that it became.
struct PlacedModel {
  std::string file{};
  Model model{};
  Instance instance{};
};

/// Scene, physics and the bridge between them; stays where it is.
struct RunWorld {
  explicit RunWorld(const RunOptions& options) : bridge{scene, physics, clock_of(options)} {}
  RunWorld(const RunWorld&) = delete;
  RunWorld& operator=(const RunWorld&) = delete;

  Scene scene{};
  PhysicsManager physics{};
  Bridge bridge;
  std::vector<PlacedModel> models{};
  UpAxis up{UpAxis::Z};

 private:
  static ClockSettings clock_of(const RunOptions& options);
};

/// The rotation that turns one up axis into another about the axis at right angles to both; exact.
[[nodiscard]] Affine rotation_between(UpAxis from, UpAxis to);

/// Loads and places the models, sets gravity, integrator and joint values. The world is only fit for use
/// where the ledger has no error afterwards.
void build_world(const RunOptions& options, RunWorld& world, Ledger& ledger);

}  // namespace pantin::cli

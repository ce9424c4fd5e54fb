#include <pantin/bridge/cli/run_text.hpp>

#include <pantin/bridge/cli/model_text.hpp>
#include <pantin/bridge/cli/text_table.hpp>

namespace pantin::cli {
namespace {

std::string placement_of(const PlacedModel& placed, UpAxis up) {
  if (placed.model.up_axis == up) return "";
  return std::string{", rotated from "} + std::string{to_string(placed.model.up_axis)} + " up to " +
         std::string{to_string(up)} + " up";
}

std::string drift_of(const RunSummary& summary) {
  if (summary.energy_drift) return short_number(*summary.energy_drift) + " of the energy exchanged";
  return "not conserved: damping, friction, stops, motors or animated nodes do work";
}

}  // namespace

void print_world(std::ostream& out, const RunWorld& world) {
  TextTable table;
  for (const PlacedModel& placed : world.models)
    table.add({placed.file, outline(placed.model) + placement_of(placed, world.up)});
  std::string drives;
  for (const Drive drive : {Drive::Physics, Drive::Scene}) {
    std::size_t count = 0;
    for (const NodeId id : world.bridge.bound())
      if (world.bridge.drive_of(id) == drive) ++count;
    drives += std::to_string(count) + " " + std::string{to_string(drive)} + ", ";
  }
  table.add({"bodies", drives + counted(world.physics.joints().size(), "joint", "joints")});
  table.print(out);
}

void print_summary(std::ostream& out, const RunSummary& summary) {
  TextTable table;
  table.add({"bodies", std::to_string(summary.bodies) + ", " + std::to_string(summary.bodies_simulated) +
                           " simulated"});
  table.add({"joints", std::to_string(summary.joints)});
  table.add({"steps", std::to_string(summary.steps) + " of " + short_seconds(summary.step) + " with " +
                          summary.integrator + ", " + std::to_string(summary.evaluations) + " evaluations"});
  table.add({"time", short_number(summary.duration) + " s" + (summary.completed ? "" : ", stopped early") +
                         ", " + counted(static_cast<std::size_t>(summary.samples), "sample", "samples") +
                         ", " + counted(static_cast<std::size_t>(summary.toggles), "toggle", "toggles")});
  table.add({"energy", short_number(summary.energy_initial) + " J at first, " +
                           short_number(summary.energy_final) + " J at last"});
  table.add({"energy drift", drift_of(summary)});
  table.add({"joint drift",
             short_number(summary.joint_drift_m) + " m, " + short_number(summary.joint_drift_rad) + " rad"});
  if (summary.joint_events > 0) {
    table.add({"joint events",
               std::to_string(summary.joint_events) + " at stops and in dry friction" +
                   (summary.crowded > 0 ? ", crowded in " + counted(static_cast<std::size_t>(summary.crowded),
                                                                    "update", "updates")
                                        : "")});
  }
  table.add({"wall time", short_number(summary.wall_seconds) + " s"});
  out << "summary\n";
  table.print(out, "  ");
}

}  // namespace pantin::cli

#include <pantin/bridge/writers/run_summary.hpp>

namespace pantin {

void write_summary(JsonStream& json, const RunSummary& summary) {
  json.begin_object(JsonLayout::Lines).key("models").begin_array();
  for (const std::string& model : summary.models) json.value(model);
  json.end_array();
  json.member("bodies", summary.bodies).member("bodies_simulated", summary.bodies_simulated);
  json.member("joints", summary.joints).member("steps", summary.steps);
  json.member("evaluations", summary.evaluations).member("joint_events", summary.joint_events);
  json.member("crowded", summary.crowded).member("samples", summary.samples);
  json.member("toggles", summary.toggles).member("duration", summary.duration);
  json.member("completed", summary.completed);
  json.member("integrator", summary.integrator).member("step", summary.step);
  json.member("energy_initial", summary.energy_initial).member("energy_final", summary.energy_final);
  json.member("energy_conserved_expected", summary.energy_conserved_expected);
  json.key("energy_drift_relative");
  summary.energy_drift ? json.value(*summary.energy_drift) : json.null();
  json.member("joint_drift_m", summary.joint_drift_m).member("joint_drift_rad", summary.joint_drift_rad);
  json.member("wall_seconds", summary.wall_seconds);
  json.end_object();
}

}  // namespace pantin

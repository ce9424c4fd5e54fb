#pragma once
// The account of a run: what it held, what it cost, and how true it stayed.
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <pantin/bridge/writers/json_stream.hpp>

namespace pantin {

struct RunSummary {
  std::vector<std::string> models{};  ///< files as they were named
  std::size_t bodies{0};              ///< bound nodes at the end
  std::size_t bodies_simulated{0};    ///< of them with drive "simulated"
  std::size_t joints{0};              ///< joints of physics at the end
  std::int64_t steps{0};              ///< updates of physics
  std::int64_t evaluations{0};        ///< of the derivative
  std::int64_t joint_events{0};       ///< at stops and in dry friction
  std::int64_t crowded{0};            ///< parts of updates in which these crowded
  std::int64_t samples{0};            ///< taken, the first at time 0
  std::int64_t toggles{0};            ///< changes of drive that were carried out
  double duration{0};                 ///< time reached [s]
  bool completed{false};              ///< false = stopped before the end; the ledger says why
  std::string integrator{};
  double step{0};            ///< [s]
  double energy_initial{0};  ///< kinetic and potential [J]
  double energy_final{0};    ///< [J]
  bool energy_conserved_expected{
      true};  ///< nothing but gravity and ideal joints did work between the toggles
  std::optional<double> energy_drift{};  ///< relative, see EnergyWatch; nothing where energy need not stay
  double joint_drift_m{0};    ///< greatest distance by which a body missed its joint, at samples [m]
  double joint_drift_rad{0};  ///< greatest angle of the same [rad]
  double wall_seconds{0};     ///< of stepping, sampling and writing
};

/// The summary as the next value of the stream, an object with the names above (energy_drift as
/// "energy_drift_relative").
void write_summary(JsonStream& json, const RunSummary& summary);

}  // namespace pantin

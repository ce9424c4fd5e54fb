#pragma once
// What a step has to say: values, never callbacks.
#include <cstddef>
#include <string>

#include <pantin/physics/ids.hpp>

namespace pantin {

struct Energy {
  double kinetic{0};    ///< of all simulated bodies [J]
  double potential{0};  ///< of the laws that have one [J]
  [[nodiscard]] double total() const { return kinetic + potential; }
};

struct JointDrift {
  double distance{0};  ///< [m]
  double angle{0};     ///< [rad]
};

enum class StepStatus {
  Done,
  NotFinite,  ///< a number overflowed or became NaN; the state before the step is kept
};

struct StepReport {
  StepStatus status{StepStatus::Done};
  double time{0};           ///< reached [s]
  int updates{0};           ///< parts the step was cut into, at breaks of driven motions
  int evaluations{0};       ///< of the derivative
  int inner_steps{0};       ///< that an adaptive integrator took inside; 0 of others
  int refused_steps{0};     ///< that it took back for missing its tolerance
  double shortest_step{0};  ///< that it accepted [s]
  std::size_t moved{0};     ///< bodies with a changed pose
  Energy energy{};          ///< at the end
  BodyId body{};            ///< culprit of a failed step, if it is one body
  std::string message{};    ///< of a failed step: what happened, where, what to do

  [[nodiscard]] bool ok() const noexcept { return status == StepStatus::Done; }
};

}  // namespace pantin

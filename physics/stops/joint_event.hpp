#pragma once
// What happened to a joint inside a step: data to be read after it.
#include <cstdint>
#include <string_view>

#include <pantin/physics/ids.hpp>

namespace pantin {

enum class JointEventKind : std::uint8_t {
  StopHit,   ///< came to a stop, with a rate into it
  StopLeft,  ///< was held by a stop, and the load now pulls it away
  Stuck,     ///< dry friction has brought it to rest
  Slipped,   ///< the load has passed what dry friction can hold
  Broken,    ///< bore more than its strength, and was taken out
};
/// "stop hit", "stop left", "stuck", "slipped", "broken".
[[nodiscard]] std::string_view to_string(JointEventKind kind) noexcept;

struct JointEvent {
  double time{0};   ///< [s]
  JointId joint{};  ///< of a broken joint: the id that it had
  int axis{0};      ///< which of the joint's numbers; 0 of a joint that broke
  JointEventKind kind{JointEventKind::StopHit};
  double value{0};  ///< of the number [rad or m]; 0 of a joint that broke
  double rate{0};   ///< of the number before the event [rad/s or m/s]; 0 of a joint that broke
};

}  // namespace pantin

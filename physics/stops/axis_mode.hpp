#pragma once
// How a number of a joint with stops or dry friction moves at present.
#include <cstdint>
#include <string_view>

namespace pantin {

enum class AxisMode : std::uint8_t {
  Free,             ///< moves as it likes, or has neither stops nor friction
  SlidingForward,   ///< its rate is positive, dry friction acts against it
  SlidingBackward,  ///< its rate is negative, dry friction acts against it
  Stuck,            ///< its rate is zero, held by dry friction
  HeldLower,        ///< its rate is zero, held by the lower stop (and dry friction)
  HeldUpper,        ///< its rate is zero, held by the upper stop (and dry friction)
};
/// "free", "sliding forward", ...
[[nodiscard]] std::string_view to_string(AxisMode mode) noexcept;

/// Whether the rate is kept at zero by whatever effort it takes.
[[nodiscard]] constexpr bool is_locked(AxisMode mode) noexcept { return mode >= AxisMode::Stuck; }

}  // namespace pantin

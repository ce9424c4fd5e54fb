#pragma once
// Why settings cannot be used: a value that contracts print and that loaders and the bridge turn into
// diagnostics.
#include <string>

namespace pantin {

enum class ProblemCode {
  NotFinite,      ///< a number is NaN or infinite
  OutOfRange,     ///< a number is outside its range
  NotUnit,        ///< an axis or quaternion is not of unit length
  Unphysical,     ///< mass properties that no body has
  NotClosed,      ///< a mesh whose surface does not enclose a volume
  UnknownEntity,  ///< an id that is null or no longer alive
  ClosedLoop,     ///< a joint between a body and itself
  OpenLoop,       ///< joints that close a loop, and cannot all be met
  SingularMass,   ///< a joint moves nothing that resists
};

struct SettingsProblem {
  ProblemCode code{ProblemCode::OutOfRange};
  std::string text{};    ///< subject, rule and the values that broke it
  std::string remedy{};  ///< what to do about it
};

}  // namespace pantin

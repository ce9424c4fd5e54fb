#include <pantin/bridge/drive.hpp>

namespace pantin {

std::string_view to_string(Drive drive) noexcept {
  switch (drive) {
    case Drive::Static:
      return "static";
    case Drive::Scene:
      return "animated";
    case Drive::Physics:
      break;
  }
  return "simulated";
}

}  // namespace pantin

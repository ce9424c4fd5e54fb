#include <pantin/bridge/model.hpp>

namespace pantin {

std::string_view to_string(UpAxis axis) noexcept {
  switch (axis) {
    case UpAxis::X:
      return "X";
    case UpAxis::Y:
      return "Y";
    case UpAxis::Z:
      break;
  }
  return "Z";
}

}  // namespace pantin

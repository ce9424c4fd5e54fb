#include "gltf_marks.hpp"

#include <algorithm>

namespace pantin::gltf {

Marks::State& Marks::at(const JsonValue& value) {
  if (value.index() >= states_.size())
    states_.resize(std::max<std::size_t>(value.index() + std::size_t{1}, 2 * states_.size()));
  return states_[value.index()];
}

Marks::State Marks::state(const JsonValue& value) const {
  return value.index() < states_.size() ? states_[value.index()] : State{};
}

std::uint32_t Marks::reason(const std::string& why) {
  const auto [found, is_new] = positions_.try_emplace(why, static_cast<std::uint32_t>(reasons_.size()));
  if (is_new) reasons_.push_back(why);
  return found->second;
}

void Marks::convert(const JsonValue& value, const std::string& why) {
  at(value).is_read = true;
  at(value).why = reason(why);
}

void Marks::drop(const JsonValue& value, const std::string& why) {
  at(value).is_dropped = true;
  at(value).why = reason(why);
}

}  // namespace pantin::gltf

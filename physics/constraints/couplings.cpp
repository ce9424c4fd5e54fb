#include <pantin/physics/constraints/couplings.hpp>

#include <algorithm>

#include <pantin/physics/expects.hpp>

namespace pantin {

CouplingId Couplings::add(GearSettings settings) {
  std::uint32_t slot = 0;
  if (free_.empty()) {
    slot = static_cast<std::uint32_t>(generation_.size());
    generation_.push_back(0);
  } else {
    slot = free_.back();
    free_.pop_back();
  }
  settings_.push_back(std::move(settings));
  return ids_.emplace_back(CouplingId{slot, ++generation_[slot]});
}

void Couplings::remove(CouplingId id) {
  const auto k = static_cast<std::ptrdiff_t>(at(id));
  settings_.erase(settings_.begin() + k);
  ids_.erase(ids_.begin() + k);
  ++generation_[id.index];
  free_.push_back(id.index);
}

void Couplings::remove_of(JointId joint) {
  for (std::size_t k = size(); k-- > 0;) {
    if (settings_[k].a == joint || settings_[k].b == joint) remove(ids_[k]);
  }
}

bool Couplings::contains(CouplingId id) const noexcept {
  return id && id.index < generation_.size() && generation_[id.index] == id.generation;
}

std::size_t Couplings::at(CouplingId id) const {
  PANTIN_EXPECTS(contains(id), "coupling " + std::to_string(id.index) + "." + std::to_string(id.generation) +
                                   " does not exist (any more): it is null, or was removed, maybe with one "
                                   "of its joints");
  return static_cast<std::size_t>(std::find(ids_.begin(), ids_.end(), id) - ids_.begin());
}

bool Couplings::has(JointId joint) const noexcept {
  return std::any_of(settings_.begin(), settings_.end(),
                     [&](const GearSettings& s) { return s.a == joint || s.b == joint; });
}

}  // namespace pantin

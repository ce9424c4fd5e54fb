#include <pantin/physics/particles/particles_at.hpp>

#include <algorithm>

namespace pantin {

std::size_t position_of_serial(std::span<const std::uint64_t> serials, std::size_t count,
                               std::uint64_t wanted) {
  if (serials.empty()) return wanted < count ? static_cast<std::size_t>(wanted) : count;
  const auto found = std::lower_bound(serials.begin(), serials.end(), wanted);
  return found != serials.end() && *found == wanted ? static_cast<std::size_t>(found - serials.begin())
                                                    : count;
}

}  // namespace pantin

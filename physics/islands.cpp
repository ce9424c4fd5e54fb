#include <pantin/physics/islands.hpp>

#include <algorithm>

#include <pantin/physics/disjoint_sets.hpp>

namespace pantin {
namespace {

/// Simulated bodies by position, and one more for all coupled particles, as sets that grow together.
class Coupler {
 public:
  Coupler(const BodyStore& bodies, const TreeLayout& layout)
      : bodies_{bodies}, coupled_{bodies.size() + 1}, is_plain_(bodies.size(), 0) {
    for (const std::uint32_t i : layout.free_bodies) is_plain_[i] = 1;
    for (const Tree& tree : layout.trees) {
      const std::uint32_t first = layout.members[layout.links[tree.links_begin].members_begin].body;
      for (std::uint32_t l = tree.links_begin; l < tree.links_end; ++l) {
        const TreeLink& link = layout.links[l];
        for (std::uint32_t m = link.members_begin; m < link.members_end; ++m) {
          coupled_.join(first, layout.members[m].body);
        }
      }
    }
  }

  void add(const ForceLaw& law) {
    const Coupling coupling = law.coupling();
    const bool with_particles =
        std::any_of(bodies_.state.particles.begin(), bodies_.state.particles.end(),
                    [&](const auto& s) { return law.acts_on(s.id) == ParticleAction::Coupled; });
    has_particles_ = has_particles_ || with_particles;
    std::uint32_t first = with_particles ? particles() : kNone;
    const auto couple = [&](std::uint32_t i) {
      if (first != kNone) coupled_.join(first, i);
      first = i;
    };
    bool is_named = false;
    for (const BodyId id : coupling.bodies) {
      if (!id || !is_simulated(bodies_.position_of[id.index])) continue;
      is_named = true;
      is_plain_[bodies_.position_of[id.index]] = 0;
      if (coupling.reach != Coupling::Reach::Each) couple(bodies_.position_of[id.index]);
    }
    if (coupling.reach != Coupling::Reach::All || !(is_named || coupling.bodies.empty())) return;
    for (std::uint32_t i = 0; i < particles(); ++i) {
      if (is_simulated(i)) couple(i);
    }
  }

  [[nodiscard]] std::vector<Island> collect() {
    std::vector<Island> islands;
    std::vector<std::uint32_t> place(bodies_.size() + 1, kNone);
    const auto island_of = [&](std::uint32_t i) -> Island& {
      std::uint32_t& at = place[coupled_.root(i)];
      if (at == kNone) {
        at = static_cast<std::uint32_t>(islands.size());
        islands.emplace_back();
      }
      return islands[at];
    };
    for (std::uint32_t i = 0; i < particles(); ++i) {
      if (!is_simulated(i)) continue;
      Island& island = island_of(i);
      island.bodies.push_back(i);
      island.is_plain = island.bodies.size() == 1 && is_plain_[i] != 0;
    }
    if (has_particles_) {
      Island& island = island_of(particles());
      island.has_particles = true;
      island.is_plain = false;
    }
    return islands;
  }

 private:
  static constexpr std::uint32_t kNone = 0xffffffffu;

  [[nodiscard]] std::uint32_t particles() const { return static_cast<std::uint32_t>(bodies_.size()); }
  [[nodiscard]] bool is_simulated(std::uint32_t i) const { return bodies_.kinds[i] == BodyKind::Simulated; }

  const BodyStore& bodies_;
  DisjointSets coupled_;
  std::vector<std::uint8_t> is_plain_;  ///< free, and named by no law
  bool has_particles_{false};
};

}  // namespace

std::vector<Island> find_islands(const BodyStore& bodies, const TreeLayout& layout,
                                 const ForceManager& forces) {
  Coupler coupler{bodies, layout};
  for (const ForceLaw* law : forces.laws()) coupler.add(*law);
  return coupler.collect();
}

}  // namespace pantin

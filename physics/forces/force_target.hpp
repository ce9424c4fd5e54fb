#pragma once
// Whom a law acts on: one body, the particles of one system, or all bodies and particles. Private to the
// force laws.
#include <optional>
#include <string>
#include <string_view>

#include <pantin/physics/bodies_at.hpp>
#include <pantin/physics/forces/force_law.hpp>
#include <pantin/physics/particles/particles_at.hpp>
#include <pantin/physics/problem.hpp>

namespace pantin {

struct ForceTarget {
  BodyId body{};                 ///< this one only
  ParticleSystemId particles{};  ///< these only; both null = everything

  [[nodiscard]] bool is_all() const { return !body && !particles; }
  /// Calls visit(i) with the position of each body.
  template <class Visit>
  void for_each_body(const BodiesAt& at, const Visit& visit) const {
    if (particles) return;
    if (body) {
      visit(at.index(body));
    } else {
      for (std::size_t i = 0, n = at.size(); i < n; ++i) visit(i);
    }
  }
  /// The same over bodies that forces move: what energies are summed over.
  template <class Visit>
  void for_each_simulated(const BodiesAt& at, const Visit& visit) const {
    for_each_body(at, [&](std::size_t i) {
      if (at.kind[i] == BodyKind::Simulated) visit(i);
    });
  }
  [[nodiscard]] bool includes(ParticleSystemId system) const {
    return particles ? particles == system : !body;
  }
  [[nodiscard]] ParticleAction each_of(ParticleSystemId system) const {
    return includes(system) ? ParticleAction::Each : ParticleAction::None;
  }
  [[nodiscard]] bool names(BodyId id) const { return id && id == body; }
  /// Of a law that acts on each by itself.
  [[nodiscard]] Coupling coupling() const {
    if (is_all()) return {.reach = Coupling::Reach::Each};
    return {.reach = Coupling::Reach::Named, .bodies = {body}};
  }
};

/// OutOfRange where both are named.
[[nodiscard]] inline std::optional<SettingsProblem> target_problem(std::string_view subject, BodyId body,
                                                                   ParticleSystemId particles) {
  if (!body || !particles) return std::nullopt;
  return SettingsProblem{ProblemCode::OutOfRange,
                         std::string{subject} + ": both a body and a particle system are named",
                         "name one of them, or add two laws"};
}

}  // namespace pantin

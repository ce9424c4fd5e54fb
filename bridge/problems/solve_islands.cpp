#include <pantin/bridge/problems/solve_islands.hpp>

#include <algorithm>
#include <limits>

#include <pantin/physics/physics_manager.hpp>

namespace pantin {
namespace {

constexpr const char* kWhereNothingIs = "gauss16";

std::unique_ptr<Integrator> integrator(const std::string& name, const SolveSettings& settings) {
  const double infinite = std::numeric_limits<double>::infinity();
  std::unique_ptr<Integrator> controlled =
      make_integrator(name, settings.step ? infinite : settings.tolerance);
  return controlled ? std::move(controlled) : make_integrator(name);
}

/// The bodies of an island; none where it is all particles.
std::vector<BodyId> bodies_of(const IslandChoice& island, const ReferenceInstance& built) {
  std::vector<BodyId> bodies;
  for (const std::string& name : island.bodies) {
    if (const auto found = built.bodies.find(name); found != built.bodies.end())
      bodies.push_back(found->second);
  }
  return bodies;
}

bool contains(const std::vector<BodyId>& bodies, BodyId id) {
  return std::find(bodies.begin(), bodies.end(), id) != bodies.end();
}

}  // namespace

void set_integrators(const ReferenceInstance& built, const SolveSettings& settings,
                     std::vector<IslandChoice>& islands, PhysicsManager& physics) {
  const std::string common = islands.empty() ? kWhereNothingIs : islands.front().solver;
  physics.set_integrator(integrator(common, settings));
  std::string of_particles;
  for (const IslandChoice& island : islands) {
    const std::vector<BodyId> bodies = bodies_of(island, built);
    if (bodies.empty()) {
      if (of_particles.empty() || island.solver == "radau") of_particles = island.solver;
    } else if (island.solver != common) {
      physics.set_integrator(bodies.front(), integrator(island.solver, settings));
    }
  }
  if (!of_particles.empty()) physics.particles().set_integrator(integrator(of_particles, settings));

  const std::vector<IslandGroup> groups = physics.islands();
  for (IslandChoice& island : islands) {
    const std::vector<BodyId> bodies = bodies_of(island, built);
    if (bodies.empty() && island.solver != of_particles) {
      island.solver = of_particles;
      island.reason = "one integrator drives all particles that no body is coupled with, and others need it";
    }
    for (const IslandGroup& group : groups) {
      if (bodies.empty() || !contains(group.bodies, bodies.front())) continue;
      island.solver = group.integrator;
      island.shares_steps = group.bodies.size() > bodies.size();
    }
  }
}

std::string names_of_solvers(const std::vector<IslandChoice>& islands) {
  std::vector<std::string> names;
  for (const IslandChoice& island : islands) {
    if (std::find(names.begin(), names.end(), island.solver) == names.end()) names.push_back(island.solver);
  }
  if (names.empty()) return kWhereNothingIs;
  std::string text = names.front();
  for (std::size_t i = 1; i < names.size(); ++i) text += ", " + names[i];
  return text;
}

}  // namespace pantin

// All integrators that can be chosen by name. A new one is one line here.
#include <array>
#include <string>
#include <utility>

#include <pantin/physics/integrators/dormand_prince.hpp>
#include <pantin/physics/integrators/euler.hpp>
#include <pantin/physics/integrators/gauss.hpp>
#include <pantin/physics/integrators/implicit_midpoint.hpp>
#include <pantin/physics/integrators/radau.hpp>
#include <pantin/physics/integrators/rk4.hpp>
#include <pantin/physics/integrators/semi_implicit_euler.hpp>
#include <pantin/physics/integrators/verlet.hpp>

namespace pantin {
namespace {

struct CatalogueEntry {
  std::string_view name{};
  std::unique_ptr<Integrator> (*make)(){nullptr};
};

constexpr std::array kCatalogue{
    CatalogueEntry{"euler", make_euler},
    CatalogueEntry{"semi-implicit-euler", make_semi_implicit_euler},
    CatalogueEntry{"verlet", make_verlet},
    CatalogueEntry{"rk4", make_rk4},
    CatalogueEntry{"implicit-midpoint", make_implicit_midpoint},
    CatalogueEntry{"dormand-prince", make_dormand_prince},
    CatalogueEntry{"gauss8", make_gauss8},
    CatalogueEntry{"gauss16", make_gauss16},
    CatalogueEntry{"radau", make_radau},
};

}  // namespace

std::unique_ptr<Integrator> make_integrator(std::string_view name) {
  for (const CatalogueEntry& entry : kCatalogue) {
    if (entry.name == name) return entry.make();
  }
  return nullptr;
}

std::unique_ptr<Integrator> Integrator::another() const {
  std::unique_ptr<Integrator> made = make_integrator(name());
  return made != nullptr ? std::move(made) : make_rk4();
}

std::unique_ptr<Integrator> make_integrator(std::string_view name, double tolerance) {
  if (name == "dormand-prince") return make_dormand_prince({.tolerance = tolerance});
  if (name == "gauss8") return make_gauss({.stages = 4, .tolerance = tolerance});
  if (name == "gauss16") return make_gauss({.stages = 8, .tolerance = tolerance});
  if (name == "radau") return make_radau({.tolerance = tolerance});
  return nullptr;
}

std::vector<std::string> integrator_names() {
  std::vector<std::string> names;
  for (const CatalogueEntry& entry : kCatalogue) names.emplace_back(entry.name);
  return names;
}

}  // namespace pantin

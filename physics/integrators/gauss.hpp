#pragma once
// Gauss-Legendre collocation of order 8 and 16, with its stages side by side, solved by Picard iteration from
// the continued polynomial of the step before. Cuts the step asked for into as many steps of its own as the
// tolerance needs. For smooth motion; it resolves every oscillation, however stiff.
#include <memory>

#include <pantin/physics/integrators/integrator.hpp>

namespace pantin {

struct GaussSettings {
  int stages{8};  ///< 1 to 8; order 2 * stages
  /// Local error per unit time of body position [m/s] and attitude [rad/s], > 0; infinity: no control, one
  /// step, cut only where the iteration does not converge.
  double tolerance{1e-10};
};

/// An evaluation counts one derivative at one stage.
[[nodiscard]] std::unique_ptr<Integrator> make_gauss(const GaussSettings& settings);
/// "gauss8": four stages, tolerance 1e-6.
[[nodiscard]] std::unique_ptr<Integrator> make_gauss8();
/// "gauss16": eight stages, tolerance 1e-10.
[[nodiscard]] std::unique_ptr<Integrator> make_gauss16();

}  // namespace pantin

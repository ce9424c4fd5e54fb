#pragma once
// A ball around the origin of its frame.
#include <memory>
#include <optional>

#include <pantin/physics/deflector.hpp>
#include <pantin/physics/deflectors/deflector_shape.hpp>

namespace pantin {

struct SphereDeflector {
  DeflectorMount on{};
  double radius{0.5};  ///< [m], > 0
  SurfaceSettings surface{};
};

[[nodiscard]] std::optional<SettingsProblem> problem_with(const SphereDeflector& settings);
[[nodiscard]] std::unique_ptr<DeflectorShape> make_shape(const SphereDeflector& settings);

}  // namespace pantin

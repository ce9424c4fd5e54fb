#pragma once
// A cylinder along z with round caps.
#include <memory>
#include <optional>

#include <pantin/physics/deflector.hpp>
#include <pantin/physics/deflectors/deflector_shape.hpp>

namespace pantin {

struct CapsuleDeflector {
  DeflectorMount on{};
  double radius{0.5};  ///< [m], > 0
  double length{1};    ///< between the centres of the caps [m], >= 0
  SurfaceSettings surface{};
};

[[nodiscard]] std::optional<SettingsProblem> problem_with(const CapsuleDeflector& settings);
[[nodiscard]] std::unique_ptr<DeflectorShape> make_shape(const CapsuleDeflector& settings);

}  // namespace pantin

#pragma once
// A deflector: a surface that turns particles back. It stands in the world or on a body of any kind, and
// moves with it; a particle's path is swept against it in the deflector's own moving frame. To add one: a
// file in deflectors/ with a settings struct that has `on` and `surface`, problem_with(settings) and
// make_shape(settings).
#include <memory>
#include <optional>
#include <string_view>

#include <pantin/physics/ids.hpp>
#include <pantin/physics/pose.hpp>
#include <pantin/physics/problem.hpp>

namespace pantin {

/// Where a deflector's frame D stands.
struct DeflectorMount {
  BodyId body{};  ///< null = the world
  Pose X_BD{};    ///< D in the body, or in W
};

/// What a surface does to a particle that meets it.
struct SurfaceSettings {
  double restitution{0.5};  ///< rebound over approach, along the normal, 0 .. 1
  double friction{0};       ///< Coulomb's coefficient, >= 0
  double stickiness{0};  ///< a particle that would leave no faster than this stays and is carried [m/s], >= 0
};

[[nodiscard]] std::optional<SettingsProblem> problem_with(const DeflectorMount& on, std::string_view kind);
[[nodiscard]] std::optional<SettingsProblem> problem_with(const SurfaceSettings& surface,
                                                          std::string_view kind);

}  // namespace pantin

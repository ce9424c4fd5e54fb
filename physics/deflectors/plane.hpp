#pragma once
// The half-space below z = 0 of its frame: particles stay on the side of +z.
#include <memory>
#include <optional>

#include <pantin/physics/deflector.hpp>
#include <pantin/physics/deflectors/deflector_shape.hpp>

namespace pantin {

struct PlaneDeflector {
  DeflectorMount on{};
  SurfaceSettings surface{};
};

[[nodiscard]] std::optional<SettingsProblem> problem_with(const PlaneDeflector& settings);
[[nodiscard]] std::unique_ptr<DeflectorShape> make_shape(const PlaneDeflector& settings);

}  // namespace pantin

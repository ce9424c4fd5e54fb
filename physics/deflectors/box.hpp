#pragma once
// A box around the origin of its frame.
#include <memory>
#include <optional>

#include <pantin/physics/deflector.hpp>
#include <pantin/physics/deflectors/deflector_shape.hpp>

namespace pantin {

struct BoxDeflector {
  DeflectorMount on{};
  Vector3 size{1, 1, 1};  ///< full edge lengths [m], each > 0
  SurfaceSettings surface{};
};

[[nodiscard]] std::optional<SettingsProblem> problem_with(const BoxDeflector& settings);
[[nodiscard]] std::unique_ptr<DeflectorShape> make_shape(const BoxDeflector& settings);

}  // namespace pantin

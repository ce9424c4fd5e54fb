#pragma once
// A surface of triangles, met from both sides; it needs not be closed. The triangles near a path come from an
// index (make_fcl_triangle_index of component collision_fcl). The path is followed in straight pieces, so
// short that no piece bends by more than a thousandth of what moves.
#include <memory>
#include <optional>

#include <pantin/physics/collision/triangle_index.hpp>
#include <pantin/physics/deflector.hpp>
#include <pantin/physics/deflectors/deflector_shape.hpp>

namespace pantin {

struct MeshDeflector {
  DeflectorMount on{};
  std::shared_ptr<const TriangleIndex> triangles{};  ///< not null
  SurfaceSettings surface{};
};

[[nodiscard]] std::optional<SettingsProblem> problem_with(const MeshDeflector& settings);
[[nodiscard]] std::unique_ptr<DeflectorShape> make_shape(const MeshDeflector& settings);

}  // namespace pantin

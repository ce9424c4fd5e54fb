#pragma once
// Exact volume integrals of the solid that a closed triangle mesh encloses.
#include <pantin/physics/shape.hpp>

namespace pantin {

/// Integrals over the solid at unit density.
struct MeshIntegrals {
  double volume{0};                         ///< [m^3]; negative where the triangles face inward
  double volume_round_off{0};               ///< bound of what rounding may have made of `volume` [m^3]
  Vector3 centroid{Vector3::Zero()};        ///< [m]; centre of the bounding box where there is no volume
  Matrix3 second_moments{Matrix3::Zero()};  ///< integral of x x^T about the centroid [m^5]
};

/// Of the mesh after `scale` along its axes. A mirroring scale (negative product) turns the triangles round,
/// so that outward stays outward. Indices must be in range; for an open mesh the numbers mean nothing.
[[nodiscard]] MeshIntegrals integrals_of(const TriangleMesh& mesh, const Vector3& scale = Vector3::Ones());

}  // namespace pantin

#pragma once
// The surface of a box as triangles, for what works on meshes.
#include <pantin/physics/shape.hpp>

namespace pantin {

/// Twelve triangles around the origin, counter-clockwise seen from outside; `size` = full edge lengths [m].
[[nodiscard]] inline TriangleMesh surface_of(const BoxShape& box) {
  TriangleMesh mesh;
  for (int corner = 0; corner < 8; ++corner) {
    const Vector3 side{corner & 1 ? 0.5 : -0.5, corner & 2 ? 0.5 : -0.5, corner & 4 ? 0.5 : -0.5};
    mesh.vertices.push_back(side.cwiseProduct(box.size));
  }
  mesh.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                    {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  return mesh;
}

}  // namespace pantin

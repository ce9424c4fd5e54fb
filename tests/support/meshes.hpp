#pragma once
// Small closed meshes whose volume and moments are known in other ways.
#include <cmath>
#include <map>
#include <memory>
#include <numbers>
#include <utility>

#include <pantin/physics/shape.hpp>

namespace pantin::test {

/// A box of full edge lengths `size` around `centre`, 12 triangles.
inline TriangleMesh box_mesh(const Vector3& size, const Vector3& centre = Vector3::Zero()) {
  TriangleMesh mesh;
  for (int corner = 0; corner < 8; ++corner) {
    const Vector3 side{corner & 1 ? 0.5 : -0.5, corner & 2 ? 0.5 : -0.5, corner & 4 ? 0.5 : -0.5};
    mesh.vertices.push_back(centre + side.cwiseProduct(size));
  }
  mesh.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                    {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  return mesh;
}

/// The corner tetrahedron (0,0,0), (a,0,0), (0,b,0), (0,0,c).
inline TriangleMesh corner_tetrahedron(const Vector3& legs) {
  return {{Vector3::Zero(), {legs.x(), 0, 0}, {0, legs.y(), 0}, {0, 0, legs.z()}},
          {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}};
}

/// An octahedron whose triangles were split into four `splits` times, all vertices on a sphere.
inline TriangleMesh ball_mesh(double radius, int splits) {
  TriangleMesh mesh{{{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}},
                    {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}}};
  for (int split = 0; split < splits; ++split) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
    const auto middle = [&](std::uint32_t i, std::uint32_t j) {
      const auto [found, added] = middles.try_emplace(std::minmax(i, j), mesh.vertices.size());
      if (added) {
        const Vector3 sum = mesh.vertices[i] + mesh.vertices[j];
        mesh.vertices.push_back(sum.normalized());
      }
      return found->second;
    };
    std::vector<std::array<std::uint32_t, 3>> finer;
    for (const std::array<std::uint32_t, 3>& t : mesh.triangles) {
      const std::uint32_t a = middle(t[0], t[1]), b = middle(t[1], t[2]), c = middle(t[2], t[0]);
      finer.insert(finer.end(), {{t[0], a, c}, {t[1], b, a}, {t[2], c, b}, {a, b, c}});
    }
    mesh.triangles = finer;
  }
  for (Vector3& vertex : mesh.vertices) vertex *= radius;
  return mesh;
}

/// Two meshes as one; vertices at the same place stay apart.
inline TriangleMesh joined(const TriangleMesh& a, const TriangleMesh& b) {
  TriangleMesh mesh = a;
  const std::uint32_t offset = static_cast<std::uint32_t>(a.vertices.size());
  mesh.vertices.insert(mesh.vertices.end(), b.vertices.begin(), b.vertices.end());
  for (const std::array<std::uint32_t, 3>& t : b.triangles) {
    mesh.triangles.push_back({t[0] + offset, t[1] + offset, t[2] + offset});
  }
  return mesh;
}

inline TriangleMesh turned_inside_out(TriangleMesh mesh) {
  for (std::array<std::uint32_t, 3>& t : mesh.triangles) std::swap(t[1], t[2]);
  return mesh;
}

inline MeshShape mesh_shape(TriangleMesh mesh, const Vector3& scale = Vector3::Ones()) {
  return {std::make_shared<const TriangleMesh>(std::move(mesh)), scale};
}

}  // namespace pantin::test

#pragma once
// The volume that a mesh encloses.
#include <pantin/physics/shape.hpp>

namespace pantin::test {

/// Sum of signed tetrahedra: positive where triangles are counter-clockwise seen from outside.
inline double volume(const TriangleMesh& mesh) {
  double sum = 0;
  for (const auto& t : mesh.triangles)
    sum += mesh.vertices[t[0]].dot(mesh.vertices[t[1]].cross(mesh.vertices[t[2]])) / 6;
  return sum;
}

}  // namespace pantin::test

#pragma once
// Finds the triangles of a mesh near a place. The physics core knows this interface only; component
// collision_fcl brings the index that there is (fcl_triangle_index.hpp).
#include <cstdint>
#include <memory>
#include <vector>

#include <pantin/physics/shape.hpp>

namespace pantin {

class TriangleIndex {
 public:
  virtual ~TriangleIndex() = default;

  /// Appends the triangles whose bounds touch the box from `low` to `high` [m], in a fixed order. Neither has
  /// to be finite: bounds that are not are met by nothing. Safe from several threads at once.
  virtual void find(const Vector3& low, const Vector3& high, std::vector<std::uint32_t>& out) const = 0;
  /// The mesh as it lies in the frame of the index: any scale is in its vertices.
  [[nodiscard]] virtual const TriangleMesh& mesh() const = 0;
};

}  // namespace pantin

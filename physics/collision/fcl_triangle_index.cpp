// FCL builds the hierarchy of axis-aligned boxes; it is walked here, with a stack of its own, because FCL's
// queries allocate and abort on numbers that are not finite (its library has its assertions on).
#include <pantin/physics/collision/fcl_triangle_index.hpp>

#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/math/bv/AABB.h>

#include <array>

#include <pantin/physics/expects.hpp>

namespace pantin {
namespace {

class FclTriangleIndex final : public TriangleIndex {
 public:
  explicit FclTriangleIndex(const MeshShape& shape) {
    mesh_ = *shape.mesh;
    for (Vector3& v : mesh_.vertices) v = v.cwiseProduct(shape.scale);
    if (shape.scale.prod() < 0) {
      for (std::array<std::uint32_t, 3>& t : mesh_.triangles) std::swap(t[1], t[2]);
    }
    // Halving by count, not by place, keeps the hierarchy shallow whatever the mesh.
    model_.bv_splitter =
        std::make_shared<fcl::detail::BVSplitter<fcl::AABBd>>(fcl::detail::SPLIT_METHOD_MEDIAN);
    model_.beginModel(static_cast<int>(mesh_.triangles.size()), static_cast<int>(mesh_.vertices.size()));
    for (const std::array<std::uint32_t, 3>& t : mesh_.triangles) {
      model_.addTriangle(mesh_.vertices[t[0]], mesh_.vertices[t[1]], mesh_.vertices[t[2]]);
    }
    model_.endModel();
  }

  void find(const Vector3& low, const Vector3& high, std::vector<std::uint32_t>& out) const override {
    if (!low.allFinite() || !high.allFinite()) return;
    std::array<int, 256> stack;
    std::size_t top = 0;
    stack[top++] = 0;
    while (top > 0) {
      const fcl::BVNode<fcl::AABBd>& node = model_.getBV(stack[--top]);
      const fcl::AABBd& box = node.bv;
      if ((box.min_.array() > high.array()).any() || (box.max_.array() < low.array()).any()) continue;
      if (node.isLeaf()) {
        out.push_back(static_cast<std::uint32_t>(node.primitiveId()));
        continue;
      }
      PANTIN_EXPECTS(top + 2 <= stack.size(),
                     "the hierarchy of a mesh is deeper than 250 levels; split the mesh");
      stack[top++] = node.rightChild();
      stack[top++] = node.leftChild();
    }
  }

  const TriangleMesh& mesh() const override { return mesh_; }

 private:
  TriangleMesh mesh_{};
  fcl::BVHModel<fcl::AABBd> model_{};
};

}  // namespace

std::shared_ptr<const TriangleIndex> make_fcl_triangle_index(const MeshShape& shape) {
  const std::optional<SettingsProblem> problem = problem_with(Shape{.geometry = shape});
  PANTIN_EXPECTS(!problem, problem->text + "; " + problem->remedy);
  return std::make_shared<FclTriangleIndex>(shape);
}

}  // namespace pantin

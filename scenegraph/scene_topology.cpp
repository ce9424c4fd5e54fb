// Moving subtrees and walking over them. Keeping the world matrix of a moved node solves
//   M_WQ * M_QN = M_WN   for M_QN,   Q the new parent,
// column by column with a fully pivoted LU of M_WQ whose columns were scaled to length 1 first, so that
// neither shear nor very different scales along the axes cost accuracy.
#include <Eigen/LU>
#include <optional>

#include <pantin/scenegraph/expects.hpp>
#include <pantin/scenegraph/scene_impl.hpp>

namespace pantin {
namespace {

/// M_QN with M_WQ * M_QN = M_WN; nothing if M_WQ is singular or the solution overflows.
std::optional<Affine> solve_local(const Affine& M_WQ, const Affine& M_WN) {
  const Vector3 lengths = M_WQ.linear().colwise().stableNorm();
  if (!(lengths.minCoeff() > 0) || !lengths.allFinite()) return std::nullopt;
  const Matrix3 directions = M_WQ.linear() * lengths.cwiseInverse().asDiagonal();
  const Eigen::FullPivLU<Matrix3> lu{directions};
  if (!lu.isInvertible()) return std::nullopt;
  Eigen::Matrix<double, 3, 4> right;
  right.leftCols<3>() = M_WN.linear();
  right.col(3) = M_WN.translation() - M_WQ.translation();
  Affine M_QN = Affine::Identity();
  M_QN.affine() = lengths.cwiseInverse().asDiagonal() * lu.solve(right);
  if (!M_QN.affine().allFinite()) return std::nullopt;
  return M_QN;
}

}  // namespace

void Scene::set_parent(NodeId child, NodeId parent, Keep keep) {
  Impl& scene = *impl_;
  const std::uint32_t top = scene.at(child);
  const std::uint32_t above = scene.at(parent);
  PANTIN_EXPECTS(top != 0, "the root cannot be hung under another node (" + scene.called(above) + ")");
  PANTIN_EXPECTS(!scene.nodes.is_above(top, above),
                 "cycle: " + scene.called(above) + " is " + scene.called(top) +
                     " or below it and cannot become its parent; move it out of that subtree first");
  if (keep == Keep::World) {
    const std::optional<Affine> M_PN =
        solve_local(scene.world_for_edit(above).affine(), scene.world_for_edit(top).affine());
    PANTIN_EXPECTS(M_PN.has_value(),
                   "the world matrix of " + scene.called(above) + " is singular, so " + scene.called(top) +
                       " cannot keep its world matrix under it; give the parent a scale that is "
                       "not zero or keep the local matrix");
    scene.nodes.locals()[top] = Matrix34::from(*M_PN);
  }
  std::vector<std::uint32_t>& positions = scene.scratch;
  positions.clear();
  ++scene.shape;
  scene.nodes.collect(top, positions);
  for (const std::uint32_t at : positions) scene.dirty.clean(at, at + 1);
  // All of the subtree is in one run now, so marking its top covers the marks that were cleaned.
  scene.mark(scene.nodes.relocate(top, positions, above));
  scene.compact_if_mostly_holes();
}

NodeId Scene::parent(NodeId id) const {
  const std::uint32_t above = impl_->nodes.parent(impl_->at(id));
  return above == Impl::kNone ? NodeId{} : impl_->id(above);
}

std::vector<NodeId> Scene::children(NodeId id) const {
  std::vector<NodeId> ids;
  impl_->nodes.for_each_child(impl_->at(id), [&](std::uint32_t child) {
    ids.push_back(impl_->id(child));
    return true;
  });
  return ids;
}

std::vector<NodeId> Scene::subtree(NodeId id) const {
  std::vector<std::uint32_t> positions;
  impl_->nodes.collect(impl_->at(id), positions);
  std::vector<NodeId> ids;
  ids.reserve(positions.size());
  for (const std::uint32_t at : positions) ids.push_back(impl_->id(at));
  return ids;
}

bool Scene::is_above(NodeId ancestor, NodeId id) const {
  return impl_->nodes.is_above(impl_->at(ancestor), impl_->at(id));
}

}  // namespace pantin

#include "scenegraph_registry.hpp"

namespace pantin::bench {

void multiply_by_eigen(const double* a, const double* b, double* c) noexcept {
  using Rows = Eigen::Matrix<double, 3, 4, Eigen::RowMajor>;
  const Eigen::Map<const Rows> A{a};
  const Eigen::Map<const Rows> B{b};
  Eigen::Map<Rows> C{c};
  C.noalias() = A.leftCols<3>().lazyProduct(B);
  C.col(3) += A.col(3);
}

template <Pools pools>
Registry<pools>::Registry(const Crowd& crowd, MultiplyFunction* multiply) : multiply_{multiply} {
  for (Entity e = 0; e < crowd.parents.size(); ++e) {
    group_.insert(e);
    locals_set_.insert(e);
    worlds_set_.insert(e);
    relations_.push_back({.parent = e == 0 ? kNobody : crowd.parents[e]});
    locals_.push_back(crowd.locals[e]);
    worlds_.push_back(Matrix34{});
    if (e == 0) continue;
    Relationship& above = relations_[relation_at(crowd.parents[e])];
    if (above.first_child == kNobody) above.first_child = e;
    else relations_[relation_at(above.last_child)].next_sibling = e;
    above.last_child = e;
  }
  computed_.resize(crowd.parents.size());
  dirty_.insert(0);
}

template <Pools pools>
void Registry<pools>::set_locals(std::span<const Entity> entities, std::span<const Matrix34> locals) {
  for (std::size_t k = 0; k < entities.size(); ++k) {
    locals_[local_at(entities[k])] = locals[k];
    if (!dirty_.contains(entities[k])) dirty_.insert(entities[k]);
  }
}

template <Pools pools>
void Registry<pools>::compute(Entity e, const Relationship& relation) {
  Matrix34& world = worlds_[world_at(e)];
  const Matrix34& local = locals_[local_at(e)];
  if (relation.parent == kNobody) world = local;
  else multiply_(worlds_[world_at(relation.parent)].m.data(), local.m.data(), world.m.data());
}

template <Pools pools>
bool Registry<pools>::has_tag_above(Entity e) const {
  while ((e = relations_[relation_at(e)].parent) != kNobody)
    if (dirty_.contains(e)) return true;
  return false;
}

template <Pools pools>
void Registry<pools>::propagate(Entity top) {
  Entity e = top;
  while (true) {
    const Relationship* relation = &relations_[relation_at(e)];
    compute(e, *relation);
    if (relation->first_child != kNobody) {
      e = relation->first_child;
      continue;
    }
    while (e != top && relation->next_sibling == kNobody) {
      e = relation->parent;
      relation = &relations_[relation_at(e)];
    }
    if (e == top) return;
    e = relation->next_sibling;
  }
}

template <Pools pools>
void Registry<pools>::update_by_tags() {
  for (const Entity e : dirty_.packed())
    if (!has_tag_above(e)) propagate(e);
  dirty_.clear();
}

template <Pools pools>
void Registry<pools>::update_in_order() {
  if (dirty_.packed().empty()) return;
  for (std::uint32_t at = 0; at < relations_.size(); ++at) {
    const Relationship& relation = relations_[at];
    const bool above = relation.parent != kNobody && computed_[relation_at(relation.parent)] != 0;
    computed_[at] = above || dirty_.contains(group_.packed()[at]);
    if (computed_[at] != 0) compute(group_.packed()[at], relation);
  }
  dirty_.clear();
}

template class Registry<Pools::Single>;
template class Registry<Pools::Group>;

}  // namespace pantin::bench

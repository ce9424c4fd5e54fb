#pragma once
// A packed-array registry in the manner of EnTT, written for the benchmark: sparse sets with paged sparse
// arrays, dense component pools, a tag pool of what is dirty. Two ways of storing, as EnTT has them: each
// pool by itself, with a look-up for each component, or relationship, local and world as a full-owning group,
// whose pools keep one order so that one look-up serves all three. Either way the order is
// depth-first, as the crowd is created, which is the best it can have. Products are Eigen's, as one would
// write them, or the scene's own kernel's, which leaves the storage alone to compare.
#include <array>
#include <memory>
#include <span>
#include <vector>

#include <pantin/scenegraph/sweep.hpp>

#include "scenegraph_crowd.hpp"

namespace pantin::bench {

using Entity = std::uint32_t;
constexpr Entity kNobody = 0xffff'ffff;

class SparseSet {
 public:
  [[nodiscard]] bool contains(Entity e) const {
    const std::size_t page = e / kPage;
    return page < pages_.size() && pages_[page] && (*pages_[page])[e % kPage] != kNobody;
  }
  /// Where an entity that is contained stands in the packed arrays.
  [[nodiscard]] std::uint32_t index(Entity e) const { return (*pages_[e / kPage])[e % kPage]; }
  [[nodiscard]] const std::vector<Entity>& packed() const { return packed_; }
  void insert(Entity e) {
    const std::size_t page = e / kPage;
    if (page >= pages_.size()) pages_.resize(page + 1);
    if (!pages_[page]) {
      pages_[page] = std::make_unique<Page>();
      pages_[page]->fill(kNobody);
    }
    (*pages_[page])[e % kPage] = static_cast<std::uint32_t>(packed_.size());
    packed_.push_back(e);
  }
  void clear() {
    for (const Entity e : packed_) (*pages_[e / kPage])[e % kPage] = kNobody;
    packed_.clear();
  }

 private:
  static constexpr std::size_t kPage = 4096;
  using Page = std::array<std::uint32_t, kPage>;
  std::vector<std::unique_ptr<Page>> pages_{};
  std::vector<Entity> packed_{};
};

struct Relationship {
  Entity parent{kNobody}, first_child{kNobody}, last_child{kNobody}, next_sibling{kNobody};
};

/// c = a * b by Eigen.
void multiply_by_eigen(const double* a, const double* b, double* c) noexcept;

enum class Pools { Single, Group };

template <Pools pools>
class Registry {
 public:
  Registry(const Crowd& crowd, MultiplyFunction* multiply);

  void set_locals(std::span<const Entity> entities, std::span<const Matrix34> locals);
  /// From each tagged entity that has no tagged one above it, down the links to first child and next sibling:
  /// cost goes with what changed.
  void update_by_tags();
  /// One pass over the group, parents first, computing what is tagged or has a parent that was computed: cost
  /// goes with all entities, but memory is read in order.
  void update_in_order();
  [[nodiscard]] const Matrix34& world(Entity e) const { return worlds_[world_at(e)]; }

 private:
  [[nodiscard]] std::uint32_t relation_at(Entity e) const { return group_.index(e); }
  [[nodiscard]] std::uint32_t local_at(Entity e) const {
    return pools == Pools::Group ? group_.index(e) : locals_set_.index(e);
  }
  [[nodiscard]] std::uint32_t world_at(Entity e) const {
    return pools == Pools::Group ? group_.index(e) : worlds_set_.index(e);
  }
  void propagate(Entity top);
  void compute(Entity e, const Relationship& relation);
  [[nodiscard]] bool has_tag_above(Entity e) const;

  SparseSet group_{};  ///< order of the relationships and, in a group, of the other two
  SparseSet locals_set_{};
  SparseSet worlds_set_{};
  std::vector<Relationship> relations_{};
  std::vector<Matrix34> locals_{};
  std::vector<Matrix34> worlds_{};
  SparseSet dirty_{};
  std::vector<char> computed_{};
  MultiplyFunction* multiply_;
};

}  // namespace pantin::bench

// Bringing world matrices up to date. A dirty position stands for its whole subtree: its range within its
// run, and the tails hung below that range. One pass goes up the positions, taking whichever comes first, the
// next dirty position or the next tail whose parent was swept in this pass; as parents have lower positions,
// each matrix is computed once and after its parent's.
#include <algorithm>
#include <array>

#include <pantin/scenegraph/scene_impl.hpp>

namespace pantin {
namespace {

// Compaction costs a few ten nanoseconds a node. With these it happens so seldom that it costs about as much,
// over time, as what the holes and tails cost that it takes away: a hole is swept over, a tail is looked at
// by each update.
constexpr std::size_t kSlack = 32;          ///< holes and tails that any scene may have
constexpr std::size_t kNodesPerHole = 4;    ///< update compacts above one hole for so many positions
constexpr std::size_t kNodesPerTail = 256;  ///< update compacts above one tail for so many positions
constexpr std::size_t kSlackWhileEdited =
    1024;  ///< edits compact above so many holes plus half of all positions

}  // namespace

void Scene::Impl::compact() {
  ++shape;
  const std::vector<std::uint32_t> from = nodes.compact();
  DirtySet moved;
  moved.grow(from.size());
  for (std::uint32_t i = 0; i < from.size(); ++i)
    if (dirty.test(from[i])) moved.mark(i);
  dirty = std::move(moved);
  all_changed = true;
}

void Scene::compact() {
  impl_->compact();
  impl_->names.shrink_to_fit();
  impl_->scratch = std::vector<std::uint32_t>{};
  ++impl_->pending;  // the next update has to say that all nodes may stand elsewhere
}

void Scene::Impl::compact_if_mostly_holes() {
  if (nodes.holes() > kSlackWhileEdited + nodes.end() / 2) compact();
}

void Scene::update() {
  Impl& scene = *impl_;
  scene.changed.clear();
  if (scene.pending == 0) return;
  const std::size_t positions = scene.nodes.end();
  if (scene.nodes.holes() > kSlack + positions / kNodesPerHole ||
      scene.nodes.tails() > kSlack + positions / kNodesPerTail)
    scene.compact();
  scene.sweep_dirty();
  if (scene.all_changed) scene.changed.assign(1, {0, scene.nodes.end()});
  scene.all_changed = false;
  scene.pending = 0;
}

void Scene::Impl::sweep_dirty() {
  std::size_t tail = 0;
  std::uint32_t from = 0;
  while (true) {
    std::uint32_t begin = dirty.next(from);
    while (tail < nodes.tails() && nodes.tail(tail) < begin) {
      const std::uint32_t top = nodes.tail(tail++);
      if (top >= from && !nodes.is_hole(top) && was_swept(nodes.parent(top))) begin = top;
    }
    if (begin == DirtySet::kNone) break;
    const std::uint32_t end = begin + nodes.extent(begin);
    dirty.clean(begin, end);
    if (!changed.empty() && changed.back().end == begin) changed.back().end = end;
    else changed.push_back({begin, end});
    from = end;
    if (from == nodes.end()) break;
  }
  dirty.forget_lowest();
  climbed = 0;
  compute_worlds();
}

void Scene::Impl::compute_worlds() {
  static_assert(sizeof(Matrix34) == 12 * sizeof(double),
                "the kernels see the matrices as one run of doubles");
  if (changed.empty()) return;
  std::span<IndexRange> ranges = changed;
  const bool with_root = ranges.front().begin == 0;
  if (with_root) {
    // The root has no parent to be multiplied by.
    nodes.worlds()[0] = nodes.locals()[0];
    if (++ranges.front().begin == ranges.front().end) ranges = ranges.subspan(1);
  }
  // Without tails, parents of swept nodes lie in the same range or in none.
  SweepFunction* const sweep = nodes.tails() == 0 ? kernel.sweep_independent : kernel.sweep;
  sweep(nodes.locals().data()->m.data(), nodes.parents().data(), nodes.worlds().data()->m.data(),
        ranges.data(), ranges.size());
  if (with_root) changed.front().begin = 0;
}

bool Scene::Impl::was_swept(std::uint32_t at) const {
  const auto after =
      std::upper_bound(changed.begin(), changed.end(), at,
                       [](std::uint32_t position, const IndexRange& r) { return position < r.begin; });
  return after != changed.begin() && at < std::prev(after)->end;
}

Scene::Impl::Climb Scene::Impl::climb(std::uint32_t at) const {
  Climb climb;
  for (; at != kNone && at >= dirty.lowest(); at = nodes.parent(at)) {
    ++climb.steps;
    if (dirty.test(at)) climb.stale = climb.steps;
  }
  return climb;
}

Matrix34 Scene::Impl::read_through(std::uint32_t at, std::size_t stale) const {
  const std::vector<Matrix34>& worlds = nodes.worlds();
  if (stale == 0) return worlds[at];
  // Multiplied from the top down as `sweep` does, so the bits are those that the next update gives.
  std::array<std::uint32_t, 64> few{};
  std::vector<std::uint32_t> many(stale > few.size() ? stale : 0);
  std::uint32_t* chain = many.empty() ? few.data() : many.data();
  std::uint32_t above = at;
  for (std::size_t k = 0; k < stale; ++k, above = nodes.parent(above)) chain[k] = above;
  std::size_t k = stale - 1;
  Matrix34 M = above == kNone ? nodes.locals()[chain[k]] : multiply(worlds[above], nodes.locals()[chain[k]]);
  while (k-- > 0) M = multiply(M, nodes.locals()[chain[k]]);
  return M;
}

Matrix34 Scene::Impl::world_for_edit(std::uint32_t at) {
  Climb up = climb(at);
  climbed += up.steps;
  if (climbed > nodes.end()) {
    changed.clear();
    sweep_dirty();
    changed.clear();
    all_changed = true;
    up.stale = 0;
  }
  return read_through(at, up.stale);
}

Affine Scene::world(NodeId id) const {
  const std::uint32_t at = impl_->at(id);
  return impl_->read_through(at, impl_->climb(at).stale).affine();
}

std::span<const Matrix34> Scene::worlds() const noexcept { return impl_->nodes.worlds(); }
std::span<const NodeId> Scene::order() const noexcept { return impl_->nodes.order(); }
std::size_t Scene::index_of(NodeId id) const { return impl_->at(id); }
std::span<const IndexRange> Scene::changed() const noexcept { return impl_->changed; }

}  // namespace pantin

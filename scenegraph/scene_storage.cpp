#include <algorithm>
#include <utility>

#include <pantin/scenegraph/expects.hpp>
#include <pantin/scenegraph/scene_storage.hpp>

namespace pantin {

SceneStorage::SceneStorage() {
  const NodeId root = take_slot();
  slots_[root.index].position = push(kNone, root, Matrix34{}, Matrix34{});
}

NodeId SceneStorage::append(std::uint32_t parent, const Matrix34& local) {
  const NodeId id = take_slot();
  slots_[id.index].position = push(parent, id, local, Matrix34{});
  return id;
}

void SceneStorage::remove(std::uint32_t top, std::span<const std::uint32_t> positions) {
  for (const std::uint32_t at : positions) free_slot(order_[at]);
  vacate(top, positions);
}

std::uint32_t SceneStorage::relocate(std::uint32_t top, std::span<const std::uint32_t> positions,
                                     std::uint32_t parent) {
  for (const std::uint32_t at : positions) {
    // Parents come first, so the table already knows where the parent's copy is.
    const std::uint32_t above = at == top ? parent : position(order_[parent_[at]]);
    const Matrix34 local = local_[at];
    const Matrix34 world = world_[at];
    const NodeId id = order_[at];
    slots_[id.index].position = push(above, id, local, world);
  }
  const std::uint32_t now = position(order_[top]);
  vacate(top, positions);
  return now;
}

std::vector<std::uint32_t> SceneStorage::compact() {
  std::vector<std::uint32_t> from;
  from.reserve(alive());
  collect(0, from);
  const std::vector<std::uint32_t> parent = std::exchange(parent_, {});
  const std::vector<Matrix34> local = std::exchange(local_, {});
  const std::vector<Matrix34> world = std::exchange(world_, {});
  const std::vector<NodeId> order = std::exchange(order_, {});
  size_ = std::vector<std::uint32_t>{};
  tails_ = std::vector<Tail>{};
  tail_lists_.clear();
  holes_ = 0;
  last_open_ = kNone;
  reserve(from.size() + from.size() / kNodesPerSpare);
  slots_.shrink_to_fit();
  for (const std::uint32_t at : from) {
    const std::uint32_t above = at == 0 ? kNone : position(order[parent[at]]);
    slots_[order[at].index].position = push(above, order[at], local[at], world[at]);
  }
  return from;
}

void SceneStorage::reserve(std::size_t nodes) {
  parent_.reserve(nodes);
  size_.reserve(nodes);
  local_.reserve(nodes);
  world_.reserve(nodes);
  order_.reserve(nodes);
}

void SceneStorage::add_bytes(SceneMemory& memory) const noexcept {
  memory.matrices += (local_.capacity() + world_.capacity()) * sizeof(Matrix34);
  memory.topology +=
      (parent_.capacity() + size_.capacity()) * sizeof(std::uint32_t) + tails_.capacity() * sizeof(Tail);
  if (!tail_lists_.empty())
    memory.topology += tail_lists_.bucket_count() * sizeof(void*) +
                       tail_lists_.size() * (sizeof(void*) + sizeof(std::pair<std::uint32_t, TailList>));
  memory.ids += order_.capacity() * sizeof(NodeId) + slots_.capacity() * sizeof(Slot);
}

void SceneStorage::collect(std::uint32_t top, std::vector<std::uint32_t>& out) const {
  struct Range {
    std::uint32_t begin{0};
    std::uint32_t end{0};
  };
  std::vector<Range> rest;  // what is still to be visited, the next on top; grows only where tails hang
  std::vector<Range> hung;
  Range range{top, top + extent(top)};
  while (true) {
    if (range.begin >= range.end) {
      if (rest.empty()) return;
      range = rest.back();
      rest.pop_back();
      continue;
    }
    const std::uint32_t at = range.begin;
    if (is_hole(at)) {
      range.begin += size_[at];
      continue;
    }
    out.push_back(at);
    ++range.begin;
    const std::uint32_t first = first_tail(at);
    if (first == kNone) continue;
    hung.clear();
    for (std::uint32_t k = first; k != kNone; k = tails_[k].next)
      if (!is_hole(tails_[k].top)) hung.push_back({tails_[k].top, tails_[k].top + extent(tails_[k].top)});
    const std::uint32_t inside = at + extent(at);
    rest.push_back({inside, range.end});
    rest.insert(rest.end(), hung.rbegin(), hung.rend());
    range.end = inside;
  }
}

bool SceneStorage::is_above(std::uint32_t ancestor, std::uint32_t at) const noexcept {
  while (at != kNone && at >= ancestor) {
    if (at < ancestor + extent(ancestor)) return true;
    at = parent_[run_top(at)];
  }
  return false;
}

std::uint32_t SceneStorage::push(std::uint32_t parent, NodeId id, const Matrix34& local,
                                 const Matrix34& world) {
  const std::uint32_t at = end();
  PANTIN_EXPECTS(at < kNone - 1, "a scene holds at most 2^32 - 2 nodes; split it");
  const bool extends_run = parent != kNone && size_[parent] == kOpen;
  close_down_to(extends_run ? parent : kNone);
  if (parent != kNone && !extends_run) hang_tail(at, parent);
  parent_.push_back(parent);
  size_.push_back(kOpen);
  local_.push_back(local);
  world_.push_back(world);
  order_.push_back(id);
  last_open_ = at;
  return at;
}

void SceneStorage::close_down_to(std::uint32_t kept) noexcept {
  while (last_open_ != kept) {
    size_[last_open_] = end() - last_open_;
    const std::uint32_t above = parent_[last_open_];
    last_open_ = above != kNone && size_[above] == kOpen ? above : kNone;
  }
}

void SceneStorage::hang_tail(std::uint32_t top, std::uint32_t parent) {
  const std::uint32_t index = static_cast<std::uint32_t>(tails_.size());
  tails_.push_back({top, kNone});
  TailList& list = tail_lists_[parent];
  if (list.last == kNone) list.first = index;
  else tails_[list.last].next = index;
  list.last = index;
}

void SceneStorage::vacate(std::uint32_t top, std::span<const std::uint32_t> positions) {
  const std::uint32_t above = parent_[top];
  const bool was_open = size_[top] == kOpen;
  for (const std::uint32_t at : positions) {
    size_[at] = extent(at);
    order_[at] = NodeId{};
    if (!tail_lists_.empty()) tail_lists_.erase(at);
  }
  holes_ += positions.size();
  if (last_open_ != kNone && is_hole(last_open_))
    last_open_ = was_open && size_[above] == kOpen ? above : kNone;
}

std::uint32_t SceneStorage::first_tail(std::uint32_t at) const {
  if (tail_lists_.empty()) return kNone;
  const auto found = tail_lists_.find(at);
  return found == tail_lists_.end() ? kNone : found->second.first;
}

std::uint32_t SceneStorage::run_top(std::uint32_t at) const noexcept {
  const auto after =
      std::upper_bound(tails_.begin(), tails_.end(), at,
                       [](std::uint32_t position, const Tail& tail) { return position < tail.top; });
  return after == tails_.begin() ? 0 : std::prev(after)->top;
}

NodeId SceneStorage::take_slot() {
  std::uint32_t index = free_slot_;
  if (index == kNone) {
    index = static_cast<std::uint32_t>(slots_.size());
    slots_.emplace_back();
  } else {
    free_slot_ = slots_[index].position;
  }
  return {index, ++slots_[index].generation};
}

void SceneStorage::free_slot(NodeId id) noexcept {
  Slot& slot = slots_[id.index];
  ++slot.generation;
  if (slot.generation == 0) return;  // all generations used up: the slot is retired, so no id ever comes back
  slot.position = free_slot_;
  free_slot_ = id.index;
}

}  // namespace pantin

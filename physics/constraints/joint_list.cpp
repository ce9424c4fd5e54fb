// The list of joints of the constraint manager: ids, neighbours, loops.
#include <algorithm>
#include <unordered_set>

#include <pantin/physics/constraints/constraint_manager.hpp>
#include <pantin/physics/expects.hpp>

namespace pantin {

JointId ConstraintManager::add(JointDefinition joint) {
  std::uint32_t slot = 0;
  if (free_.empty()) {
    slot = static_cast<std::uint32_t>(generation_.size());
    generation_.push_back(0);
    position_of_.push_back(0);
  } else {
    slot = free_.back();
    free_.pop_back();
  }
  const JointId id{slot, ++generation_[slot]};
  position_of_[slot] = static_cast<std::uint32_t>(joints_.size());
  for (const BodyId body : {joint.a, joint.b}) {
    if (!body) continue;
    if (joints_of_.size() <= body.index) joints_of_.resize(body.index + 1);
    joints_of_[body.index].push_back(id);
  }
  joints_.push_back(std::make_unique<JointDefinition>(std::move(joint)));
  ids_.push_back(id);
  last_.emplace_back();
  motors_.emplace_back();
  list_storing();
  return id;
}

void ConstraintManager::remove(JointId id) {
  const std::size_t j = at(id);
  couplings_.remove_of(id);
  for (const BodyId body : {joints_[j]->a, joints_[j]->b}) {
    if (body) std::erase(joints_of_[body.index], id);
  }
  // Order decides the layout and with it the bits of the result: joints behind move up.
  joints_.erase(joints_.begin() + static_cast<std::ptrdiff_t>(j));
  ids_.erase(ids_.begin() + static_cast<std::ptrdiff_t>(j));
  last_.erase(last_.begin() + static_cast<std::ptrdiff_t>(j));
  motors_.erase(motors_.begin() + static_cast<std::ptrdiff_t>(j));
  list_storing();
  for (std::size_t k = j; k < ids_.size(); ++k) position_of_[ids_[k].index] = static_cast<std::uint32_t>(k);
  ++generation_[id.index];
  free_.push_back(id.index);
}

bool ConstraintManager::contains(JointId id) const noexcept {
  return id && id.index < generation_.size() && generation_[id.index] == id.generation;
}

std::size_t ConstraintManager::at(JointId id) const {
  PANTIN_EXPECTS(contains(id), "joint " + std::to_string(id.index) + "." + std::to_string(id.generation) +
                                   " does not exist (any more): it is null, or was removed");
  return position_of_[id.index];
}

std::vector<JointId> ConstraintManager::joints_of(BodyId body) const {
  return body.index < joints_of_.size() ? joints_of_[body.index] : std::vector<JointId>{};
}

namespace {

bool is_ground(const BodyStore& bodies, BodyId id) {
  return !id || bodies.kinds[bodies.at(id)] != BodyKind::Simulated;
}

/// Simulated bodies reached so far from a start, and whether ground was met.
struct Search {
  std::vector<BodyId> open{};
  std::unordered_set<BodyId> seen{};
  bool grounded{false};

  explicit Search(BodyId start) : open{start}, seen{start} {}
};

}  // namespace

bool ConstraintManager::closes_loop(const BodyStore& bodies, BodyId a, BodyId b) const {
  const bool a_is_ground = is_ground(bodies, a), b_is_ground = is_ground(bodies, b);
  if (a_is_ground && b_is_ground) return false;
  const auto grow = [&](Search& search) {
    const BodyId body = search.open.back();
    search.open.pop_back();
    for (const JointId id : joints_of(body)) {
      const JointDefinition& joint = *joints_[at(id)];
      const BodyId other = joint.a == body ? joint.b : joint.a;
      if (is_ground(bodies, other)) {
        search.grounded = true;
      } else if (search.seen.insert(other).second) {
        search.open.push_back(other);
      }
    }
  };
  if (a_is_ground || b_is_ground) {
    Search search{a_is_ground ? b : a};
    while (!search.open.empty() && !search.grounded) grow(search);
    return search.grounded;
  }
  // Both ends grow in turn, so that joining something small to something large costs what the small one is.
  Search from_a{a}, from_b{b};
  while (!from_a.open.empty() && !from_b.open.empty()) {
    grow(from_a);
    grow(from_b);
  }
  Search& small = from_a.open.empty() ? from_a : from_b;
  Search& large = from_a.open.empty() ? from_b : from_a;
  if (small.seen.contains(&small == &from_a ? b : a)) return true;
  while (small.grounded && !large.open.empty() && !large.grounded) grow(large);
  return small.grounded && large.grounded;
}

}  // namespace pantin

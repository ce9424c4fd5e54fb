// Prim's algorithm, which gives the same total whatever the order among equals (R. C. Prim, Bell System Tech.
// J. 36, 1389 (1957)), so that the order among equals is free to keep trees shallow.
#include <pantin/physics/constraints/spanning_tree.hpp>

#include <algorithm>
#include <numeric>
#include <queue>

#include <pantin/physics/constraints/joint_models.hpp>
#include <pantin/physics/disjoint_sets.hpp>

namespace pantin {

namespace {

bool is_guarded(const JointDefinition& joint) {
  return std::any_of(joint.axes.begin(), joint.axes.end(),
                     [](const JointAxis& axis) { return axis.has_stops() || axis.friction > 0; });
}

/// Rows that a joint costs where it is cut. A rotor there would be one more row that has to be told what it
/// brings along into an impulse: other joints are cut first.
int worth_keeping(const JointDefinition& joint) {
  const bool turns_rotor =
      std::any_of(joint.axes.begin(), joint.axes.end(), [](const JointAxis& a) { return a.armature > 0; });
  return row_count(joint.kind) + (turns_rotor ? 6 : 0);
}

/// Bodies as nodes, and one more node for all that is not simulated.
class Spanner {
 public:
  Spanner(const BodyStore& bodies, std::span<const JointDefinition* const> joints,
          std::span<const JointCoupling> couplings)
      : bodies_{bodies}, joints_{joints}, couplings_{couplings}, ground_{bodies.size()} {
    found_.is_cut.assign(joints.size(), 0);
    found_.mechanism.assign(bodies.size(), -1);
    ends_.reserve(joints.size());
    for (const JointDefinition* joint : joints) ends_.push_back({node_of(joint->a), node_of(joint->b)});
    is_coupled_.assign(joints.size(), false);
    for (const JointCoupling& coupling : couplings) is_coupled_[coupling.a] = is_coupled_[coupling.b] = true;
  }

  SpanningTree span() {
    if (!number_mechanisms()) return std::move(found_);
    list_neighbours();
    reached_.assign(bodies_.size() + 1, 0);
    depth_.assign(bodies_.size() + 1, 0);
    found_.is_cut.assign(joints_.size(), 1);
    for (std::size_t j = 0; j < joints_.size(); ++j) found_.is_cut[j] = is_in_loops(j) ? 1 : 0;
    grow(ground_);
    // What floats: from a body that no joint carries, else from the first.
    for (const bool carried : {false, true}) {
      for (std::size_t i = 0; i < bodies_.size(); ++i) {
        if (found_.mechanism[i] >= 0 && reached_[i] == 0 && is_carried_[i] == carried) grow(i);
      }
    }
    return std::move(found_);
  }

 private:
  struct Candidate {
    bool guarded{false};  ///< stops and dry friction act on what is not cut
    int rows{0};
    std::int32_t depth{0};
    std::size_t joint{0}, to{0};
    /// Whether it comes after the other.
    bool operator<(const Candidate& o) const {
      if (guarded != o.guarded) return !guarded;
      if (rows != o.rows) return rows < o.rows;
      if (depth != o.depth) return depth > o.depth;
      return joint > o.joint;
    }
  };

  [[nodiscard]] std::size_t node_of(BodyId id) const {
    if (!id) return ground_;
    const std::size_t i = bodies_.at(id);
    return bodies_.kinds[i] == BodyKind::Simulated ? i : ground_;
  }
  [[nodiscard]] std::size_t body_of(std::size_t j) const {
    return ends_[j].first == ground_ ? ends_[j].second : ends_[j].first;
  }
  [[nodiscard]] bool is_in_loops(std::size_t j) const {
    const std::size_t body = body_of(j);
    return body != ground_ && found_.mechanism[body] >= 0;
  }

  /// Rows that a cut would cost, as if a coupled joint had more than any other.
  [[nodiscard]] int weight(std::size_t j) const {
    return worth_keeping(*joints_[j]) + (is_coupled_[j] ? kMostRates : 0);
  }

  /// Numbers the sets of simulated bodies, joined without the ground, in which some joint closes a loop or is
  /// coupled.
  bool number_mechanisms() {
    DisjointSets with_ground{bodies_.size() + 1}, group{bodies_.size() + 1};
    std::vector<std::size_t> closing;
    for (std::size_t j = 0; j < joints_.size(); ++j) {
      const auto [a, b] = ends_[j];
      if (a == ground_ && b == ground_) continue;
      if (!with_ground.join(a, b)) closing.push_back(j);
      if (a != ground_ && b != ground_) group.join(a, b);
    }
    for (const JointCoupling& coupling : couplings_) {
      const std::size_t x = body_of(coupling.a), y = body_of(coupling.b);
      if (x == ground_ || y == ground_) continue;
      group.join(x, y);
      closing.push_back(coupling.b);
    }
    std::vector<std::int32_t> number(bodies_.size() + 1, -1);
    for (const std::size_t j : closing) {
      std::int32_t& n = number[group.root(body_of(j))];
      if (n < 0) n = found_.mechanisms++;
    }
    for (std::size_t i = 0; found_.has_loops() && i < bodies_.size(); ++i) {
      found_.mechanism[i] = number[group.root(i)];
    }
    return found_.has_loops();
  }

  void list_neighbours() {
    first_.assign(bodies_.size() + 2, 0);
    is_carried_.assign(bodies_.size(), false);
    for (std::size_t j = 0; j < joints_.size(); ++j) {
      if (!is_in_loops(j)) continue;
      ++first_[ends_[j].first + 1], ++first_[ends_[j].second + 1];
      if (ends_[j].second != ground_) is_carried_[ends_[j].second] = true;
    }
    std::partial_sum(first_.begin(), first_.end(), first_.begin());
    std::vector<std::size_t> next(first_.begin(), first_.end() - 1);
    neighbours_.resize(first_.back());
    for (std::size_t j = 0; j < joints_.size(); ++j) {
      if (!is_in_loops(j)) continue;
      neighbours_[next[ends_[j].first]++] = j;
      neighbours_[next[ends_[j].second]++] = j;
    }
  }

  void grow(std::size_t start) {
    reached_[start] = 1;
    offer(start);
    while (!open_.empty()) {
      const Candidate best = open_.top();
      open_.pop();
      if (reached_[best.to] != 0) continue;
      reached_[best.to] = 1;
      depth_[best.to] = best.depth + 1;
      found_.is_cut[best.joint] = 0;
      offer(best.to);
    }
  }

  void offer(std::size_t from) {
    for (std::size_t k = first_[from]; k < first_[from + 1]; ++k) {
      const std::size_t j = neighbours_[k], to = ends_[j].first == from ? ends_[j].second : ends_[j].first;
      if (reached_[to] == 0) open_.push({is_guarded(*joints_[j]), weight(j), depth_[from], j, to});
    }
  }

  const BodyStore& bodies_;
  std::span<const JointDefinition* const> joints_;
  std::span<const JointCoupling> couplings_;
  std::vector<bool> is_coupled_{};
  std::size_t ground_{0};
  SpanningTree found_{};
  std::vector<std::pair<std::size_t, std::size_t>> ends_{};
  std::vector<std::size_t> first_{}, neighbours_{};
  std::vector<bool> is_carried_{};
  std::vector<std::uint8_t> reached_{};
  std::vector<std::int32_t> depth_{};
  std::priority_queue<Candidate> open_{};
};

}  // namespace

int row_count(JointKind kind) noexcept {
  int rates = 0;
  JointDefinition joint;
  joint.kind = kind;
  with_model(joint, [&rates](auto model) { rates = decltype(model)::kRates; });
  return 6 - rates;
}

SpanningTree span_trees(const BodyStore& bodies, std::span<const JointDefinition* const> joints,
                        std::span<const JointCoupling> couplings) {
  return Spanner{bodies, joints, couplings}.span();
}

}  // namespace pantin

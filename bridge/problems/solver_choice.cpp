#include <pantin/bridge/problems/solver_choice.hpp>

#include <algorithm>
#include <map>

#include <pantin/physics/disjoint_sets.hpp>
#include <pantin/physics/setting_checks.hpp>

namespace pantin {
namespace {

using namespace reference;

/// Bodies and particles that something couples; world and animated bodies couple nothing, but loops may close
/// through them.
class Islands {
 public:
  explicit Islands(const Problem& problem) {
    for (const Body& body : problem.bodies) add(body.name);
    for (const Particle& particle : problem.particles) add(particle.name);
    const std::size_t ground = names_.size();
    DisjointSets coupled{ground + 1}, jointed{ground + 1};
    const auto couple = [&](const std::string& a, const std::string& b) {
      const auto at_a = index_.find(a), at_b = index_.find(b);
      if (at_a != index_.end() && at_b != index_.end()) coupled.join(at_a->second, at_b->second);
    };
    std::vector<std::size_t> closing;
    for (const Joint& joint : problem.joints) {
      couple(joint.a, joint.b);
      const auto at_a = index_.find(joint.a), at_b = index_.find(joint.b);
      const std::size_t a = at_a == index_.end() ? ground : at_a->second;
      const std::size_t b = at_b == index_.end() ? ground : at_b->second;
      if (!jointed.join(a, b)) closing.push_back(a == ground ? b : a);
    }
    for (const Force& force : problem.forces) {
      if (const auto* spring = std::get_if<Spring>(&force)) couple(spring->a.body, spring->b.body);
    }
    for (const Contact& contact : problem.contacts) {
      if (const auto* pair = std::get_if<CapsulePair>(&contact.pair)) couple(pair->a, pair->b);
    }
    collect(coupled, closing);
  }

  struct Island {
    std::vector<std::string> names{};
    bool has_loop{false};
  };
  /// In the order of the problem.
  [[nodiscard]] std::vector<Island>& list() { return islands_; }

 private:
  void add(const std::string& name) {
    index_.emplace(name, names_.size());
    names_.push_back(name);
  }
  void collect(DisjointSets& coupled, const std::vector<std::size_t>& closing) {
    std::map<std::size_t, std::size_t> order;
    for (std::size_t i = 0; i < names_.size(); ++i) {
      const auto [place, is_new] = order.emplace(coupled.root(i), islands_.size());
      if (is_new) islands_.emplace_back();
      islands_[place->second].names.push_back(names_[i]);
    }
    for (const std::size_t i : closing) islands_[order.at(coupled.root(i))].has_loop = true;
  }

  std::vector<std::string> names_{};
  std::map<std::string, std::size_t> index_{};
  std::vector<Island> islands_{};
};

/// How fast a force on a point of a body moves it, at most [1/kg]; 0 for what no force moves.
double mobility(const Problem& problem, const SpringEnd& end) {
  for (const Body& body : problem.bodies) {
    if (body.name != end.body) continue;
    return 1 / body.mass.mass + end.point.squaredNorm() * body.mass.I_BBcm_B.inverse().norm();
  }
  for (const Particle& particle : problem.particles) {
    if (particle.name == end.body) return 1 / particle.mass;
  }
  return 0;
}

/// The fastest rate at which a damper between `names` lets motion decay, were nothing else there [1/s].
double fastest_decay(const Problem& problem, const std::vector<std::string>& names) {
  double fastest = 0;
  const auto is_here = [&](const std::string& name) {
    return std::find(names.begin(), names.end(), name) != names.end();
  };
  for (const Force& force : problem.forces) {
    if (const auto* spring = std::get_if<Spring>(&force);
        spring != nullptr && (is_here(spring->a.body) || is_here(spring->b.body))) {
      fastest =
          std::max(fastest, spring->damping * (mobility(problem, spring->a) + mobility(problem, spring->b)));
    }
    if (const auto* drag = std::get_if<Drag>(&force); drag != nullptr && is_here(drag->body)) {
      const double rate = drag->coefficient * mobility(problem, {.body = drag->body});
      fastest = std::max(fastest, rate);
    }
  }
  return fastest;
}

/// Explicit iterations need a step for every few decay times: from so many of them on, that costs more than
/// an implicit method.
constexpr double kManyDecayTimes = 5e4;

/// Below this tolerance sixteenth order needs fewer evaluations than eighth.
constexpr double kHighOrderBelow = 1e-6;

}  // namespace

std::vector<IslandChoice> choose_solvers(const ReferenceProblem& problem, double tolerance) {
  std::vector<IslandChoice> choices;
  Islands islands{problem};
  for (Islands::Island& island : islands.list()) {
    IslandChoice choice{.bodies = std::move(island.names), .has_loop = island.has_loop};
    if (const double decay = fastest_decay(problem, choice.bodies);
        decay * problem.duration > kManyDecayTimes) {
      choice.solver = "radau";
      choice.reason =
          "motion that decays at up to " + text_of(decay) + " /s, far faster than the problem lasts";
    } else {
      const bool high = tolerance < kHighOrderBelow;
      choice.solver = high ? "gauss16" : "gauss8";
      choice.reason = "smooth motion at tolerance " + text_of(tolerance) +
                      (high ? ", where order 16 needs the fewest evaluations"
                            : ", where order 8 needs the fewest evaluations");
    }
    choices.push_back(std::move(choice));
  }
  return choices;
}

}  // namespace pantin

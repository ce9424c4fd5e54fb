#include <pantin/bridge/problems/solver_choice.hpp>

#include <map>

#include <pantin/physics/setting_checks.hpp>

namespace pantin {
namespace {

using namespace reference;

/// Groups of names that something couples; world and animated bodies couple nothing.
class Groups {
 public:
  explicit Groups(const Problem& problem) {
    for (const Body& body : problem.bodies) add(body.name);
    for (const Particle& particle : problem.particles) add(particle.name);
    for (const Joint& joint : problem.joints) couple(joint.a, joint.b);
    for (const Force& force : problem.forces) {
      if (const auto* spring = std::get_if<Spring>(&force)) couple(spring->a.body, spring->b.body);
    }
    for (const Contact& contact : problem.contacts) {
      if (const auto* pair = std::get_if<CapsulePair>(&contact.pair)) couple(pair->a, pair->b);
    }
  }

  /// Names by group, groups and names in the order of the problem.
  [[nodiscard]] std::vector<std::vector<std::string>> names() {
    std::map<std::size_t, std::size_t> order;
    std::vector<std::vector<std::string>> groups;
    for (std::size_t i = 0; i < names_.size(); ++i) {
      const auto [place, is_new] = order.emplace(root(i), groups.size());
      if (is_new) groups.emplace_back();
      groups[place->second].push_back(names_[i]);
    }
    return groups;
  }

 private:
  void add(const std::string& name) {
    index_.emplace(name, names_.size());
    parent_.push_back(names_.size());
    names_.push_back(name);
  }
  std::size_t root(std::size_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void couple(const std::string& a, const std::string& b) {
    const auto at_a = index_.find(a), at_b = index_.find(b);
    if (at_a != index_.end() && at_b != index_.end()) parent_[root(at_a->second)] = root(at_b->second);
  }

  std::vector<std::string> names_{};
  std::vector<std::size_t> parent_{};
  std::map<std::string, std::size_t> index_{};
};

/// Below this tolerance sixteenth order needs fewer evaluations than eighth.
constexpr double kHighOrderBelow = 1e-6;

}  // namespace

std::vector<IslandChoice> choose_solvers(const ReferenceProblem& problem, double tolerance) {
  std::vector<IslandChoice> choices;
  for (std::vector<std::string>& names : Groups{problem}.names()) {
    IslandChoice choice{.bodies = std::move(names)};
    const bool high = tolerance < kHighOrderBelow;
    choice.solver = high ? "gauss16" : "gauss8";
    choice.reason = "smooth motion at tolerance " + text_of(tolerance) +
                    (high ? ", where order 16 needs the fewest evaluations"
                          : ", where order 8 needs the fewest evaluations");
    choices.push_back(std::move(choice));
  }
  return choices;
}

}  // namespace pantin

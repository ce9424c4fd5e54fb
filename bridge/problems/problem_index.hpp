#pragma once
// Looks up what a name of a reference problem stands for. Private to the reader of reference problems.
#include <cstddef>
#include <map>
#include <string>

#include <pantin/bridge/problems/reference_problem.hpp>

namespace pantin::reference {

enum class NameKind { Unknown, World, Body, Particle, KinematicBody };

class ProblemIndex {
 public:
  explicit ProblemIndex(const Problem& problem) {
    entries_.emplace(kWorld, Entry{NameKind::World, 0});
    for (std::size_t i = 0; i < problem.bodies.size(); ++i) add(problem.bodies[i].name, NameKind::Body, i);
    for (std::size_t i = 0; i < problem.particles.size(); ++i) {
      add(problem.particles[i].name, NameKind::Particle, i);
    }
    for (std::size_t i = 0; i < problem.kinematic_bodies.size(); ++i) {
      add(problem.kinematic_bodies[i].name, NameKind::KinematicBody, i);
    }
  }

  struct Entry {
    NameKind kind{NameKind::Unknown};
    std::size_t position{0};  ///< in the problem's list of that kind
  };
  /// The first that bears the name.
  [[nodiscard]] Entry find(const std::string& name) const {
    const auto found = entries_.find(name);
    return found == entries_.end() ? Entry{} : found->second;
  }

 private:
  void add(const std::string& name, NameKind kind, std::size_t position) {
    entries_.emplace(name, Entry{kind, position});
  }
  std::map<std::string, Entry> entries_;
};

}  // namespace pantin::reference

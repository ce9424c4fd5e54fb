#pragma once
// Which bodies of a problem move on their own, and which integrator suits them.
#include <string>
#include <vector>

#include <pantin/bridge/problems/reference_problem.hpp>

namespace pantin {

/// Bodies and particles that joints and forces couple, none with what stands outside.
struct IslandChoice {
  std::vector<std::string> bodies{};  ///< names, particles included, in the order of the problem
  bool has_loop{false};               ///< joints that close a loop
  std::string solver{};               ///< an integrator's name
  std::string reason{};               ///< in words
  bool shares_steps{false};           ///< it is integrated in steps in common with other islands
};

/// The islands of a problem, in the order of their first bodies, each with the integrator that suits it at
/// this tolerance [m/s, rad/s].
[[nodiscard]] std::vector<IslandChoice> choose_solvers(const ReferenceProblem& problem, double tolerance);

}  // namespace pantin

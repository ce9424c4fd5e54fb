#pragma once
// What efforts along rates do to all rates of a tree: columns of M^-1, with all joints and loops exact,
// through the factor of the elimination. The same numbers tell what impulses do to rates and what efforts do
// to their derivatives.
#include <span>
#include <vector>

#include <pantin/physics/constraints/constraint_manager.hpp>

namespace pantin {

class AxisResponse {
 public:
  explicit AxisResponse(ConstraintManager& constraints) : constraints_{constraints} {}

  /// Factors a tree at coordinates q (of all trees). Nothing is locked; what the kernel held is forgotten.
  void factor(const Tree& tree, std::span<const RigidMotion> grounds, Instant at, std::span<const double> q);
  /// One effort [N m or N] along a rate of a link of the tree; several add up until `respond`.
  void push(std::uint32_t link, std::uint32_t rate, double effort);
  /// Change of the tree's rates by the efforts pushed, in `out` of all trees. Then there are none again.
  void respond(std::span<double> out);

 private:
  void substitute(std::span<double> out);

  ConstraintManager& constraints_;
  const Tree* tree_{nullptr};
  std::span<const RigidMotion> grounds_{};
  Instant at_{};
  std::span<const double> q_{};
  std::vector<double> zero_{}, driven_{};
};

}  // namespace pantin

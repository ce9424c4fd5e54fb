#pragma once
// How q' and v' change with q and v: what implicit methods linearise by. Numbers that do not touch each other
// fall into groups, and only the block of each group is there.
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <pantin/physics/driver.hpp>

namespace pantin {

/// A time at which the derivative is wanted, and from which side (at the ends of a step motions may break).
struct Instant {
  double t{0};  ///< [s]
  Side side{Side::After};
};

/// The numbers of (q, v), counted through, in groups: q' and v' of a group depend on its own numbers alone.
/// Coordinates are best listed before velocities (GroupSolver).
class NumberGroups {
 public:
  void clear();
  /// Adds numbers to the group that is being listed.
  void add(std::size_t first, std::size_t count);
  /// Ends the group that is being listed; one without numbers is none.
  void end_group();

  [[nodiscard]] std::size_t size() const noexcept { return ends_.size(); }
  [[nodiscard]] std::span<const std::uint32_t> group(std::size_t g) const;
  [[nodiscard]] std::size_t numbers() const noexcept { return numbers_.size(); }
  [[nodiscard]] std::size_t largest() const noexcept;  ///< numbers in the greatest group

 private:
  std::vector<std::uint32_t> numbers_{};  ///< group by group
  std::vector<std::size_t> ends_{};       ///< of each group in numbers_
};

/// d(q', v') / d(q, v): a dense block for each group.
class Jacobian {
 public:
  NumberGroups groups{};

  /// Zero blocks for the groups of now. Allocates only where they need more room than ever before.
  void fit();
  /// Row i and column j of a group's block stand at [j * k + i], with k numbers in the group.
  [[nodiscard]] std::span<double> block(std::size_t g) {
    return std::span{entries_}.subspan(begins_[g], begins_[g + 1] - begins_[g]);
  }
  [[nodiscard]] std::span<const double> block(std::size_t g) const {
    return std::span{entries_}.subspan(begins_[g], begins_[g + 1] - begins_[g]);
  }

  /// All blocks, one after the other.
  [[nodiscard]] std::span<const double> entries() const noexcept { return entries_; }

 private:
  std::vector<double> entries_{};
  std::vector<std::size_t> begins_{};
};

/// Where a Jacobian is wanted.
struct JacobianPoint {
  Instant at{};
  std::span<const double> q{}, v{};
  std::span<const double> slope{};  ///< q' and v' there
  std::span<const double>
      change{};  ///< of each number, > 0: what it is changed by where differences are taken
};

}  // namespace pantin

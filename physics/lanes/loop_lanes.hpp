#pragma once
// Closed loops and couplings of joints in lanes: what ClosureSolver does, at several stages at once.
#include <pantin/physics/constraints/closure_rows.hpp>
#include <pantin/physics/constraints/row_layout.hpp>
#include <pantin/physics/lanes/tree_lanes.hpp>

namespace pantin::lanes {

struct ClosureEndConstants {
  std::int32_t link{-1};    ///< -1 = ground
  std::int32_t ground{-1};  ///< number of the ground's given motion; -1 = the world at rest
  double R_LJ[9]{}, p_LJ[3]{};
};

/// A closure's constants as the kernel reads them: plain numbers.
struct ClosureConstants {
  JointKind kind{JointKind::Fixed};
  std::uint32_t row{0};                  ///< its first, of those of all trees
  std::uint32_t rows{0}, rigid_rows{0};  ///< all; those that are not rotors'
  ClosureEndConstants a{}, b{};          ///< of a coupling the links that its joints tie
  double pitch{0};                       ///< [m/rad] of a screw
  kernel::Rotors rotors{};
  std::int32_t given{-1};     ///< number of the given motion of a driven joint; -1 = none
  std::int32_t coupling{-1};  ///< number among the couplings; -1 = a cut joint
  std::uint32_t path_begin{0}, path_end{0}, path_rates{0};
  std::size_t y{0};  ///< RowLayout::Place::y
};

/// How the row of a coupling changes with the rates, at every stage: number k of lane l at [k * lanes + l].
/// By rate of the joint of a, of that of b, then the row's acceleration where the rates stay: 7 numbers.
constexpr std::size_t kCouplingNumbers = 7;

/// Of the largest tree with closures.
struct LoopSizes {
  std::size_t links{0}, rows{0}, y{0}, entries{0}, longest_path{0};
  void include(const TreeLayout& layout, const RowLayout& rows, const Tree& tree);
};

/// What the kernel works on besides a Task: the closures `begin` to `end` of the same tree.
struct LoopTask {
  const ClosureConstants* closures{nullptr};
  std::uint32_t begin{0}, end{0};
  const PathLink* paths{nullptr};
  const double* couplings{nullptr};
  Envelope envelope{};
  LoopSizes sizes{};      ///< as the work space has been made for
  double* work{nullptr};  ///< 64-byte aligned
};

/// The constants of all closures of a layout. Their grounds (a's before b's) and drivers are numbered on from
/// `given`. Returns how many there are then.
std::int32_t fill_closures(const TreeLayout& layout, const RowLayout& rows, const BodyStore& bodies,
                           std::int32_t given, std::vector<ClosureConstants>& closures);

}  // namespace pantin::lanes

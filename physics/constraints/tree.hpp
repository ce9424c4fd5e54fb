#pragma once
// Joined bodies as the solver sees them: trees of links, parents first. A link is one body or several that
// Fixed joints make one; its frame L sits at the joint that ties it to its parent. Bodies that are not
// simulated are ground: a tree hangs on one of them, or floats, or, where closed loops of joints are cut or
// joints are coupled, on several.
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <pantin/physics/body_store.hpp>
#include <pantin/physics/constraints/joint.hpp>
#include <pantin/physics/constraints/kernel_math.hpp>

namespace pantin {

/// A body of a link.
struct TreeMember {
  std::uint32_t body{0};  ///< position in the body store
  Pose X_LB{};            ///< body origin in the link
};

struct TreeLink {
  std::int32_t parent{-1};  ///< link nearer to the root; -1 = ground
  std::int32_t ground{-1};  ///< body position of the ground of a root link; -1 = the world
  std::int32_t joint{-1};   ///< position of the joint that ties it; -1 = floating root
  JointKind kind{JointKind::Fixed};
  bool reversed{false};      ///< the joint's b is on the parent's side
  std::uint32_t q{0}, v{0};  ///< where its coordinates and rates begin
  Pose X_PJ{};               ///< joint frame in the parent link, or in the ground body
  std::uint32_t members_begin{0}, members_end{0};

  // The same, and the mass of all members, as the kernel wants it.
  kernel::Mat3<double> R_PJ{};
  kernel::Vec3<double> p_PJ{};
  double mass{0};                  ///< [kg]
  kernel::Vec3<double> moment{};   ///< mass * centre of gravity from L's origin, in L [kg m]
  kernel::Sym3<double> inertia{};  ///< about L's origin, in L [kg m^2]
  std::array<double, 3> damping{};
  std::array<double, 3> armature{};  ///< by rate, as the link has them [kg m^2 or kg]
  bool is_loaded{false};             ///< a spring, a motor or a rotor acts on a rate
  double pitch{0};                   ///< [m/rad] of a screw
  const Driver* driver{nullptr};
};

/// One side of a cut joint: the joint frame as it is fixed in a link or in a ground body.
struct ClosureEnd {
  std::int32_t link{-1};    ///< -1 = ground
  std::int32_t ground{-1};  ///< body position of the ground; -1 = the world
  kernel::Mat3<double> R_LJ{};
  kernel::Vec3<double> p_LJ{};
};

/// A link that a closure's forces pass through on their way to the ground.
struct PathLink {
  std::uint32_t link{0};
  std::int32_t up{-1};     ///< where its parent stands in the same path, counted from the path's begin
  std::uint32_t rates{0};  ///< where its rates begin among those of the path
};

/// q_b = ratio q_a + offset between numbers of two joints, given by position. A number is counted from 0 and
/// seen as B relative to A, as in JointNumbers.
struct JointCoupling {
  std::uint32_t a{0}, axis_a{0};
  std::uint32_t b{0}, axis_b{0};
  double ratio{1}, offset{0};
};

/// A number of the joint of a link, as a coupling weighs it.
struct CoupledNumber {
  std::int32_t link{-1};
  std::uint32_t axis{0};
  double factor{0};
};

/// What holds by rows instead of by the tree: a joint that is cut to make a tree of a loop, or a coupling,
/// whose one row has its ends at the links that the coupled joints tie.
struct Closure {
  std::int32_t joint{-1};  ///< position; of a coupling its b
  JointKind kind{JointKind::Fixed};
  std::uint32_t rows{0};
  ClosureEnd a{}, b{};
  double pitch{0};                   ///< [m/rad] of a screw
  std::array<double, 3> armature{};  ///< by rate of the joint
  const Driver* driver{nullptr};
  std::int32_t coupling{-1};                 ///< position; -1 = a cut joint
  std::array<CoupledNumber, 2> coupled{};    ///< of a coupling: a, b
  double offset{0};                          ///< of a coupling [rad] or [m]
  std::uint32_t path_begin{0}, path_end{0};  ///< links that it moves, children first
  std::uint32_t path_rates{0};
};

/// A range of links that move together; where loops or couplings join several trees, all of these.
struct Tree {
  std::uint32_t links_begin{0}, links_end{0};
  std::uint32_t q_begin{0}, q_end{0}, v_begin{0}, v_end{0};
  std::uint32_t closures_begin{0}, closures_end{0};
  bool follows_driver{false};  ///< an animated ground or a driven joint
  [[nodiscard]] bool has_closures() const noexcept { return closures_begin != closures_end; }
};

/// How bodies and joints are laid out for the solver.
struct TreeLayout {
  std::vector<std::uint32_t> free_bodies{};  ///< simulated, without joints: positions, ascending
  std::vector<TreeLink> links{};
  std::vector<TreeMember> members{};
  std::vector<Tree> trees{};
  std::vector<Closure> closures{};           ///< of a tree side by side
  std::vector<PathLink> paths{};             ///< of a closure side by side
  std::vector<std::int32_t> link_of_body{};  ///< by body position; -1 = in no tree
  std::vector<std::int32_t>
      link_of_joint{};  ///< by joint position: the link it ties to its parent; -1 = none
  std::vector<std::int32_t> closure_of_joint{};     ///< by joint position; -1 = it is not cut
  std::vector<std::int32_t> closure_of_coupling{};  ///< by position; -1 = a joint of it moves nothing
  std::int32_t cut_coupling{-1};  ///< the first of which a joint had to be cut; -1 = none. It is not held.
  std::uint32_t coordinates{0}, rates{0};  ///< of all trees

  [[nodiscard]] std::size_t tree_of(std::int32_t link) const;
  [[nodiscard]] std::size_t tree_of_closure(std::int32_t closure) const;
  /// Whether a tree is held by this body, which is not simulated.
  [[nodiscard]] bool stands_on(const Tree& tree, std::int32_t ground) const;
  /// Pose of a body's origin in its link.
  [[nodiscard]] const Pose& pose_in_link(std::uint32_t body) const;
};

/// Lays out all simulated bodies. `joints` by position; joints between two grounds are idle. Of closed loops
/// the joints that span_trees (spanning_tree.hpp) cuts become closures, and so do couplings.
[[nodiscard]] TreeLayout lay_out(const BodyStore& bodies, std::span<const JointDefinition* const> joints,
                                 std::span<const JointCoupling> couplings = {});

}  // namespace pantin

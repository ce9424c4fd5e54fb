#pragma once
// Articulated elimination: forward dynamics of trees of joined bodies in O(n), exact at any mass ratio. It is
// the block elimination of the constraint (KKT) system along the hierarchy in which every joint's own rows
// are eliminated analytically (Featherstone, Rigid Body Dynamics Algorithms, 2008, ch. 7), in world axes at
// the joint points.
//
//   outward   r = r0 + translation(q);  w = w_p + S_a v;  v = v_p + w_p x r + S_l v
//             al = al_p + w_p x S_a v;  a = a_p + al_p x r + w_p x (w_p x r) + 2 w_p x S_l v          (v' =
//             0) p = [A al + w x A w + h x a;  m a + al x h + w x (w x h)] - external wrench,  h = m c
//   inward    U = I^A S;  D = S^T U + armature;  u = tau - S^T p;  M = I^A - U D^-1 U^T;  pi = p + U D^-1 u,
//   shifted to the parent:
//             M' = M_ll;  B' = B + [r] M_ll;  A' = A - B [r] + [r] B'^T;  p_a += pi_a + r x pi_l;  p_l +=
//             pi_l
//   outward   da' = (dal_p, da_p + dal_p x r);  v' = D^-1 (u - U^T da');  da = da' + S v'
//
// I^A = [A B; B^T M]; subscripts a, l: angular, linear. The bias is carried in p once.
#include <array>
#include <span>
#include <vector>

#include <pantin/physics/constraints/tree.hpp>
#include <pantin/physics/integrators/integrator.hpp>

namespace pantin {

/// A link's motion and what the elimination keeps of it; world axes, at L's origin.
struct LinkWork {
  using Vec = kernel::Vec3<double>;
  kernel::Mat3<double> R{};       ///< R_WL
  Vec p{}, r{};                   ///< origin in W; from the parent's origin (or the ground's)
  Vec w{}, v{}, al{}, a{};        ///< velocity; acceleration at v' = 0
  Vec h{};                        ///< m c
  kernel::Sym3<double> A{}, M{};  ///< articulated inertia
  kernel::Mat3<double> B{};
  Vec p_a{}, p_l{};  ///< bias wrench
  Vec dal{}, da{};   ///< acceleration added by v'
};

/// Work space and verbs on ranges of links. Call place first, then load, then add_wrench for what acts, then
/// eliminate and substitute. Nothing is allocated after resize.
class Articulated {
 public:
  void resize(const TreeLayout& layout);

  /// Poses, velocities and bias accelerations of a tree's links from q and v (of all trees). `grounds` by
  /// body position: motion of the body origin of what is not simulated.
  void place(const TreeLayout& layout, const Tree& tree, std::span<const RigidMotion> grounds, Instant at,
             std::span<const double> q, std::span<const double> v);
  /// After place: velocities of links as these rates alone move them, on grounds and driven joints at rest.
  void carry(const TreeLayout& layout, const Tree& tree, std::span<const double> rates);
  /// Writes the kinematics of the tree's bodies, as placed.
  void write_members(const TreeLayout& layout, const Tree& tree, std::span<const MassProperties> mass,
                     std::span<BodyKinematics> out) const;
  /// Inertia, and the bias wrench of the motion placed.
  void load(const TreeLayout& layout, const Tree& tree);
  /// Inertia, and as bias the momentum that is missing: solves for rates instead of accelerations. Place must
  /// have been called with zero rates.
  void load_momenta(const TreeLayout& layout, const Tree& tree, std::span<const MassProperties> mass,
                    std::span<const BodyState> bodies);
  /// Inertia alone: eliminate then makes a factor with a right-hand side of zero.
  void load_inertia(const TreeLayout& layout, const Tree& tree);
  /// External wrench on a link: force, and torque about the point `p_WQ`.
  void add_wrench(std::int32_t link, const Vector3& force, const Vector3& torque, const Vector3& p_WQ);
  /// Damping torques -d v enter here, with the rates given (empty: none), and what else acts on the rates of
  /// loaded links (empty: nothing; other links' are not read).
  void eliminate(const TreeLayout& layout, const Tree& tree, std::span<const double> v,
                 std::span<const double> efforts = {});
  /// Rates that are locked, so that they and their derivatives are zero by whatever effort it takes: their
  /// columns vanish. And constant efforts by rate [N m or N], which act wherever damping does. Both of all
  /// trees; until the next call, or resize.
  void hold(std::span<const std::uint8_t> locked, std::span<const double> efforts);
  void hold_nothing() noexcept { holds_ = false; }
  [[nodiscard]] bool holds() const noexcept { return holds_; }
  [[nodiscard]] bool is_locked(std::uint32_t rate) const { return holds_ && locked_[rate] != 0; }
  [[nodiscard]] double effort(std::uint32_t rate) const { return holds_ ? efforts_[rate] : 0; }
  /// After load_inertia and eliminate: the right-hand side of a tree is zero, then that of an effort more at
  /// one rate. The next substitute says what these efforts alone accelerate.
  void clear_efforts(const Tree& tree);
  void push_effort(const TreeLayout& layout, std::uint32_t link, std::uint32_t rate, double effort);
  /// v' (or the rates, after load_momenta) of a tree, into the vector of all trees.
  void substitute(const TreeLayout& layout, const Tree& tree, std::span<double> v_dot);

  /// After place: generalised forces of wrenches on the links of a tree (force, and torque about the world's
  /// origin), by rate of all trees. The wrenches are added up towards the ground.
  void project(const TreeLayout& layout, const Tree& tree, std::span<Wrench> on_links,
               std::span<double> by_rate) const;

  // After eliminate, for rows between two links (closure.hpp), with D = L d L^T:
  struct JointEffort {  ///< generalised forces at the joint that ties a link, by rate of the link
    std::int32_t link{-1};
    std::array<double, 3> by_rate{};
  };
  struct RowWrench {
    kernel::Vec3<double> force{}, torque{}, point{};  ///< on B; the opposite on A at the same point of W
    std::array<JointEffort, 2> efforts{};             ///< of a coupling, which has no wrench
  };
  struct Passing {  ///< work space: a wrench on its way to the ground
    kernel::Vec3<double> p_a{}, p_l{};
  };
  struct Reduction {
    double squares{0};  ///< y^T d^-1 y: what the row's wrenches do to the row itself
    double bound{0};    ///< what they could, were every lever at its best
  };
  /// What the unit wrenches and efforts of a row leave at the joints of the closure's path on their way to
  /// the ground, multiplied by L^-1. `passing` has room for the path.
  Reduction reduce(const TreeLayout& layout, const Closure& closure, const RowWrench& row,
                   std::span<Passing> passing, std::span<double> y) const;
  /// y^T d^-1 z of one link.
  [[nodiscard]] double product(const TreeLayout& layout, std::uint32_t link, const double* y,
                               const double* z) const;
  /// Adds a multiple of what `reduce` left to the right-hand side: the next substitute feels it.
  void push(const TreeLayout& layout, const Closure& closure, double multiplier, std::span<const double> y);

  [[nodiscard]] const LinkWork& link(std::int32_t i) const { return work_[static_cast<std::size_t>(i)]; }
  /// After eliminate: whether a joint direction of this link meets no inertia (relative 1e-12). Links nearer
  /// to the root than a singular one have no numbers and are not called singular for it.
  [[nodiscard]] bool is_singular(const TreeLayout& layout, std::int32_t link) const;

 private:
  using Vec = kernel::Vec3<double>;
  void start_inertia(const TreeLink& link, LinkWork& work) const;
  void hold_rate(std::uint32_t rate, bool moves);
  template <int N>
  void pass_effort(const TreeLink& link, double* y, Vec& p_a, Vec& p_l);
  template <int N>
  void eliminate_link(const TreeLink& link, LinkWork& work, std::span<const double> v,
                      std::span<const double> efforts);
  template <int N>
  void reduce_link(const TreeLink& link, const LinkWork& work, const RowWrench& row, Vec& p_a, Vec& p_l,
                   const double* effort, double* y, Reduction& sum) const;
  template <int N>
  void substitute_link(const TreeLink& link, LinkWork& work, const Vec& dal, const Vec& da,
                       std::span<double> v_dot);
  void shift_to_parent(const LinkWork& work, LinkWork& parent) const;

  std::vector<LinkWork> work_{};
  // By rate: columns of S and U, right-hand side u, rows of the LDL^T factor of D.
  std::vector<Vec> S_a_{}, S_l_{}, U_a_{}, U_l_{};
  std::vector<double> u_{};
  std::vector<std::array<double, 6>> D_{};
  std::vector<double> scale_{};  ///< by rate: the inertia to which D is compared
  bool holds_{false};            ///< some rate is locked or has an effort
  std::vector<std::uint8_t> locked_{};
  std::vector<double> efforts_{};
};

}  // namespace pantin

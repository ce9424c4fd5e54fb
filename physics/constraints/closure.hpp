#pragma once
// A joint that closes a loop, as rows that hold its two frames together. With d = p_b - p_a, axes x, y, z of
// the frame Ja on A and x', y', z' of Jb on B:
//
//   ball         x.d, y.d, z.d                        cylindrical  x.d, y.d, z.x', z.y'
//   pivot        x.d, y.d, z.d, z.x', z.y'            universal    x.d, y.d, z.d, z.x'
//   slider       x.d, y.d, x.y', y.z', z.x'           planar       z.d, z.x', z.y'
//   fixed        x.d, y.d, z.d, x.y', y.z', z.x'      screw        x.d, y.d, z.x', z.y', z.d - pitch * angle
//
// A row acts by a force f at p_b and a torque c on B, the opposite on A; its gap changes at the rate
//   f.(v_b - v_a - w_a x d) + c.(w_b - w_a)
// and, as f and c move with the bodies,
//   (n.d)''  = n.(d'' - al_a x d + w_a x (w_a x d) - 2 w_a x d')                                        n on
//   A (m.t)''  = (al_a - al_b).(m x t) + (w_a - w_b).((w_a x m) x t + m x (w_b x t))             m on A, t on
//   B
//
// A coupling has one row of its own, without frames (coupling_row.hpp).
#include <array>
#include <span>

#include <pantin/physics/constraints/articulated.hpp>
#include <pantin/physics/constraints/closure_rows.hpp>
#include <pantin/physics/constraints/tree.hpp>

namespace pantin {

constexpr std::uint32_t kMostRows = 6;  ///< besides those of rotors

using FrameMotion = kernel::MovingFrame<double>;

struct ClosureRow {
  Articulated::RowWrench wrench{};  ///< for a multiplier of one, at Jb's origin
  double gap{0};                    ///< [m] or [rad]
  double rate{0};                   ///< of the gap
  double acceleration{0};           ///< of the gap
  double size{0};       ///< of the numbers whose difference the gap is: what rounding is relative to
  double rate_size{0};  ///< the same of the rate
  // Of a rotor: it acts by -armature times the acceleration of its number, so the row gives way.
  double compliance{0};  ///< 1 / armature; 0 of a row that holds
  double turning{0};     ///< rate of the number; gap and rate of the row are 0
};

/// Appends the closures of the cut joints and of the couplings to a layout whose links are complete.
void add_closures(TreeLayout& layout, const BodyStore& bodies, std::span<const JointDefinition* const> joints,
                  std::span<const JointCoupling> couplings, std::span<const std::uint8_t> is_cut);

/// A closure with its path for a joint between bodies of one tree (or the ground). Its path is appended to
/// `layout.paths`.
[[nodiscard]] Closure make_closure(TreeLayout& layout, const BodyStore& bodies, const JointDefinition& joint,
                                   std::int32_t position);

/// Appends to `layout.paths` all links from either end of a closure to the ground, children first.
void append_path(TreeLayout& layout, Closure& closure);

/// Motion of Ja and Jb of a closure, accelerations those last substituted. A driven joint's Ja is where its
/// driver wants Jb to be.
struct ClosureMotion {
  FrameMotion a{}, b{};
};
[[nodiscard]] ClosureMotion motion_of(const Closure& closure, const Articulated& kernel,
                                      std::span<const RigidMotion> grounds, Instant at);

/// The rows of a closure, those of rotors last.
void write_rows(const Closure& closure, const ClosureMotion& motion, std::span<ClosureRow> rows);

[[nodiscard]] kernel::Rotors rotors_of(const Closure& closure);

/// Jb in Ja, in axes of Ja.
struct RelativeMotion {
  kernel::Mat3<double> R{};
  kernel::Vec3<double> p{}, w{}, v{};
};
[[nodiscard]] RelativeMotion relative(const ClosureMotion& motion);
/// The numbers of a cut joint, in the turn nearest to those that `q` holds.
void measure(const Closure& closure, const RelativeMotion& motion, double* q);

/// Force at Jb's origin and torque by which a cut joint acts on B.
struct ClosureWrench {
  kernel::Vec3<double> force{}, torque{};
};

}  // namespace pantin

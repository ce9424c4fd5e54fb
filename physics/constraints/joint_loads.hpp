#pragma once
// Springs and motors on the numbers of joints, as generalised forces on the rates of links, and on cut
// joints as wrenches. Numbers are seen as B relative to A, whichever way a tree runs through the joint: with
// q_AB = f(q) of a link, its rates feel J^T effort, J = df/dq. Armature (the inertia of rotors) is a constant
// of links, which the kernel adds to their inertia along the joint; on the distances of a planar joint it
// belongs to the rates seen from the body nearer to the root of the tree.
#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include <pantin/physics/constraints/closure.hpp>
#include <pantin/physics/constraints/joint.hpp>
#include <pantin/physics/constraints/joint_models.hpp>
#include <pantin/physics/constraints/motor.hpp>
#include <pantin/physics/constraints/tree.hpp>
#include <pantin/physics/integrators/integrator.hpp>

namespace pantin {

/// By rate of a joint.
using JointMotors = std::array<std::optional<MotorSettings>, 3>;

/// Efforts by which spring, motors and, where `damped`, damping act along the numbers of a joint, on B
/// [N m or N]; by rate. `motors` may be null.
[[nodiscard]] std::array<double, 3> joint_efforts(const JointDefinition& joint, const JointMotors* motors,
                                                  Instant at, const double* q, const double* v, bool damped);

class JointLoads {
 public:
  /// Lists the loaded links and closures of a layout and marks the links. `motors` by joint position, null
  /// where there is none; definitions and motors are asked whenever efforts are.
  void list(TreeLayout& layout, std::span<const std::unique_ptr<JointDefinition>> joints,
            std::span<const std::unique_ptr<JointMotors>> motors);

  [[nodiscard]] bool on_links() const noexcept { return !links_.empty(); }
  [[nodiscard]] bool on_closures() const noexcept { return !closures_.empty(); }

  /// Efforts on the rates of loaded links of all trees at several instants: number i of stage s of `q`, `v`
  /// and `efforts` stands at [i * at.size() + s]. What belongs to other links is not touched.
  void write_efforts(const TreeLayout& layout, std::span<const Instant> at, const double* q, const double* v,
                     double* efforts) const;
  /// armature times rate of loaded links: what rotors bring along into an impulse.
  void write_rotor_momenta(const TreeLayout& layout, std::span<const double> v,
                           std::span<double> efforts) const;
  /// By what spring, motors and damping act on the B of a cut joint, at the motion that the kernel holds.
  /// `near`: the numbers of the joint not long ago, which tell its turns. Nothing where it bears no load.
  [[nodiscard]] ClosureWrench on_closure(const TreeLayout& layout, std::uint32_t closure,
                                         const ClosureMotion& motion, Instant at, const double* near) const;
  /// Calls act(link, force, torque, p_WQ) for what the same of all cut joints of a tree does to its links.
  /// `near` of all closures, kMostCoordinates for each.
  template <class Act>
  void on_cut_joints(const TreeLayout& layout, const Tree& tree, const Articulated& kernel,
                     std::span<const RigidMotion> grounds, Instant at, std::span<const double> near,
                     Act&& act) const {
    const auto eigen = [](const kernel::Vec3<double>& x) { return Vector3{x.x, x.y, x.z}; };
    for (const Load& load : closures_) {
      if (load.place < tree.closures_begin || load.place >= tree.closures_end) continue;
      const Closure& closure = layout.closures[load.place];
      const ClosureMotion motion = motion_of(closure, kernel, grounds, at);
      const ClosureWrench on_b = on_closure(layout, load.place, motion, at,
                                            near.data() + std::size_t{kMostCoordinates} * load.place);
      const Vector3 force = eigen(on_b.force), torque = eigen(on_b.torque), p_WJ = eigen(motion.b.p);
      if (closure.b.link >= 0) act(closure.b.link, force, torque, p_WJ);
      if (closure.a.link >= 0) act(closure.a.link, Vector3{-force}, Vector3{-torque}, p_WJ);
    }
  }
  /// The first time > `t` at which a motor's target breaks.
  [[nodiscard]] double next_break(double t) const;

 private:
  struct Load {
    std::uint32_t place{0};  ///< of its link or closure
    const JointDefinition* joint{nullptr};
    const JointMotors* motors{nullptr};
  };
  std::vector<Load> links_{}, closures_{};
};

}  // namespace pantin

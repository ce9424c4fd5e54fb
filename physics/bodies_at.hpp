#pragma once
// All bodies at one instant, as force laws see them: during a step at a stage of the integrator, afterwards
// at the state reached. Arrays over all bodies; a BodyId is turned into a position by `index`.
#include <cstdint>
#include <span>

#include <pantin/physics/driver.hpp>
#include <pantin/physics/ids.hpp>
#include <pantin/physics/mass_properties.hpp>
#include <pantin/physics/pose.hpp>

namespace pantin {

/// Who decides on a body's motion.
enum class BodyKind : std::uint8_t {
  Static,     ///< nobody: it stands until it is moved by hand
  Animated,   ///< a Driver: a given function of time
  Simulated,  ///< forces, joints, impulses
};

/// Where a body is and how it moves.
struct BodyKinematics {
  Vector3 p_WBcm{Vector3::Zero()};  ///< centre of gravity [m]
  Matrix3 R_WB{Matrix3::Identity()};
  Vector3 v_WBcm{Vector3::Zero()};  ///< velocity of the centre of gravity [m/s]
  Vector3 w_WB{Vector3::Zero()};    ///< [rad/s]
};

struct BodiesAt {
  double t{0};  ///< [s]
  Side side{Side::After};
  std::span<const BodyKinematics> kinematics{};
  std::span<const MassProperties> mass{};
  std::span<const BodyKind> kind{};
  std::span<const std::uint32_t> position_of{};  ///< BodyId::index -> position in the arrays above

  [[nodiscard]] std::size_t size() const { return kinematics.size(); }
  /// Position of a living body in the arrays.
  [[nodiscard]] std::size_t index(BodyId id) const { return position_of[id.index]; }
};

/// A point fixed in a body, or in the world.
struct Attachment {
  BodyId body{};                  ///< null = the world
  Vector3 p_BQ{Vector3::Zero()};  ///< from the body origin, in B [m]; in W for the world
};

/// World position and velocity of an attachment point.
struct PointKinematics {
  Vector3 p_WQ{Vector3::Zero()};
  Vector3 v_WQ{Vector3::Zero()};
};

[[nodiscard]] inline PointKinematics point_at(const BodiesAt& at, const Attachment& point) {
  if (!point.body) return {point.p_BQ, Vector3::Zero()};
  const std::size_t i = at.index(point.body);
  const BodyKinematics& k = at.kinematics[i];
  const Vector3 p_BcmQ_W = k.R_WB * (point.p_BQ - at.mass[i].p_BBcm);
  return {k.p_WBcm + p_BcmQ_W, k.v_WBcm + k.w_WB.cross(p_BcmQ_W)};
}

/// Adds force `f_W` acting at world point `p_WQ` to the wrench of body `i` about its centre of gravity.
inline void add_force_at(const BodiesAt& at, std::size_t i, const Vector3& p_WQ, const Vector3& f_W,
                         std::span<Wrench> wrenches) {
  wrenches[i].force += f_W;
  wrenches[i].torque += (p_WQ - at.kinematics[i].p_WBcm).cross(f_W);
}

}  // namespace pantin

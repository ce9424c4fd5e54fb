#pragma once
// A rigid body: its settings, its state, and a view for reading it. The body itself lives in arrays that
// PhysicsManager owns; what changes a body is a verb of PhysicsManager.
//
// | the usual name        | here                                                              |
// |-----------------------|-------------------------------------------------------------------|
// | Pos, Rot              | p_WBcm, q_WB                                              (state) |
// | P, L                  | linear_momentum, angular_momentum about Bcm, in W         (state) |
// | Mass, IBody, gravity centre | mass, I_BBcm_B, p_BBcm                             (constants) |
// | IWorld, Speed, Omega  | I_BBcm_W = R I R^T, v_WBcm = P/m, w_WB = I_W^-1 L       (derived) |
// | RotMatrix, PosOld     | R_WB, p_WBcm_previous                                   (derived) |
// | AbsoluteMatrix        | X_WB: rotation R_WB, translation p_WBcm - R_WB * p_BBcm           |
#include <optional>
#include <string>

#include <pantin/physics/bodies_at.hpp>
#include <pantin/physics/driver.hpp>
#include <pantin/physics/ids.hpp>
#include <pantin/physics/mass_properties.hpp>
#include <pantin/physics/pose.hpp>
#include <pantin/physics/problem.hpp>

namespace pantin {

/// What a body is made from.
struct RigidBodySettings {
  std::string name{};                  ///< for messages; need not be unique
  BodyKind kind{BodyKind::Simulated};  ///< Animated needs a driver
  Pose X_WB{};                         ///< of the body origin; an animated body's comes from its driver
  Vector3 v_WBcm{Vector3::Zero()};     ///< velocity of the centre of gravity [m/s]; simulated bodies only
  Vector3 w_WB{Vector3::Zero()};       ///< angular velocity in W [rad/s]; simulated bodies only
  MassProperties mass{};               ///< massless only for a body that joints will tie to others
  InertiaCheck inertia_check{InertiaCheck::Physical};  ///< how strictly `mass` is judged
  std::unique_ptr<Driver> driver{};                    ///< the world trajectory of an animated body
};

[[nodiscard]] std::optional<SettingsProblem> problem_with(const RigidBodySettings& settings);

/// Everything integrated of one body.
struct BodyState {
  Vector3 p_WBcm{Vector3::Zero()};            ///< [m]
  Quaternion q_WB{Quaternion::Identity()};    ///< unit
  Vector3 linear_momentum{Vector3::Zero()};   ///< P, in W [kg m/s]
  Vector3 angular_momentum{Vector3::Zero()};  ///< L about the centre of gravity, in W [kg m^2/s]
};

class BodyStore;

/// A view of one living body; valid until bodies are added or removed. All in SI units and world axes unless
/// the name says B.
class RigidBody {
 public:
  [[nodiscard]] BodyId id() const;
  [[nodiscard]] const std::string& name() const;
  [[nodiscard]] BodyKind kind() const;

  [[nodiscard]] const BodyState& state() const;
  [[nodiscard]] const Vector3& p_WBcm() const;
  [[nodiscard]] const Quaternion& q_WB() const;
  [[nodiscard]] const Vector3& linear_momentum() const;
  [[nodiscard]] const Vector3& angular_momentum() const;

  [[nodiscard]] double mass() const;
  [[nodiscard]] const MassProperties& mass_properties() const;
  [[nodiscard]] const Matrix3& I_BBcm_B() const;
  [[nodiscard]] Matrix3 I_BBcm_B_inverse() const;  ///< zero for a massless body
  [[nodiscard]] const Vector3& p_BBcm() const;

  [[nodiscard]] Matrix3 I_BBcm_W() const;
  [[nodiscard]] Matrix3 I_BBcm_W_inverse() const;  ///< zero for a massless body
  [[nodiscard]] const Vector3& v_WBcm() const;
  [[nodiscard]] const Vector3& w_WB() const;
  [[nodiscard]] const Matrix3& R_WB() const;
  [[nodiscard]] const Vector3& p_WBcm_previous() const;  ///< before the last step, or the last teleport
  [[nodiscard]] const Quaternion& q_WB_previous() const;

  /// The absolute matrix: pose of the body origin.
  [[nodiscard]] Pose X_WB() const;
  [[nodiscard]] Vector3 v_WB() const;  ///< velocity of the body origin [m/s]

  [[nodiscard]] const Vector3& force() const;           ///< accumulated by apply_force [N]
  [[nodiscard]] const Vector3& torque() const;          ///< about the centre of gravity [N m]
  [[nodiscard]] const Vector3& force_impulse() const;   ///< [N s]
  [[nodiscard]] const Vector3& torque_impulse() const;  ///< about the centre of gravity [N m s]

  [[nodiscard]] double kinetic_energy() const;  ///< [J]

 private:
  friend class PhysicsManager;
  RigidBody(const BodyStore& store, std::size_t position) : store_{&store}, position_{position} {}
  const BodyStore* store_;
  std::size_t position_;
};

}  // namespace pantin

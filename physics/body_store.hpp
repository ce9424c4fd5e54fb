#pragma once
// The arrays in which bodies live: constants by position, state in State. Private to physics; the public
// verbs are PhysicsManager's, the public view is RigidBody.
#include <memory>
#include <span>
#include <string>
#include <vector>

#include <pantin/physics/rigid_body.hpp>
#include <pantin/physics/state.hpp>

namespace pantin {

class BodyStore {
 public:
  BodyId add(RigidBodySettings settings, double time);
  void remove(BodyId id);  ///< the last body takes its position
  [[nodiscard]] bool contains(BodyId id) const noexcept;
  [[nodiscard]] std::size_t size() const noexcept { return ids.size(); }
  /// Position of a living body.
  [[nodiscard]] std::size_t at(BodyId id) const;

  void set_mass(std::size_t i, const MassProperties& mass);
  /// Sets pose of the origin and velocity of the centre of gravity, with all that follows from them.
  void place(std::size_t i, const Pose& X_WB, const Vector3& v_WBcm, const Vector3& w_WB);
  /// The same from the motion of the body origin.
  void place(std::size_t i, const RigidMotion& motion);
  /// Recomputes what is derived from poses and momenta of a body that is no tree's.
  void refresh(std::size_t i);
  [[nodiscard]] Pose X_WB(std::size_t i) const;
  /// All bodies as force laws see them, at the state reached.
  [[nodiscard]] BodiesAt now() const;

  // By position.
  std::vector<BodyId> ids{};
  std::vector<std::string> names{};
  std::vector<BodyKind> kinds{};
  std::vector<MassProperties> mass{};
  std::vector<Matrix3> inverse_inertia{};          ///< I_BBcm_B^-1, zero where singular
  std::vector<std::unique_ptr<Driver>> drivers{};  ///< of animated bodies
  State state{};

  std::vector<std::uint32_t> position_of{};  ///< BodyId::index -> position

 private:
  std::vector<std::uint32_t> generation_{};  ///< BodyId::index -> generation alive, or the last one
  std::vector<std::uint32_t> free_{};
};

/// R, v and w of a body from its state: w = R I^-1 R^T L.
inline void derive(const BodyState& s, double mass, const Matrix3& inverse_inertia, BodyKinematics& k) {
  k.p_WBcm = s.p_WBcm;
  k.R_WB = s.q_WB.toRotationMatrix();
  k.v_WBcm = s.linear_momentum / mass;
  const Vector3 L_B = k.R_WB.transpose() * s.angular_momentum;
  const Vector3 w_B = inverse_inertia * L_B;
  k.w_WB = k.R_WB * w_B;
}

}  // namespace pantin

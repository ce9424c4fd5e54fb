#include <pantin/physics/rigid_body.hpp>

#include <cmath>

#include <pantin/physics/body_store.hpp>

namespace pantin {

std::optional<SettingsProblem> problem_with(const RigidBodySettings& settings) {
  const std::string subject = "body '" + settings.name + "': ";
  if (std::optional<SettingsProblem> problem = problem_with(settings.mass, settings.inertia_check)) {
    problem->text = subject + problem->text;
    return problem;
  }
  const Pose& X = settings.X_WB;
  if (!X.p.allFinite() || !X.q.coeffs().allFinite() || !settings.v_WBcm.allFinite() ||
      !settings.w_WB.allFinite()) {
    return SettingsProblem{ProblemCode::NotFinite, subject + "pose or velocity is not finite",
                           "give finite numbers"};
  }
  if (std::abs(X.q.squaredNorm() - 1) > 1e-9) {
    return SettingsProblem{ProblemCode::NotUnit,
                           subject + "the quaternion has length " + std::to_string(X.q.norm()),
                           "normalise it"};
  }
  if ((settings.kind == BodyKind::Animated) != (settings.driver != nullptr)) {
    return SettingsProblem{ProblemCode::OutOfRange, subject + "an animated body, and no other, has a driver",
                           "give the driver of its trajectory, or another kind"};
  }
  return std::nullopt;
}

BodyId RigidBody::id() const { return store_->ids[position_]; }
const std::string& RigidBody::name() const { return store_->names[position_]; }
BodyKind RigidBody::kind() const { return store_->kinds[position_]; }

const BodyState& RigidBody::state() const { return store_->state.bodies[position_]; }
const Vector3& RigidBody::p_WBcm() const { return state().p_WBcm; }
const Quaternion& RigidBody::q_WB() const { return state().q_WB; }
const Vector3& RigidBody::linear_momentum() const { return state().linear_momentum; }
const Vector3& RigidBody::angular_momentum() const { return state().angular_momentum; }

double RigidBody::mass() const { return store_->mass[position_].mass; }
const MassProperties& RigidBody::mass_properties() const { return store_->mass[position_]; }
const Matrix3& RigidBody::I_BBcm_B() const { return store_->mass[position_].I_BBcm_B; }
Matrix3 RigidBody::I_BBcm_B_inverse() const { return store_->inverse_inertia[position_]; }
const Vector3& RigidBody::p_BBcm() const { return store_->mass[position_].p_BBcm; }

Matrix3 RigidBody::I_BBcm_W() const { return R_WB() * I_BBcm_B() * R_WB().transpose(); }
Matrix3 RigidBody::I_BBcm_W_inverse() const {
  return R_WB() * store_->inverse_inertia[position_] * R_WB().transpose();
}
const Vector3& RigidBody::v_WBcm() const { return store_->state.kinematics[position_].v_WBcm; }
const Vector3& RigidBody::w_WB() const { return store_->state.kinematics[position_].w_WB; }
const Matrix3& RigidBody::R_WB() const { return store_->state.kinematics[position_].R_WB; }
const Vector3& RigidBody::p_WBcm_previous() const { return store_->state.previous[position_].p_WBcm; }
const Quaternion& RigidBody::q_WB_previous() const { return store_->state.previous[position_].q_WB; }

Pose RigidBody::X_WB() const { return store_->X_WB(position_); }
Vector3 RigidBody::v_WB() const { return v_WBcm() - w_WB().cross(R_WB() * p_BBcm()); }

const Vector3& RigidBody::force() const { return store_->state.accumulators[position_].force; }
const Vector3& RigidBody::torque() const { return store_->state.accumulators[position_].torque; }
const Vector3& RigidBody::force_impulse() const {
  return store_->state.accumulators[position_].force_impulse;
}
const Vector3& RigidBody::torque_impulse() const {
  return store_->state.accumulators[position_].torque_impulse;
}

double RigidBody::kinetic_energy() const {
  return 0.5 * (linear_momentum().dot(v_WBcm()) + angular_momentum().dot(w_WB()));
}

}  // namespace pantin

#include <pantin/physics/physics_manager.hpp>

#include <cmath>

#include <pantin/physics/expects.hpp>
#include <pantin/physics/world.hpp>

namespace pantin {

namespace {

void check(const std::optional<SettingsProblem>& problem) {
  PANTIN_EXPECTS(!problem, problem->text + "; " + problem->remedy);
}

void check_finite(const Vector3& v, const char* what) {
  PANTIN_EXPECTS(v.allFinite(), std::string{what} + " is not finite");
}

}  // namespace

PhysicsManager::PhysicsManager() : impl_{std::make_unique<Impl>()} {}
PhysicsManager::~PhysicsManager() = default;
PhysicsManager::PhysicsManager(PhysicsManager&&) noexcept = default;
PhysicsManager& PhysicsManager::operator=(PhysicsManager&&) noexcept = default;

// Bodies

BodyId PhysicsManager::add(RigidBodySettings settings) {
  check(problem_with(settings));
  impl_->constraints.stale(impl_->bodies);
  return impl_->bodies.add(std::move(settings), time());
}

void PhysicsManager::remove(BodyId id) {
  static_cast<void>(impl_->bodies.at(id));
  for (const JointId joint : impl_->constraints.joints_of(id)) remove(joint);
  impl_->forces.remove_laws_of(id);
  impl_->deflectors.remove_deflectors_of(id);
  impl_->particles.remove_all_of(id);
  impl_->forget_integrator_of(id);
  impl_->constraints.stale(impl_->bodies);
  impl_->bodies.remove(id);
}

bool PhysicsManager::contains(BodyId id) const noexcept { return impl_->bodies.contains(id); }
RigidBody PhysicsManager::body(BodyId id) const { return {impl_->bodies, impl_->bodies.at(id)}; }
std::span<const BodyId> PhysicsManager::bodies() const noexcept { return impl_->bodies.ids; }

void PhysicsManager::make_simulated(BodyId id) {
  BodyStore& bodies = impl_->bodies;
  const std::size_t i = bodies.at(id);
  if (bodies.kinds[i] == BodyKind::Simulated) return;
  impl_->constraints.stale(bodies);
  bodies.kinds[i] = BodyKind::Simulated;
  bodies.drivers[i].reset();
}

void PhysicsManager::make_animated(BodyId id, std::unique_ptr<Driver> driver) {
  BodyStore& bodies = impl_->bodies;
  const std::size_t i = bodies.at(id);
  PANTIN_EXPECTS(driver != nullptr, "body '" + bodies.names[i] + "' is to be animated without a driver");
  impl_->constraints.stale(bodies);
  bodies.kinds[i] = BodyKind::Animated;
  bodies.drivers[i] = std::move(driver);
  bodies.place(i, bodies.drivers[i]->motion(time(), Side::After));
}

void PhysicsManager::make_static(BodyId id) {
  BodyStore& bodies = impl_->bodies;
  const std::size_t i = bodies.at(id);
  impl_->constraints.stale(bodies);
  bodies.kinds[i] = BodyKind::Static;
  bodies.drivers[i].reset();
  bodies.place(i, bodies.X_WB(i), Vector3::Zero(), Vector3::Zero());
}

void PhysicsManager::set_mass_properties(BodyId id, const MassProperties& mass, InertiaCheck strictness) {
  check(problem_with(mass, strictness));
  BodyStore& bodies = impl_->bodies;
  const std::size_t i = bodies.at(id);
  impl_->constraints.stale(bodies);
  const Pose X_WB = bodies.X_WB(i);
  const BodyKinematics k = bodies.state.kinematics[i];
  bodies.set_mass(i, mass);
  const Vector3 shift = k.R_WB * mass.p_BBcm - (k.p_WBcm - X_WB.p);
  bodies.place(i, X_WB, k.v_WBcm + k.w_WB.cross(shift), k.w_WB);
  bodies.state.previous[i] = bodies.state.bodies[i];
}

void PhysicsManager::set_pose(BodyId id, const Pose& X_WB) {
  BodyStore& bodies = impl_->bodies;
  const std::size_t i = bodies.at(id);
  PANTIN_EXPECTS(X_WB.p.allFinite() && std::abs(X_WB.q.squaredNorm() - 1) < 1e-9,
                 "pose of body '" + bodies.names[i] + "' is not finite or its quaternion not unit");
  PANTIN_EXPECTS(bodies.kinds[i] != BodyKind::Animated,
                 "body '" + bodies.names[i] + "' is animated: its driver decides on its pose");
  impl_->constraints.prepare(bodies);
  if (impl_->constraints.layout().link_of_body[i] >= 0) {
    impl_->constraints.teleport(bodies, i, X_WB);
    return;
  }
  const BodyKinematics k = bodies.state.kinematics[i];
  bodies.place(i, X_WB, k.v_WBcm, k.w_WB);
  bodies.state.previous[i] = bodies.state.bodies[i];
  if (bodies.kinds[i] != BodyKind::Static) return;
  // What hangs on a static body moves along.
  impl_->constraints.ground_has_moved(bodies, static_cast<std::int32_t>(i), {time(), Side::After});
}

void PhysicsManager::set_velocity(BodyId id, const Vector3& v_WBcm, const Vector3& w_WB) {
  BodyStore& bodies = impl_->bodies;
  const std::size_t i = bodies.at(id);
  PANTIN_EXPECTS(v_WBcm.allFinite() && w_WB.allFinite(),
                 "velocity of body '" + bodies.names[i] + "' is not finite");
  PANTIN_EXPECTS(bodies.kinds[i] == BodyKind::Simulated,
                 "body '" + bodies.names[i] + "' is not simulated: its velocity is not free to be set");
  impl_->constraints.prepare(bodies);
  bodies.place(i, bodies.X_WB(i), v_WBcm, w_WB);
  const std::int32_t link = impl_->constraints.layout().link_of_body[i];
  if (link < 0) return;
  const std::size_t tree = impl_->constraints.layout().tree_of(link);
  impl_->constraints.measure_rotors(bodies, impl_->constraints.layout().trees[tree]);
  bodies.state.edited[tree] = 1;
}

void PhysicsManager::apply_force(BodyId id, const Vector3& f_W, const Vector3& p_WQ) {
  const std::size_t i = impl_->bodies.at(id);
  check_finite(f_W, "a force");
  check_finite(p_WQ, "the point of a force");
  BodyAccumulators& sum = impl_->bodies.state.accumulators[i];
  sum.force += f_W;
  sum.torque += (p_WQ - impl_->bodies.state.bodies[i].p_WBcm).cross(f_W);
  impl_->bodies.state.loaded = true;
}

void PhysicsManager::apply_force(BodyId id, const Vector3& f_W) { apply_force(id, f_W, body(id).p_WBcm()); }

void PhysicsManager::apply_torque(BodyId id, const Vector3& t_W) {
  const std::size_t i = impl_->bodies.at(id);
  check_finite(t_W, "a torque");
  impl_->bodies.state.accumulators[i].torque += t_W;
  impl_->bodies.state.loaded = true;
}

void PhysicsManager::apply_impulse(BodyId id, const Vector3& j_W, const Vector3& p_WQ) {
  const std::size_t i = impl_->bodies.at(id);
  check_finite(j_W, "an impulse");
  check_finite(p_WQ, "the point of an impulse");
  BodyAccumulators& sum = impl_->bodies.state.accumulators[i];
  sum.force_impulse += j_W;
  sum.torque_impulse += (p_WQ - impl_->bodies.state.bodies[i].p_WBcm).cross(j_W);
  impl_->bodies.state.struck = true;
}

void PhysicsManager::apply_impulse(BodyId id, const Vector3& j_W) {
  apply_impulse(id, j_W, body(id).p_WBcm());
}

void PhysicsManager::apply_angular_impulse(BodyId id, const Vector3& j_W) {
  const std::size_t i = impl_->bodies.at(id);
  check_finite(j_W, "an angular impulse");
  impl_->bodies.state.accumulators[i].torque_impulse += j_W;
  impl_->bodies.state.struck = true;
}

void PhysicsManager::clear_accumulators() {
  State& state = impl_->bodies.state;
  if (!state.loaded) return;
  for (BodyAccumulators& sum : state.accumulators) {
    sum.force.setZero();
    sum.torque.setZero();
  }
  state.loaded = false;
}

// Joints

JointId PhysicsManager::add_joint(JointDefinition joint) {
  check(problem_with(joint));
  BodyStore& bodies = impl_->bodies;
  static_cast<void>(bodies.at(joint.b));
  if (joint.a) static_cast<void>(bodies.at(joint.a));
  impl_->constraints.stale(bodies);
  return impl_->constraints.add(std::move(joint));
}

void PhysicsManager::remove(JointId id) {
  impl_->constraints.stale(impl_->bodies);
  impl_->constraints.remove(id);
}

bool PhysicsManager::contains(JointId id) const noexcept { return impl_->constraints.contains(id); }

std::vector<JointId> PhysicsManager::joints() const {
  std::vector<JointId> out;
  for (std::size_t j = 0; j < impl_->constraints.size(); ++j) out.push_back(impl_->constraints.id(j));
  return out;
}

const JointDefinition& PhysicsManager::joint(JointId id) const {
  return impl_->constraints.joint(impl_->constraints.at(id));
}

std::vector<JointId> PhysicsManager::joints_of(BodyId id) const {
  static_cast<void>(impl_->bodies.at(id));
  return impl_->constraints.joints_of(id);
}

bool PhysicsManager::closes_loop(BodyId a, BodyId b) const {
  return impl_->constraints.closes_loop(impl_->bodies, a, b);
}

std::vector<std::pair<JointId, SettingsProblem>> PhysicsManager::singular_joints() const {
  return impl_->constraints.singular_joints(impl_->bodies);
}

JointNumbers PhysicsManager::joint_value(JointId id) const {
  return impl_->constraints.value(impl_->bodies, impl_->constraints.at(id));
}

JointNumbers PhysicsManager::joint_rate(JointId id) const {
  return impl_->constraints.rate(impl_->bodies, impl_->constraints.at(id));
}

void PhysicsManager::set_joint_value(JointId id, const JointNumbers& value) {
  PANTIN_EXPECTS(try_joint_value(id, value),
                 "joint '" + joint(id).name +
                     "' cannot take this value with its loop closed and its couplings held; choose one "
                     "within its reach");
}

bool PhysicsManager::try_joint_value(JointId id, const JointNumbers& value) {
  return impl_->constraints.set_value(impl_->bodies, impl_->constraints.at(id), value);
}

void PhysicsManager::set_joint_rate(JointId id, const JointNumbers& rate) {
  impl_->constraints.set_rate(impl_->bodies, impl_->constraints.at(id), rate);
}

JointDrift PhysicsManager::joint_drift() const { return impl_->constraints.drift(impl_->bodies); }

// Laws, integrator, time

ForceManager& PhysicsManager::forces() noexcept { return impl_->forces; }
const ForceManager& PhysicsManager::forces() const noexcept { return impl_->forces; }
ParticleManager& PhysicsManager::particles() noexcept { return impl_->particles; }
const ParticleManager& PhysicsManager::particles() const noexcept { return impl_->particles; }
DeflectorManager& PhysicsManager::deflectors() noexcept { return impl_->deflectors; }
const DeflectorManager& PhysicsManager::deflectors() const noexcept { return impl_->deflectors; }

const Integrator& PhysicsManager::integrator() const noexcept { return *impl_->integrator; }

void PhysicsManager::watch_stability(bool watch) {
  impl_->watches_stability = watch;
  if (watch) return;
  for (StabilityMemory& memory : impl_->bodies.state.stabilities) memory = {};
}

double PhysicsManager::time() const noexcept { return impl_->bodies.state.time; }

void PhysicsManager::set_time(double time) {
  PANTIN_EXPECTS(std::isfinite(time), "time is not finite");
  impl_->constraints.prepare(impl_->bodies);
  impl_->bodies.state.time = time;
  impl_->bodies.state.time_compensation = 0;
  impl_->pass_break();  // what is driven stands where it is at that time, with all that hangs on it
}

std::span<const BodyId> PhysicsManager::moved() const noexcept { return impl_->moved; }
Energy PhysicsManager::energy() const { return impl_->energy(); }

State PhysicsManager::snapshot() {
  impl_->constraints.prepare(impl_->bodies);
  return impl_->bodies.state;
}

void PhysicsManager::restore(const State& state) {
  impl_->constraints.prepare(impl_->bodies);
  PANTIN_EXPECTS(
      state.topology == impl_->bodies.state.topology && state.bodies.size() == impl_->bodies.size(),
      "the state was taken with other bodies, joints or kinds; restore those first");
  PANTIN_EXPECTS(impl_->particles.fits(state.particles),
                 "the state was taken with other particle systems or emitters; restore those first");
  impl_->bodies.state = state;
  impl_->particles.reserve_again();
}

}  // namespace pantin

#include <pantin/physics/body_store.hpp>

#include <utility>

#include <pantin/physics/expects.hpp>

namespace pantin {

namespace {

constexpr std::uint32_t kNowhere = 0xffffffffu;

template <class T>
void move_last_to(std::vector<T>& v, std::size_t i) {
  if (i + 1 != v.size()) v[i] = std::move(v.back());
  v.pop_back();
}

}  // namespace

bool BodyStore::contains(BodyId id) const noexcept {
  return id && id.index < generation_.size() && generation_[id.index] == id.generation &&
         position_of[id.index] != kNowhere;
}

std::size_t BodyStore::at(BodyId id) const {
  PANTIN_EXPECTS(contains(id), "body " + std::to_string(id.index) + "." + std::to_string(id.generation) +
                                   " does not exist (any more): it is null, or was removed");
  return position_of[id.index];
}

BodyId BodyStore::add(RigidBodySettings settings, double time) {
  std::uint32_t slot = 0;
  if (free_.empty()) {
    slot = static_cast<std::uint32_t>(generation_.size());
    generation_.push_back(0);
    position_of.push_back(kNowhere);
  } else {
    slot = free_.back();
    free_.pop_back();
  }
  const BodyId id{slot, ++generation_[slot]};
  position_of[slot] = static_cast<std::uint32_t>(ids.size());
  ids.push_back(id);
  names.push_back(std::move(settings.name));
  kinds.push_back(settings.kind);
  mass.emplace_back();
  inverse_inertia.emplace_back();
  drivers.push_back(std::move(settings.driver));
  state.bodies.emplace_back();
  state.kinematics.emplace_back();
  state.previous.emplace_back();
  state.accumulators.emplace_back();

  const std::size_t i = ids.size() - 1;
  set_mass(i, settings.mass);
  if (settings.kind == BodyKind::Animated) {
    place(i, drivers[i]->motion(time, Side::After));
  } else {
    place(i, settings.X_WB, settings.v_WBcm, settings.w_WB);
  }
  state.previous[i] = state.bodies[i];
  return id;
}

void BodyStore::remove(BodyId id) {
  const std::size_t i = at(id);
  const BodyId last = ids.back();
  move_last_to(ids, i);
  move_last_to(names, i);
  move_last_to(kinds, i);
  move_last_to(mass, i);
  move_last_to(inverse_inertia, i);
  move_last_to(drivers, i);
  move_last_to(state.bodies, i);
  move_last_to(state.kinematics, i);
  move_last_to(state.previous, i);
  move_last_to(state.accumulators, i);
  position_of[last.index] = static_cast<std::uint32_t>(i);
  position_of[id.index] = kNowhere;
  free_.push_back(id.index);
}

void BodyStore::set_mass(std::size_t i, const MassProperties& properties) {
  mass[i] = properties;
  const double det = properties.I_BBcm_B.determinant();
  const double size = properties.I_BBcm_B.trace();
  if (std::abs(det) > 1e-30 * size * size * size) {
    inverse_inertia[i] = properties.I_BBcm_B.inverse();
  } else {
    inverse_inertia[i].setZero();
  }
}

Pose BodyStore::X_WB(std::size_t i) const {
  const BodyState& s = state.bodies[i];
  const Vector3 offset = state.kinematics[i].R_WB * mass[i].p_BBcm;
  return {s.p_WBcm - offset, s.q_WB};
}

void BodyStore::place(std::size_t i, const Pose& X_WB, const Vector3& v_WBcm, const Vector3& w_WB) {
  BodyState& s = state.bodies[i];
  BodyKinematics& k = state.kinematics[i];
  s.q_WB = X_WB.q;
  k.R_WB = X_WB.q.toRotationMatrix();
  s.p_WBcm = X_WB.p + k.R_WB * mass[i].p_BBcm;
  k.p_WBcm = s.p_WBcm;
  k.v_WBcm = v_WBcm;
  k.w_WB = w_WB;
  const Vector3 w_B = k.R_WB.transpose() * w_WB;
  const Vector3 L_B = mass[i].I_BBcm_B * w_B;
  s.linear_momentum = mass[i].mass * v_WBcm;
  s.angular_momentum = k.R_WB * L_B;
}

void BodyStore::place(std::size_t i, const RigidMotion& motion) {
  const Vector3 p_BoBcm_W = motion.X_AB.q * mass[i].p_BBcm;
  place(i, motion.X_AB, motion.v_AB + motion.w_AB.cross(p_BoBcm_W), motion.w_AB);
}

void BodyStore::refresh(std::size_t i) {
  derive(state.bodies[i], mass[i].mass, inverse_inertia[i], state.kinematics[i]);
}

BodiesAt BodyStore::now() const {
  return {.t = state.time,
          .side = Side::After,
          .kinematics = state.kinematics,
          .mass = mass,
          .kind = kinds,
          .position_of = position_of};
}

}  // namespace pantin

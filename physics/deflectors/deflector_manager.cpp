#include <pantin/physics/deflectors/deflector_manager.hpp>

#include <algorithm>
#include <string>

#include <pantin/physics/expects.hpp>

namespace pantin {

void DeflectorManager::check(const std::optional<SettingsProblem>& problem) {
  PANTIN_EXPECTS(!problem, problem->text + "; " + problem->remedy);
}

DeflectorId DeflectorManager::add(const DeflectorMount& on, const SurfaceSettings& surface,
                                  std::unique_ptr<DeflectorShape> shape) {
  PANTIN_EXPECTS(shape != nullptr, "the shape of a deflector is null; give an object");
  if (on.body) static_cast<void>(bodies_.at(on.body));
  const DeflectorId id{.index = next_++, .generation = 1};
  deflectors_.push_back({.id = id, .on = on, .surface = surface, .shape = std::move(shape)});
  return id;
}

std::size_t DeflectorManager::position_of(DeflectorId id) const noexcept {
  const auto found = std::lower_bound(deflectors_.begin(), deflectors_.end(), id,
                                      [](const Deflector& d, DeflectorId wanted) { return d.id < wanted; });
  return found != deflectors_.end() && found->id == id ? static_cast<std::size_t>(found - deflectors_.begin())
                                                       : deflectors_.size();
}

const Deflector& DeflectorManager::at(DeflectorId id) const {
  const std::size_t i = position_of(id);
  PANTIN_EXPECTS(i < deflectors_.size(), "deflector " + std::to_string(id.index) +
                                             " is null or was removed; keep the id that add returned");
  return deflectors_[i];
}

Deflector* DeflectorManager::find(DeflectorId id) noexcept {
  const std::size_t i = position_of(id);
  return i < deflectors_.size() ? &deflectors_[i] : nullptr;
}

void DeflectorManager::remove(DeflectorId id) {
  static_cast<void>(at(id));
  deflectors_.erase(deflectors_.begin() + static_cast<std::ptrdiff_t>(position_of(id)));
}

void DeflectorManager::remove_deflectors_of(BodyId body) {
  std::erase_if(deflectors_, [body](const Deflector& d) { return d.on.body == body; });
}

std::vector<DeflectorId> DeflectorManager::ids() const {
  std::vector<DeflectorId> out;
  for (const Deflector& d : deflectors_) out.push_back(d.id);
  return out;
}

std::vector<DeflectorId> DeflectorManager::deflectors_of(BodyId body) const {
  std::vector<DeflectorId> out;
  for (const Deflector& d : deflectors_) {
    if (d.on.body == body) out.push_back(d.id);
  }
  return out;
}

void DeflectorManager::set_surface(DeflectorId id, const SurfaceSettings& surface) {
  static_cast<void>(at(id));
  check(problem_with(surface, kind(id)));
  deflectors_[position_of(id)].surface = surface;
}

void DeflectorManager::forget_hits() {
  for (Deflector& d : deflectors_) d.hits = 0;
}

void DeflectorManager::begin() {
  if (!deflectors_.empty()) before_ = bodies_.state.kinematics;
}

void DeflectorManager::end(double h) {
  struck_.clear();
  for (Deflector& d : deflectors_) {
    d.struck = -1;
    if (!d.on.body) {
      d.whole.stand(d.on.X_BD);
      d.motion = d.whole;
      continue;
    }
    const std::size_t i = bodies_.at(d.on.body);
    const Vector3 p_BcmD_B = d.on.X_BD.p - bodies_.mass[i].p_BBcm;
    d.whole.carry(before_[i], bodies_.state.kinematics[i], h, p_BcmD_B, d.on.X_BD.q);
    d.motion = d.whole;
    if (bodies_.kinds[i] != BodyKind::Simulated || !(bodies_.mass[i].mass > 0)) continue;
    const auto same =
        std::find_if(struck_.begin(), struck_.end(), [i](const StruckBody& body) { return body.body == i; });
    d.struck = static_cast<std::int32_t>(same - struck_.begin());
    if (same != struck_.end()) continue;
    const Matrix3& R = bodies_.state.kinematics[i].R_WB;
    struck_.push_back({.body = static_cast<std::uint32_t>(i),
                       .inverse_mass = 1 / bodies_.mass[i].mass,
                       .inverse_inertia_W = R * bodies_.inverse_inertia[i] * R.transpose()});
  }
}

void DeflectorManager::narrow(double s0, double s1) {
  for (Deflector& d : deflectors_) d.motion = s0 == 0 && s1 == 1 ? d.whole : d.whole.part(s0, s1);
}

StruckBody* DeflectorManager::struck(const Deflector& deflector) noexcept {
  return deflector.struck < 0 ? nullptr : &struck_[static_cast<std::size_t>(deflector.struck)];
}

void DeflectorManager::react(const Deflector& deflector, const Vector3& linear, const Vector3& angular) {
  StruckBody* body = struck(deflector);
  if (body == nullptr) return;
  // About the centre of gravity at the end, where the impulse will act: so the angular momentum of all
  // together stays.
  const Vector3 torque = bodies_.state.bodies[body->body].p_WBcm.cross(linear) - angular;
  BodyAccumulators& sum = bodies_.state.accumulators[body->body];
  sum.force_impulse -= linear;
  sum.torque_impulse += torque;
  bodies_.state.struck = true;
  body->dv -= body->inverse_mass * linear;
  body->dw += body->inverse_inertia_W * torque;
}

}  // namespace pantin

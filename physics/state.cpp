#include <pantin/physics/state.hpp>

#include <bit>

#include <pantin/physics/stamp.hpp>

namespace pantin {

namespace {

std::uint64_t mixed(std::uint64_t h, double x) {
  std::uint64_t bits = std::bit_cast<std::uint64_t>(x);
  for (int i = 0; i < 8; ++i, bits >>= 8) h = stamped(h, bits & 0xff);
  return h;
}

std::uint64_t mixed(std::uint64_t h, const Vector3& v) { return mixed(mixed(mixed(h, v.x()), v.y()), v.z()); }

}  // namespace

bool operator==(const State& a, const State& b) {
  if (a.topology != b.topology || a.time != b.time || a.bodies.size() != b.bodies.size()) return false;
  for (std::size_t i = 0; i < a.bodies.size(); ++i) {
    const BodyState &s = a.bodies[i], &t = b.bodies[i];
    if (s.p_WBcm != t.p_WBcm || s.q_WB.coeffs() != t.q_WB.coeffs() ||
        s.linear_momentum != t.linear_momentum || s.angular_momentum != t.angular_momentum) {
      return false;
    }
  }
  return a.coordinates == b.coordinates && a.rates == b.rates && a.cut_coordinates == b.cut_coordinates &&
         a.particles == b.particles && a.axis_modes == b.axis_modes;
}

std::uint64_t hash(const State& state) {
  std::uint64_t h = mixed(kStampSeed, state.time);
  for (const BodyState& s : state.bodies) {
    h = mixed(h, s.p_WBcm);
    for (int i = 0; i < 4; ++i) h = mixed(h, s.q_WB.coeffs()[i]);
    h = mixed(mixed(h, s.linear_momentum), s.angular_momentum);
  }
  for (const ParticleSystemState& system : state.particles) {
    const ParticleArrays& now = system.now;
    for (const std::vector<double>* a : {&now.x, &now.y, &now.z, &now.vx, &now.vy, &now.vz}) {
      for (const double x : *a) h = mixed(h, x);
    }
  }
  return h;
}

}  // namespace pantin

#include <pantin/physics/particles/particle_block.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace pantin {

ParticleBlock::ParticleBlock(const ForceManager& forces) : forces_{forces} {
  for (std::vector<double>* a : {&p0_, &v0_, &q_, &v_}) a->resize(3 * kMost);
  for (std::vector<double>* a : {&mass_, &inverse_mass_, &inverse_length2_, &margin_, &gap_, &scratch_})
    a->resize(kMost);
  near_.reserve(kMost);
}

void ParticleBlock::load(ParticleSystemId system, const ParticleArrays& from, std::size_t first,
                         std::size_t n, std::span<const double> masses, double mass) {
  system_ = system;
  n_ = n;
  const auto copy = [&](const std::vector<double>& source, std::vector<double>& to, std::size_t axis) {
    std::copy_n(source.data() + first, n, to.data() + axis * n);
  };
  copy(from.x, p0_, 0), copy(from.y, p0_, 1), copy(from.z, p0_, 2);
  copy(from.vx, v0_, 0), copy(from.vy, v0_, 1), copy(from.vz, v0_, 2);
  if (masses.empty()) {
    std::fill_n(mass_.begin(), n, mass);
    std::fill_n(inverse_mass_.begin(), n, 1 / mass);
  } else {
    for (std::size_t i = 0; i < n; ++i) {
      mass_[i] = masses[first + i];
      inverse_mass_[i] = 1 / mass_[i];
    }
  }
}

void ParticleBlock::integrate(Integrator& integrator, double t, double h) {
  std::copy_n(p0_.begin(), 3 * n_, q_.begin());
  std::copy_n(v0_.begin(), 3 * n_, v_.begin());
  // An integrator that chooses its steps begins afresh in every batch: what it did elsewhere is no part of
  // State.
  if (StepControl* control = integrator.control()) control->memory = {};
  integrator.step(*this, t, h, {q_.data(), 3 * n_}, {v_.data(), 3 * n_});
}

void ParticleBlock::arrive(const ParticleArrays& at, std::size_t first) {
  const auto copy = [&](const std::vector<double>& source, std::vector<double>& to, std::size_t axis) {
    std::copy_n(source.data() + first, n_, to.data() + axis * n_);
  };
  copy(at.x, q_, 0), copy(at.y, q_, 1), copy(at.z, q_, 2);
  copy(at.vx, v_, 0), copy(at.vy, v_, 1), copy(at.vz, v_, 2);
}

std::size_t ParticleBlock::first_not_finite() const {
  // A sum is finite where its terms are; where it is not, the culprit is looked for.
  double sum = 0;
  for (std::size_t k = 0; k < 3 * n_; ++k) sum += q_[k] * 0 + v_[k] * 0;
  if (sum == 0) return n_;
  for (std::size_t k = 0; k < 3 * n_; ++k) {
    if (!std::isfinite(q_[k]) || !std::isfinite(v_[k])) return k % n_;
  }
  return n_;
}

void ParticleBlock::find_near(Sweep& sweep, double s0, double h, double radius,
                              std::span<const std::size_t> skip) {
  near_.clear();
  const double *x0 = p0_.data(), *x1 = q_.data(), *v0 = v0_.data(), *v1 = v_.data();
  const std::size_t n = n_;
  const double bend = (1 - s0) * h / 8;
  for (std::size_t i = 0; i < n; ++i) {
    const double dx = x1[i] - x0[i], dy = x1[n + i] - x0[n + i], dz = x1[2 * n + i] - x0[2 * n + i];
    const double length2 = dx * dx + dy * dy + dz * dz;
    inverse_length2_[i] = 1 / std::max(length2, std::numeric_limits<double>::min());
    const double change =
        std::abs(v1[i] - v0[i]) + std::abs(v1[n + i] - v0[n + i]) + std::abs(v1[2 * n + i] - v0[2 * n + i]);
    margin_[i] = radius + bend * change;
    gap_[i] = std::numeric_limits<double>::infinity();
  }
  const auto axis = [n](const std::vector<double>& a, std::size_t k) {
    return std::span<const double>{a.data() + k * n, n};
  };
  if (s0 == 0) {
    sweep.cull({axis(p0_, 0),
                axis(p0_, 1),
                axis(p0_, 2),
                axis(q_, 0),
                axis(q_, 1),
                axis(q_, 2),
                axis(inverse_length2_, 0),
                axis(margin_, 0),
                {gap_.data(), n},
                {scratch_.data(), n}});
  } else {
    std::fill_n(gap_.begin(), n, 0.0);  // born within the update: the bounds above are for whole ones
  }
  for (const std::size_t i : skip) gap_[i] = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < n; ++i) {
    if (gap_[i] <= 0) near_.push_back(i);
  }
}

MovingParticle ParticleBlock::particle_at(std::size_t i, double s0, double h, double radius) const {
  const std::size_t n = n_;
  const double time = (1 - s0) * h;
  const Vector3 p0{p0_[i], p0_[n + i], p0_[2 * n + i]}, p1{q_[i], q_[n + i], q_[2 * n + i]};
  const Vector3 v0{v0_[i], v0_[n + i], v0_[2 * n + i]}, v1{v_[i], v_[n + i], v_[2 * n + i]};
  const Vector3 a = (v1 - v0) / time;
  MovingParticle particle;
  particle.path = {.p = p0, .v = (p1 - p0) / time - 0.5 * time * a, .a = a, .s0 = s0, .h = h};
  particle.mass = mass_[i];
  particle.radius = radius;
  return particle;
}

void ParticleBlock::put(std::size_t i, const Vector3& p, const Vector3& v) {
  for (std::size_t k = 0; k < 3; ++k) {
    q_[k * n_ + i] = p[static_cast<Eigen::Index>(k)];
    v_[k * n_ + i] = v[static_cast<Eigen::Index>(k)];
  }
}

void ParticleBlock::store(ParticleArrays& to, std::size_t first) const {
  const auto copy = [&](const std::vector<double>& from, std::size_t axis, std::vector<double>& target) {
    std::copy_n(from.data() + axis * n_, n_, target.data() + first);
  };
  copy(q_, 0, to.x), copy(q_, 1, to.y), copy(q_, 2, to.z);
  copy(v_, 0, to.vx), copy(v_, 1, to.vy), copy(v_, 2, to.vz);
}

Energy ParticleBlock::energy(double t) const {
  Energy energy;
  const double *vx = v_.data(), *vy = vx + n_, *vz = vy + n_;
  double sum[2]{};
  for (std::size_t i = 0; i < n_; ++i) {
    sum[i % 2] += mass_[i] * (vx[i] * vx[i] + vy[i] * vy[i] + vz[i] * vz[i]);
  }
  energy.kinetic = 0.5 * (sum[0] + sum[1]);
  energy.potential = forces_.particle_energy(view({t, Side::After}, q_, v_));
  return energy;
}

ParticlesAt ParticleBlock::view(Instant at, std::span<const double> q, std::span<const double> v) const {
  return {.t = at.t,
          .side = at.side,
          .system = system_,
          .x = q.subspan(0, n_),
          .y = q.subspan(n_, n_),
          .z = q.subspan(2 * n_, n_),
          .vx = v.subspan(0, n_),
          .vy = v.subspan(n_, n_),
          .vz = v.subspan(2 * n_, n_),
          .mass = std::span<const double>{mass_}.first(n_)};
}

void ParticleBlock::rate(Instant, std::span<const double>, std::span<const double> v,
                         std::span<double> q_dot) {
  std::copy(v.begin(), v.end(), q_dot.begin());
}

void ParticleBlock::list_groups(NumberGroups& groups) {
  groups.clear();
  for (std::size_t i = 0; i < n_; ++i) {
    for (std::size_t k = 0; k < 6; ++k) groups.add(k * n_ + i, 1);
    groups.end_group();
  }
}

void ParticleBlock::acceleration(Instant at, std::span<const double> q, std::span<const double> v,
                                 std::span<double> v_dot) {
  ++evaluations;
  std::fill(v_dot.begin(), v_dot.end(), 0.0);
  forces_.gather(view(at, q, v), {v_dot.subspan(0, n_), v_dot.subspan(n_, n_), v_dot.subspan(2 * n_, n_)});
  const double* inverse = inverse_mass_.data();
  for (std::size_t k = 0; k < 3; ++k) {
    double* a = v_dot.data() + k * n_;
    for (std::size_t i = 0; i < n_; ++i) a[i] *= inverse[i];
  }
}

}  // namespace pantin

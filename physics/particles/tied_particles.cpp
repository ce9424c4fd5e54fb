#include <pantin/physics/particles/tied_particles.hpp>

#include <algorithm>
#include <cmath>

namespace pantin {
namespace {

constexpr double kTolerance = 1e-11;      // of a row's scale
constexpr double kSettled = 1e-9;         // of a row's scale: below this positions are left alone
constexpr double kSolveTolerance = 1e-4;  // of one linear solve among several
constexpr int kMostSolves = 40;
constexpr int kMostIterations = 2000;
/// Square of frequency times substep from which on a spring counts as faster than the substep can show.
constexpr double kFast = 4;

}  // namespace

void TiedParticles::add_rows(const Tie& tie, const std::uint32_t* at) {
  TieRow row;
  row.particles = tie.particles;
  std::copy_n(at, 4, row.particle);
  std::copy_n(tie.c, 4, row.c);
  row.rest = tie.rest;
  row.compliance = tie.compliance;
  row.damping_time = tie.damping_time;
  row.scale = tie.scale;
  if (!tie.straight) {
    rows_.push_back(row);
    return;
  }
  for (row.axis = 0; row.axis < 3; ++row.axis) {
    row.g = Vector3::Unit(row.axis);
    rows_.push_back(row);
  }
}

void TiedParticles::finish(std::span<const double> inverse_mass) {
  // Along a rope, rows in the order of their particles make a narrow band.
  const auto first = [](const TieRow& row) {
    return *std::min_element(row.particle, row.particle + row.particles);
  };
  std::stable_sort(rows_.begin(), rows_.end(),
                   [&](const TieRow& a, const TieRow& b) { return first(a) < first(b); });
  inverse_mass_.assign(inverse_mass.begin(), inverse_mass.end());
  impulse_.assign(inverse_mass.size(), Vector3::Zero());
  free_.resize(inverse_mass.size());
  d0_.resize(rows_.size());
  for (std::vector<double>* v : {&c0_, &lambda_, &delta_, &residual_, &softness_, &past_}) {
    v->assign(rows_.size(), 0.0);
  }
  system_.build(rows_, inverse_mass_);
}

Vector3 TiedParticles::span_of(const TieRow& row, std::span<const Vector3> q) {
  Vector3 d = Vector3::Zero();
  for (int k = 0; k < row.particles; ++k) d += row.c[k] * q[row.particle[k]];
  return d;
}

double TiedParticles::value(const TieRow& row, const Vector3& d) {
  return row.axis < 0 ? d.norm() - row.rest : d[row.axis];
}

/// q -= factor W J^T lambda
void TiedParticles::shift(double factor, std::span<const double> lambda, std::span<Vector3> q) const {
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    const TieRow& row = rows_[i];
    for (int k = 0; k < row.particles; ++k) {
      const std::uint32_t p = row.particle[k];
      q[p] -= (factor * inverse_mass_[p] * row.c[k] * lambda[i]) * row.g;
    }
  }
}

TieSolve TiedParticles::correct(std::span<Vector3> q) {
  TieSolve solve;
  for (int k = 0; k < kMostSolves; ++k) {
    double worst = 0;
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      TieRow& row = rows_[i];
      const Vector3 d = span_of(row, q);
      const double length = d.norm();
      if (row.axis < 0) row.g = length > 0 ? Vector3{d / length} : Vector3{Vector3::Zero()};
      const bool rigid = row.compliance == 0;
      residual_[i] = rigid ? value(row, d) : 0;
      // What has compliance takes no part.
      softness_[i] = rigid ? 0 : 1e12 * system_.inverse_mass(i) * row.g.squaredNorm();
      worst = std::max(worst, std::abs(residual_[i]) / row.scale);
    }
    if (worst <= (k == 0 ? kSettled : 0.01 * kSettled)) return solve;
    system_.assemble(rows_, 1, softness_);
    solve.iterations += system_.solve(residual_, delta_, kSolveTolerance, kMostIterations);
    shift(1, delta_, q);
  }
  solve.converged = false;
  return solve;
}

TieSolve TiedParticles::drift(double h, std::span<const Vector3> q0, std::span<Vector3> q1,
                              std::span<Vector3> v) {
  for (std::size_t p = 0; p < q0.size(); ++p) {
    free_[p] = inverse_mass_[p] > 0 ? Vector3{q0[p] + h * v[p]} : q1[p];
    q1[p] = free_[p];
  }
  const double factor = 0.5 * h * h;
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    const TieRow& row = rows_[i];
    d0_[i] = span_of(row, q0);
    c0_[i] = value(row, d0_[i]);
    lambda_[i] = 0;
    softness_[i] = 0;
    past_[i] = -1;
    if (row.compliance == 0) continue;
    // theta weighs the end: compliance * lambda = theta C1 + (1 - theta) C0.
    const double fast = h * h * system_.inverse_mass(i) / row.compliance;
    const double theta = 0.5 + 0.5 * fast / (fast + kFast) + row.damping_time / h;
    softness_[i] = row.compliance / theta;
    past_[i] = (1 - theta) / theta;
  }
  TieSolve solve;
  solve.converged = rows_.empty();
  for (int k = 0; k < kMostSolves && !solve.converged; ++k) {
    double worst = 0;
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      TieRow& row = rows_[i];
      const Vector3 d1 = span_of(row, q1);
      if (row.axis < 0) {
        const double lengths = d0_[i].norm() + d1.norm();
        row.g = lengths > 0 ? Vector3{(d0_[i] + d1) / lengths} : Vector3{Vector3::Zero()};
      }
      residual_[i] = value(row, d1) + past_[i] * c0_[i] - softness_[i] * lambda_[i];
      worst = std::max(worst, std::abs(residual_[i]) / row.scale);
    }
    if (k > 0 && worst <= kTolerance) {
      solve.converged = true;
      break;
    }
    system_.assemble(rows_, factor, softness_);
    solve.iterations += system_.solve(residual_, delta_, kSolveTolerance, kMostIterations);
    for (std::size_t i = 0; i < rows_.size(); ++i) lambda_[i] += delta_[i];
    std::copy(free_.begin(), free_.end(), q1.begin());
    shift(factor, lambda_, q1);
  }
  std::fill(impulse_.begin(), impulse_.end(), Vector3{Vector3::Zero()});
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    const TieRow& row = rows_[i];
    for (int k = 0; k < row.particles; ++k) impulse_[row.particle[k]] -= (h * row.c[k] * lambda_[i]) * row.g;
  }
  for (std::size_t p = 0; p < q0.size(); ++p) v[p] += inverse_mass_[p] * impulse_[p];
  return solve;
}

double TiedParticles::error(std::span<const Vector3> q) const {
  double worst = 0;
  for (const TieRow& row : rows_) {
    if (row.compliance == 0) worst = std::max(worst, std::abs(value(row, span_of(row, q))) / row.scale);
  }
  return worst;
}

double TiedParticles::energy(std::span<const Vector3> q) const {
  double sum = 0;
  for (const TieRow& row : rows_) {
    if (row.compliance == 0) continue;
    const double c = value(row, span_of(row, q));
    sum += 0.5 * c * c / row.compliance;
  }
  return sum;
}

}  // namespace pantin

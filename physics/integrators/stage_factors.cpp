#include <pantin/physics/integrators/stage_factors.hpp>

#include <algorithm>
#include <cmath>

namespace pantin {

namespace {

constexpr double kDifference = 3e-8, kLeastSize = 1e-3;  ///< of a number [m, rad, ...], for differences

}  // namespace

void StageFactors::begin(Dynamics& dynamics) {
  dynamics_ = &dynamics;
  nq_ = dynamics.coordinates(), nv_ = dynamics.velocities();
  change_.resize(nq_ + nv_);
  dynamics.list_groups(J_.groups);
  lines_ = dynamics.lines();
  coupling_.groups.clear();
  coupling_.groups.add(0, lines_.size());
  coupling_.groups.end_group();
  coupling_.fit();
  beside_lines_ = false;
  factored_for_ = 0;
}

void StageFactors::take(Instant at, double h, std::span<const double> y, std::span<const double> f,
                        bool beside_lines) {
  for (std::size_t j = 0; j < y.size(); ++j) {
    change_[j] = kDifference * std::max({std::abs(y[j]), std::min(std::abs(h * f[j]), 1.0), kLeastSize});
  }
  J_.fit();
  const JacobianPoint point{.at = at, .q = y.first(nq_), .v = y.subspan(nq_), .slope = f, .change = change_};
  if (beside_lines) dynamics_->jacobian_beside_lines(point, J_);
  else dynamics_->jacobian(point, J_);
  beside_lines_ = beside_lines;
  factored_for_ = 0;
}

void StageFactors::factor(double h) {
  if (h == factored_for_) return;
  for (std::size_t i = 0; i < kStages; ++i) solvers_[i].factor(J_, h * diagonal_[i]);
  factored_for_ = h;
}

void StageFactors::place_lines(const Stages& stages) {
  const std::size_t count = lines_.size() * kStages;
  by_q_.resize(nq_ * count);
  by_v_.resize(nv_ * count);
  response_.resize(nv_ * count);
  S_.resize((nq_ + nv_) * lines_.size());
  z_.resize(lines_.size());
  dynamics_->place_lines(stages, {by_q_, by_v_, response_});
}

void StageFactors::solve(std::size_t stage, std::span<double> x) {
  solvers_[stage].solve(J_, x);
  if (beside_lines_) add_lines(stage, x);
}

/// c_r . x
double StageFactors::effort(std::size_t line, std::size_t stage, std::span<const double> x) const {
  double stretch = 0, rate = 0;
  const double* by_q = by_q_.data() + line * nq_ * kStages + stage;
  for (std::size_t i = 0; i < nq_; ++i, by_q += kStages) stretch += *by_q * x[i];
  const double* by_v = by_v_.data() + line * nv_ * kStages + stage;
  for (std::size_t i = 0; i < nv_; ++i, by_v += kStages) rate += *by_v * x[nq_ + i];
  return lines_[line].stiffness * stretch + lines_[line].damping * rate;
}

void StageFactors::add_lines(std::size_t stage, std::span<double> x) {
  const std::size_t m = lines_.size(), n = nq_ + nv_;
  const double by = factored_for_ * diagonal_[stage];
  const std::span<double> CS = coupling_.block(0);
  for (std::size_t r = 0; r < m; ++r) {
    const std::span<double> column = std::span{S_}.subspan(r * n, n);
    std::fill_n(column.begin(), nq_, 0.0);
    for (std::size_t i = 0; i < nv_; ++i) column[nq_ + i] = by * response_[(r * nv_ + i) * kStages + stage];
    solvers_[stage].solve(J_, column);
    for (std::size_t k = 0; k < m; ++k) CS[r * m + k] = effort(k, stage, column);
    z_[r] = effort(r, stage, x);
  }
  coupled_.factor(coupling_, 1);
  coupled_.solve(coupling_, z_);
  for (std::size_t r = 0; r < m; ++r) {
    for (std::size_t i = 0; i < n; ++i) x[i] += z_[r] * S_[r * n + i];
  }
}

}  // namespace pantin

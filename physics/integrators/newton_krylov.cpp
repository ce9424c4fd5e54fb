#include <pantin/physics/integrators/newton_krylov.hpp>

#include <algorithm>
#include <cmath>

namespace pantin {
namespace {

constexpr int kMostNewtonSteps = 25;
constexpr std::size_t kMostColumns = 60;
constexpr std::size_t kMostWhole = 200;  // numbers: a matrix of them costs less than GMRES' passes may
constexpr double kAtRest = 1e-9;         // change of a last step that does not lower the residual
constexpr double kNear = 0.1;            // of the residual left: the next step may take the same matrix
constexpr double kSolved = 1e-15;        // of the numbers' size
constexpr double kGoodEnough = 1e-11;    // where round-off lets nothing improve any more
constexpr double kLinearAccuracy = 1e-5;
constexpr double kDifference = 1e-7;  // about the root of round-off: the best for a one-sided difference

double greatest(std::span<const double> x) {
  double most = 0;
  for (const double number : x) {
    if (!(std::abs(number) <= most)) most = std::abs(number);  // what is not a number stays
  }
  return most;
}

double dot(std::span<const double> a, std::span<const double> b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum;
}

}  // namespace

void NewtonKrylov::reserve(SlopeFunction& f, std::size_t n) {
  n_ = n;
  most_columns_ = std::min(n, kMostColumns);
  for (std::vector<double>* x : {&slope_, &residual_, &trial_, &trial_slope_, &step_}) x->resize(n);
  f.list_groups(J_.groups);
  is_whole_ = J_.groups.largest() <= kMostWhole;
  if (is_whole_) return;
  basis_.resize((most_columns_ + 1) * n);
  hessenberg_.resize((most_columns_ + 1) * most_columns_);
  for (std::vector<double>* x : {&cosine_, &sine_, &right_}) x->resize(most_columns_ + 1);
}

double NewtonKrylov::residual(SlopeFunction& f, double s, std::span<const double> y,
                              std::span<const double> scale, std::span<const double> z) {
  f.evaluate(z, slope_);
  for (std::size_t i = 0; i < n_; ++i) residual_[i] = (z[i] - y[i] - s * slope_[i]) / scale[i];
  return greatest(residual_);
}

bool NewtonKrylov::solve(SlopeFunction& f, double s, std::span<const double> y, std::span<const double> scale,
                         std::span<double> z) {
  reserve(f, z.size());
  double size = residual(f, s, y, scale, z);
  bool is_near = false;  // the matrix is of a state near enough
  for (int newton = 0; newton < kMostNewtonSteps && size > kSolved; ++newton) {
    const bool is_old = is_near;
    if (is_whole_ && !is_near) factor(f, s, scale, z);
    is_whole_ ? whole_direction() : krylov_direction(f, s, scale, z);
    const double before = size, change = greatest(step_);
    double part = 1;
    for (int halvings = 0; halvings < 8; ++halvings, part /= 2) {
      for (std::size_t i = 0; i < n_; ++i) trial_[i] = z[i] + part * scale[i] * step_[i];
      size = residual(f, s, y, scale, trial_);
      if (size < before || is_old) break;
    }
    is_near = is_whole_ && size < kNear * before;
    if (!(size < before) && is_old) {
      size = residual(f, s, y, scale, z);  // try again with the matrix of here
      continue;
    }
    // Where rows are large, round-off keeps the residual up though the numbers do not change any more.
    if (!(size < before)) return change <= kAtRest || before <= kGoodEnough;
    std::copy(trial_.begin(), trial_.end(), z.begin());
    if (change <= kSolved || (size > 0.1 * before && size <= kGoodEnough)) return true;
  }
  return size <= kGoodEnough;
}

void NewtonKrylov::factor(SlopeFunction& f, double s, std::span<const double> scale,
                          std::span<const double> z) {
  for (std::size_t i = 0; i < n_; ++i) trial_[i] = kDifference * scale[i];
  J_.fit();
  f.jacobian(z, slope_, trial_, J_);
  solver_.factor(J_, s, scale);
}

void NewtonKrylov::whole_direction() {
  for (std::size_t i = 0; i < n_; ++i) step_[i] = -residual_[i];
  solver_.solve(J_, step_);
}

void NewtonKrylov::apply(SlopeFunction& f, double s, std::span<const double> scale, std::span<const double> z,
                         std::size_t k) {
  const std::span<const double> u = basis(k);
  const std::span<double> out = basis(k + 1);
  for (std::size_t i = 0; i < n_; ++i) trial_[i] = z[i] + kDifference * scale[i] * u[i];
  f.evaluate(trial_, trial_slope_);
  for (std::size_t i = 0; i < n_; ++i) {
    out[i] = u[i] - s * (trial_slope_[i] - slope_[i]) / (kDifference * scale[i]);
  }
}

void NewtonKrylov::krylov_direction(SlopeFunction& f, double s, std::span<const double> scale,
                                    std::span<const double> z) {
  // GMRES (Y. Saad, M. Schultz, 1986) with modified Gram-Schmidt and Givens rotations; slope_ belongs to z.
  const double start = std::sqrt(dot(residual_, residual_));
  for (std::size_t i = 0; i < n_; ++i) basis(0)[i] = -residual_[i] / start;
  std::fill(right_.begin(), right_.end(), 0.0);
  right_[0] = start;
  std::size_t k = 0;
  while (k < most_columns_) {
    apply(f, s, scale, z, k);
    double* h = hessenberg_.data() + k * (most_columns_ + 1);
    const std::span<double> next = basis(k + 1);
    for (std::size_t j = 0; j <= k; ++j) {
      h[j] = dot(next, basis(j));
      for (std::size_t i = 0; i < n_; ++i) next[i] -= h[j] * basis(j)[i];
    }
    h[k + 1] = std::sqrt(dot(next, next));
    const double length = h[k + 1];
    for (std::size_t j = 0; j < k; ++j) {
      const double upper = cosine_[j] * h[j] + sine_[j] * h[j + 1];
      h[j + 1] = cosine_[j] * h[j + 1] - sine_[j] * h[j];
      h[j] = upper;
    }
    const double r = std::hypot(h[k], h[k + 1]);
    cosine_[k] = r > 0 ? h[k] / r : 1, sine_[k] = r > 0 ? h[k + 1] / r : 0;
    h[k] = r;
    right_[k + 1] = -sine_[k] * right_[k];
    right_[k] *= cosine_[k];
    ++k;
    if (!(length > 0) || std::abs(right_[k]) <= kLinearAccuracy * start) break;
    for (std::size_t i = 0; i < n_; ++i) next[i] /= length;
  }
  back_substitute(k);
}

void NewtonKrylov::back_substitute(std::size_t columns) {
  std::fill(step_.begin(), step_.end(), 0.0);
  for (std::size_t k = columns; k-- > 0;) {
    double x = right_[k];
    for (std::size_t j = k + 1; j < columns; ++j) x -= hessenberg_[j * (most_columns_ + 1) + k] * right_[j];
    right_[k] = x / hessenberg_[k * (most_columns_ + 1) + k];
    for (std::size_t i = 0; i < n_; ++i) step_[i] += right_[k] * basis(k)[i];
  }
}

}  // namespace pantin

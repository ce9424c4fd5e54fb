#include <pantin/physics/integrators/newton_krylov.hpp>

#include <algorithm>
#include <cmath>

#include <pantin/physics/integrators/step_arrays.hpp>

namespace pantin {
namespace {

constexpr int kMostNewtonSteps = 25;
constexpr std::size_t kMostColumns = 60;
constexpr std::size_t kMostDense = 200;  // numbers: a matrix of them costs less than GMRES' passes may
constexpr double kAtRest = 1e-9;         // change of a last step that does not lower the residual
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

void NewtonKrylov::reserve(std::size_t n) {
  n_ = n;
  most_columns_ = std::min(n, kMostColumns);
  for (std::vector<double>* x : {&slope_, &residual_, &trial_, &trial_slope_, &step_}) x->resize(n);
  if (n <= kMostDense) {
    matrix_.resize(n * (n + 1));
    return;
  }
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
  reserve(z.size());
  double size = residual(f, s, y, scale, z);
  for (int newton = 0; newton < kMostNewtonSteps && size > kSolved; ++newton) {
    n_ <= kMostDense ? dense_direction(f, s, scale, z) : newton_direction(f, s, scale, z);
    const double before = size, change = greatest(step_);
    double part = 1;
    for (int halvings = 0; halvings < 8; ++halvings, part /= 2) {
      for (std::size_t i = 0; i < n_; ++i) trial_[i] = z[i] + part * scale[i] * step_[i];
      size = residual(f, s, y, scale, trial_);
      if (size < before) break;
    }
    // Where rows are large, round-off keeps the residual up though the numbers do not change any more.
    if (!(size < before)) return change <= kAtRest || before <= kGoodEnough;
    std::copy(trial_.begin(), trial_.end(), z.begin());
    if (change <= kSolved || (size > 0.1 * before && size <= kGoodEnough)) return true;
  }
  return size <= kGoodEnough;
}

void NewtonKrylov::dense_direction(SlopeFunction& f, double s, std::span<const double> scale,
                                   std::span<const double> z) {
  const std::size_t width = n_ + 1;
  std::copy(z.begin(), z.end(), trial_.begin());
  for (std::size_t j = 0; j < n_; ++j) {
    const double by = kDifference * scale[j];
    trial_[j] = z[j] + by;
    f.evaluate(trial_, trial_slope_);
    trial_[j] = z[j];
    for (std::size_t i = 0; i < n_; ++i) {
      matrix_[i * width + j] =
          (i == j ? 1.0 : 0.0) - s * (trial_slope_[i] - slope_[i]) / by * scale[j] / scale[i];
    }
  }
  for (std::size_t i = 0; i < n_; ++i) matrix_[i * width + n_] = -residual_[i];

  // Gauss with rows scaled by their largest entry, so that pivots are chosen by direction, not by stiffness.
  const auto row = [&](std::size_t i) { return std::span{matrix_}.subspan(i * width, width); };
  for (std::size_t i = 0; i < n_; ++i) {
    const double largest = greatest(row(i).first(n_));
    for (double& entry : row(i)) entry /= largest;
  }
  for (std::size_t k = 0; k < n_; ++k) {
    std::size_t pivot = k;
    for (std::size_t i = k + 1; i < n_; ++i) {
      if (std::abs(row(i)[k]) > std::abs(row(pivot)[k])) pivot = i;
    }
    if (pivot != k) std::swap_ranges(row(k).begin(), row(k).end(), row(pivot).begin());
    for (std::size_t i = k + 1; i < n_; ++i) {
      const double factor = row(i)[k] / row(k)[k];
      if (factor != 0) add_scaled(row(i).subspan(k), -factor, row(k).subspan(k));
    }
  }
  for (std::size_t k = n_; k-- > 0;) {
    double x = row(k)[n_];
    for (std::size_t j = k + 1; j < n_; ++j) x -= row(k)[j] * step_[j];
    step_[k] = x / row(k)[k];
  }
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

void NewtonKrylov::newton_direction(SlopeFunction& f, double s, std::span<const double> scale,
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

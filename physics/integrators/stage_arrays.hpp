#pragma once
// Loops over numbers at several stages: number i of stage s at [i * stages + s]. The number of stages is made
// a constant where it is 4 or 8, so that compilers keep all stages of a number in registers.
#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <type_traits>

#include <pantin/physics/integrators/collocation.hpp>

namespace pantin {

/// Calls f with the number of stages as a constant.
template <class F>
inline decltype(auto) with_stages(int stages, F&& f) {
  if (stages == 4) return f(std::integral_constant<std::size_t, 4>{});
  if (stages == 8) return f(std::integral_constant<std::size_t, 8>{});
  return f(static_cast<std::size_t>(stages));
}

/// out = base + h sum_j a[j][.] slope_j, stage by stage.
void add_stages(int stages, std::span<double> out, std::span<const double> base, double h,
                std::span<const double> slopes, const NodeMatrix& a);

/// out = sum_j a[j][.] slope_j, stage by stage.
void combine_stages(int stages, std::span<double> out, std::span<const double> slopes, const NodeMatrix& a);

/// The same numbers at all stages.
inline void spread(int stages, std::span<double> out, std::span<const double> numbers) {
  const auto s = static_cast<std::size_t>(stages);
  for (std::size_t n = 0; n < numbers.size(); ++n) {
    for (std::size_t i = 0; i < s; ++i) out[n * s + i] = numbers[n];
  }
}

/// out = sum_j row[j] slope_j
inline void coefficients(int stages, std::span<double> out, std::span<const double> slopes,
                         const std::array<double, kMostNodes>& row) {
  with_stages(stages, [&](auto s) {
    const double* from = slopes.data();
    for (std::size_t n = 0; n < out.size(); ++n, from += s) {
      double sum = 0;
      for (std::size_t j = 0; j < s; ++j) sum += row[j] * from[j];
      out[n] = sum;
    }
  });
}

/// x += h sum_j b[j] slope_j, where `kept_back` keeps what rounding takes away (W. Kahan, Comm. ACM 8, 40
/// (1965)).
inline void add_compensated(int stages, std::span<double> x, std::span<double> kept_back, double h,
                            std::span<const double> slopes, const std::array<double, kMostNodes>& b) {
  with_stages(stages, [&](auto s) {
    const double* from = slopes.data();
    for (std::size_t n = 0; n < x.size(); ++n, from += s) {
      double sum = 0;
      for (std::size_t j = 0; j < s; ++j) sum += b[j] * from[j];
      const double y = h * sum + kept_back[n], t = x[n] + y;
      kept_back[n] = y - (t - x[n]);
      x[n] = t;
    }
  });
}

/// The greatest of weight |x|; what is not a number stays the greatest.
inline double greatest(std::span<const double> x, std::span<const double> weight) {
  double most = 0;
  for (std::size_t n = 0; n < x.size(); ++n) {
    const double size = weight[n] * std::abs(x[n]);
    if (!(size <= most)) most = size;
  }
  return most;
}
inline double greatest_difference(std::span<const double> x, std::span<const double> y,
                                  std::span<const double> weight) {
  double most = 0;
  for (std::size_t n = 0; n < x.size(); ++n) {
    const double size = weight[n] * std::abs(x[n] - y[n]);
    if (!(size <= most)) most = size;
  }
  return most;
}

/// The same over all stages; the weight is that of the number.
inline double greatest(int stages, std::span<const double> x, std::span<const double> weight) {
  return with_stages(stages, [&](auto s) {
    double most = 0;
    const double* from = x.data();
    for (std::size_t n = 0; n < weight.size(); ++n, from += s) {
      double size = 0;
      for (std::size_t i = 0; i < s; ++i) size += std::abs(from[i]);
      if (!(weight[n] * size <= most)) most = weight[n] * size;
    }
    return most;
  });
}
inline double greatest_difference(int stages, std::span<const double> x, std::span<const double> y,
                                  std::span<const double> weight) {
  return with_stages(stages, [&](auto s) {
    double most = 0;
    const double *a = x.data(), *b = y.data();
    for (std::size_t n = 0; n < weight.size(); ++n, a += s, b += s) {
      double size = 0;
      for (std::size_t i = 0; i < s; ++i) size += std::abs(a[i] - b[i]);
      if (!(weight[n] * size <= most)) most = weight[n] * size;
    }
    return most;
  });
}

/// a / b, where 0 / 0 is 0.
inline double quotient(double a, double b) { return a == 0 ? 0 : a / b; }

}  // namespace pantin

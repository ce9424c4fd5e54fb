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

/// Halves on halves, so that compilers add whole registers.
template <std::size_t n>
inline double sum_of(std::array<double, n> x) {
  for (std::size_t half = n / 2; half > 0; half /= 2) {
    for (std::size_t i = 0; i < half; ++i) x[i] += x[i + half];
  }
  return x[0];
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
      std::array<double, kMostNodes> parts{};
      for (std::size_t j = 0; j < s; ++j) parts[j] = b[j] * from[j];
      const double y = h * sum_of(parts) + kept_back[n], t = x[n] + y;
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

/// The sum of weight |x|.
inline double weighted_sum(std::span<const double> x, std::span<const double> weight) {
  double sum = 0;
  for (std::size_t n = 0; n < x.size(); ++n) sum += weight[n] * std::abs(x[n]);
  return sum;
}

/// The same, of what `size` says of each number at each stage, added up over the stages; the weight is that
/// of the number.
template <class Size>
inline double greatest_over_stages(int stages, std::span<const double> weight, Size size) {
  return with_stages(stages, [&](auto s) {
    double most = 0;
    for (std::size_t n = 0; n < weight.size(); ++n) {
      std::array<double, kMostNodes> sizes{};
      for (std::size_t i = 0; i < s; ++i) sizes[i] = size(n * s + i);
      const double all = weight[n] * sum_of(sizes);
      if (!(all <= most)) most = all;
    }
    return most;
  });
}
inline double greatest(int stages, std::span<const double> x, std::span<const double> weight) {
  const double* from = x.data();
  return greatest_over_stages(stages, weight, [from](std::size_t i) { return std::abs(from[i]); });
}
inline double greatest_difference(int stages, std::span<const double> x, std::span<const double> y,
                                  std::span<const double> weight) {
  const double *a = x.data(), *b = y.data();
  return greatest_over_stages(stages, weight, [a, b](std::size_t i) { return std::abs(a[i] - b[i]); });
}

/// The greatest of weight |x| stage by stage.
inline std::array<double, kMostNodes> greatest_by_stage(int stages, std::span<const double> x,
                                                        std::span<const double> weight) {
  return with_stages(stages, [&](auto s) {
    std::array<double, kMostNodes> most{};
    const double* from = x.data();
    for (std::size_t n = 0; n < weight.size(); ++n, from += s) {
      for (std::size_t i = 0; i < s; ++i) {
        const double size = weight[n] * std::abs(from[i]);
        most[i] = size <= most[i] ? most[i] : size;
      }
    }
    return most;
  });
}

/// out = the numbers of one stage.
inline void take_stage(int stages, std::span<double> out, std::span<const double> x, int stage) {
  const auto s = static_cast<std::size_t>(stages);
  const double* from = x.data() + stage;
  for (std::size_t n = 0; n < out.size(); ++n, from += s) out[n] = *from;
}

/// x^n, n >= 0.
inline double power(double x, int n) {
  double product = 1;
  for (; n > 0; n /= 2, x *= x) {
    if (n % 2 != 0) product *= x;
  }
  return product;
}

/// a / b, where 0 / 0 is 0.
inline double quotient(double a, double b) { return a == 0 ? 0 : a / b; }

}  // namespace pantin

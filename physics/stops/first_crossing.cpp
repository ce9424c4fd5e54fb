#include <pantin/physics/stops/first_crossing.hpp>

#include <algorithm>
#include <array>

namespace pantin {

namespace {

using Bernstein = std::array<double, kMostDegree + 1>;

/// Halvings until neighbouring numbers are reached.
constexpr int kDeepest = 52;

Bernstein in_bernstein_form(std::span<const double> c) {
  // b_i = sum_{k <= i} C(i, k) / C(n, k) c_k
  const std::size_t n = c.size() - 1;
  Bernstein b{};
  for (std::size_t i = 0; i <= n; ++i) {
    double ratio = 1;  // C(i, k) / C(n, k)
    for (std::size_t k = 0; k <= i; ++k) {
      b[i] += ratio * c[k];
      ratio *= k < i ? static_cast<double>(i - k) / static_cast<double>(n - k) : 0;
    }
  }
  return b;
}

/// de Casteljau at the middle.
void halve(const Bernstein& b, std::size_t n, Bernstein& left, Bernstein& right) {
  right = b;
  for (std::size_t level = 0; level <= n; ++level) {
    left[level] = right[0];
    for (std::size_t i = 0; i + level < n; ++i) right[i] = 0.5 * (right[i] + right[i + 1]);
  }
}

std::optional<double> search(const Bernstein& b, std::size_t n, double begin, double width, int depth) {
  if (b[0] > 0) return begin;
  if (std::all_of(b.begin(), b.begin() + static_cast<std::ptrdiff_t>(n) + 1,
                  [](double x) { return !(x > 0); })) {
    return std::nullopt;
  }
  if (depth == kDeepest) return begin;
  Bernstein left{}, right{};
  halve(b, n, left, right);
  const std::optional<double> first = search(left, n, begin, 0.5 * width, depth + 1);
  return first ? first : search(right, n, begin + 0.5 * width, 0.5 * width, depth + 1);
}

}  // namespace

std::optional<double> first_above_zero(std::span<const double> c) {
  return search(in_bernstein_form(c), c.size() - 1, 0, 1, 0);
}

}  // namespace pantin

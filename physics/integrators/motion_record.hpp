#pragma once
// The motion inside a step, part by part, as polynomials of time: dense output. Filled by integrators that
// have an interpolant of their own, and by cubics between the ends of a step for all others.
#include <cstddef>
#include <span>
#include <vector>

namespace pantin {

/// Numbers y = (q, v) over the parts of one step: y(t + x h) = sum_k c_k x^k with 0 <= x <= 1. Work space is
/// kept: a steady step allocates nothing.
class MotionRecord {
 public:
  void clear() noexcept;
  void keep_first(std::size_t parts);  ///< and forget those behind
  [[nodiscard]] bool empty() const noexcept { return parts_.empty(); }
  [[nodiscard]] std::size_t parts() const noexcept { return parts_.size(); }
  [[nodiscard]] double begin() const;  ///< [s]; must not be empty
  [[nodiscard]] double end() const;    ///< [s]; must not be empty

  /// Coefficients of one part, to be filled: number i of c_k at [k * size + i], q first, then v.
  struct Room {
    std::size_t size{0};  ///< q.size() + v.size()
    std::span<double> c{};
    [[nodiscard]] std::span<double> at(std::size_t k) const { return c.subspan(k * size, size); }
  };
  /// A part that follows the last one, from t to t + h [s], starting at (q, v), which becomes c_0.
  [[nodiscard]] Room add(double t, double h, std::size_t degree, std::span<const double> q,
                         std::span<const double> v);
  /// Where c_0 and c_1 hold the values and c_3 and c_2 the derivatives [1/s] at the begin and the end of the
  /// part, makes them the cubic through these.
  static void fit_cubic(const Room& part, double h);

  struct Span {
    double t{0}, h{0};  ///< [s]
    std::size_t degree{0};
  };
  [[nodiscard]] Span part(std::size_t i) const;
  /// c_0 to c_degree of one number in one part; numbers are those of q, then those of v.
  void coefficients(std::size_t part, std::size_t number, std::span<double> c) const;

  /// The first q.size() and v.size() numbers at a time from begin to end; at a seam those before it.
  void evaluate(double t, std::span<double> q, std::span<double> v) const;

 private:
  struct Part {
    double t{0}, h{0};
    std::size_t degree{0}, q{0}, v{0};
    std::size_t first{0};  ///< of its coefficients
  };
  std::vector<Part> parts_{};
  std::vector<double> coefficients_{};
};

}  // namespace pantin

#pragma once
// What stops and dry friction exert, as a complementarity problem with bounds: x with lower <= x <= upper and
//
//   w = W x + b,   w = 0 where x is between its bounds,  w >= 0 at the lower,  w <= 0 at the upper,
//
// W symmetric, positive definite but for redundant rows. Solved by block principal pivoting (J. Judice, F.
// Pires, Computers & Operations Research 21, 587 (1994)): guess which x are at bounds, solve for the others,
// move all that are wrong; when that helps no more, one at a time, the last one first (K. Murty, Linear
// Complementarity, 1988, ch. 4), which ends for every positive definite W.
#include <cstdint>
#include <span>
#include <vector>

namespace pantin {

class BoxedProblem {
 public:
  enum class At : std::uint8_t { Between, Lower, Upper };

  /// Room for so many unknowns; W and b are zero, bounds infinite, all x guessed between their bounds.
  void reset(std::size_t size);
  [[nodiscard]] std::size_t size() const noexcept { return b.size(); }
  [[nodiscard]] double& W(std::size_t row, std::size_t column) { return W_[row * b.size() + column]; }

  /// False where x is only what the last guess gave, put within its bounds: then W was no matrix of this
  /// kind, or not finite.
  bool solve();

  std::vector<double> b{}, lower{}, upper{};
  std::vector<double> x{};  ///< answer
  std::vector<At> at{};     ///< guess, then answer

 private:
  bool solve_between();
  double row_times_x(std::size_t i) const;
  int find_wrong();

  std::vector<double> W_{}, L_{}, y_{}, r_{};
  std::vector<std::size_t> between_{}, wrong_{};
};

}  // namespace pantin

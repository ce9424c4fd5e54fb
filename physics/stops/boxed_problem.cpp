#include <pantin/physics/stops/boxed_problem.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace pantin {

namespace {

/// Relative to the diagonal: keeps redundant rows solvable; a pass of refinement takes its effect on others
/// away.
constexpr double kRegular = 1e-12;
constexpr int kRefinements = 2;
/// What is less than this part of the numbers it is the difference of is no reason to move.
constexpr double kRounding = 1e-12;
/// Blocks are moved for so many rounds without fewer being wrong.
constexpr int kPatience = 5;

}  // namespace

void BoxedProblem::reset(std::size_t size) {
  W_.assign(size * size, 0.0);
  L_.resize(size * size);
  for (std::vector<double>* a : {&b, &x}) a->assign(size, 0.0);
  y_.resize(size);
  r_.resize(size);
  lower.assign(size, -std::numeric_limits<double>::infinity());
  upper.assign(size, std::numeric_limits<double>::infinity());
  at.assign(size, At::Between);
  between_.reserve(size);
  wrong_.reserve(size);
}

double BoxedProblem::row_times_x(std::size_t i) const {
  double sum = b[i];
  for (std::size_t j = 0; j < x.size(); ++j) sum += W_[i * x.size() + j] * x[j];
  return sum;
}

/// W_BB x_B = -b_B - W_BA x_A, B between bounds, A at them; by L L^T.
bool BoxedProblem::solve_between() {
  between_.clear();
  for (std::size_t i = 0; i < size(); ++i) {
    x[i] = at[i] == At::Lower ? lower[i] : at[i] == At::Upper ? upper[i] : 0;
    if (at[i] == At::Between) between_.push_back(i);
  }
  const std::size_t n = between_.size();
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j <= i; ++j) {
      double sum = W(between_[i], between_[j]);
      if (i == j) sum *= 1 + kRegular;
      for (std::size_t k = 0; k < j; ++k) sum -= L_[i * n + k] * L_[j * n + k];
      if (i == j && !(sum > 0)) {
        // A row that others make redundant beyond what regularity helps: it takes no part.
        if (!std::isfinite(sum)) return false;
        sum = std::numeric_limits<double>::infinity();
      }
      L_[i * n + j] = i == j ? std::sqrt(sum) : sum / L_[j * n + j];
    }
  }
  for (int pass = 0; pass <= kRefinements; ++pass) {
    for (std::size_t i = 0; i < n; ++i) r_[i] = -row_times_x(between_[i]);
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t k = 0; k < i; ++k) r_[i] -= L_[i * n + k] * r_[k];
      r_[i] /= L_[i * n + i];
    }
    for (std::size_t i = n; i-- > 0;) {
      for (std::size_t k = i + 1; k < n; ++k) r_[i] -= L_[k * n + i] * r_[k];
      r_[i] /= L_[i * n + i];
    }
    for (std::size_t i = 0; i < n; ++i) x[between_[i]] += r_[i];
  }
  return true;
}

/// Lists what contradicts the guess, and says how many these are.
int BoxedProblem::find_wrong() {
  wrong_.clear();
  for (std::size_t i = 0; i < size(); ++i) {
    double scale = std::abs(b[i]);
    for (std::size_t j = 0; j < size(); ++j) scale += std::abs(W(i, j) * x[j]);
    const double diagonal = W(i, i), slack_w = kRounding * scale;
    const double slack_x = diagonal > 0 ? slack_w / diagonal : 0, w = row_times_x(i);
    const bool wrong = at[i] == At::Between ? x[i] < lower[i] - slack_x || x[i] > upper[i] + slack_x
                       : at[i] == At::Lower ? w < -slack_w
                                            : w > slack_w;
    if (wrong) wrong_.push_back(i);
  }
  return static_cast<int>(wrong_.size());
}

bool BoxedProblem::solve() {
  const auto move = [this](std::size_t i) {
    at[i] = at[i] != At::Between ? At::Between : x[i] < lower[i] ? At::Lower : At::Upper;
  };
  int fewest = static_cast<int>(size()) + 1, patience = kPatience;
  const int most = 100 + 20 * static_cast<int>(size());
  for (int round = 0; round < most; ++round) {
    if (!solve_between()) break;
    const int wrong = find_wrong();
    if (wrong == 0) return true;
    if (wrong < fewest) {
      fewest = wrong;
      patience = kPatience;
    } else {
      --patience;
    }
    if (patience > 0) std::for_each(wrong_.begin(), wrong_.end(), move);
    else move(wrong_.back());
  }
  for (std::size_t i = 0; i < size(); ++i) {
    x[i] = std::isfinite(x[i]) ? std::clamp(x[i], lower[i], upper[i]) : 0;
  }
  return false;
}

}  // namespace pantin

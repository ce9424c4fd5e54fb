#include <pantin/physics/constraints/closure_solver.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace pantin {

namespace {

using kernel::dot;

/// mu for scaled rows. Directions in which a loop is nearer to singular than some 1e-5 rad are let go, which
/// keeps rounding from being multiplied without end; inertia carries the mechanism through. Ten times more
/// costs short steps accuracy there (1e-7 m where bars of a chain of four-bars are in line), ten times less
/// costs long steps theirs (1e-4 m).
constexpr double kProximal = 1e-10;
/// Pivots below are those of rows that others make redundant.
constexpr double kRedundant = 100 * kProximal;
constexpr int kRefinements = 4;
constexpr double kRounding = 8 * std::numeric_limits<double>::epsilon();

}  // namespace

void ClosureSolver::resize(const TreeLayout& layout) {
  places_.assign(1, {});
  row_at_.clear();
  left_.clear();
  std::size_t entries = 0, y = 0;
  std::uint32_t row = 0;
  for (const Tree& tree : layout.trees) {
    for (std::uint32_t c = tree.closures_begin; c < tree.closures_end; ++c) {
      const Closure& closure = layout.closures[c];
      const auto shares = [&](const Closure& other) {
        for (std::uint32_t i = closure.path_begin; i < closure.path_end; ++i) {
          for (std::uint32_t k = other.path_begin; k < other.path_end; ++k) {
            if (layout.paths[i].link == layout.paths[k].link) return true;
          }
        }
        return false;
      };
      std::uint32_t first = tree.closures_begin;
      while (first < c && !shares(layout.closures[first])) ++first;
      places_.back() = {row, y, places_[first].row};
      for (std::uint32_t i = 0; i < closure.rows; ++i, ++row) {
        row_at_.push_back(entries);
        left_.push_back(places_[c].left);
        entries += row - left_.back() + 1;
      }
      y += std::size_t{closure.rows} * closure.path_rates;
      places_.push_back({row, y, row});
    }
  }
  std::uint32_t longest = 0;
  for (const Closure& closure : layout.closures) {
    longest = std::max(longest, closure.path_end - closure.path_begin);
  }
  passing_.resize(longest);
  rows_.resize(row);
  y_.resize(y);
  W_.resize(entries);
  K_.resize(entries);
  for (std::vector<double>* x : {&scale_, &b_, &lambda_, &residual_, &multiplier_, &turned_})
    x->assign(row, 0.0);
}

void ClosureSolver::measure(const TreeLayout& layout, const Tree& tree, const Articulated& kernel,
                            std::span<const RigidMotion> grounds, Instant at,
                            const CoordinateMotion& motion) {
  for (std::uint32_t c = tree.closures_begin; c < tree.closures_end; ++c) {
    const Closure& closure = layout.closures[c];
    if (closure.coupling >= 0) {
      rows_[places_[c].row] = coupling_row(layout, closure, motion);
      continue;
    }
    write_rows(closure, motion_of(closure, kernel, grounds, at),
               std::span{rows_}.subspan(places_[c].row, closure.rows));
  }
}

void ClosureSolver::factor(const TreeLayout& layout, const Tree& tree, const Articulated& kernel) {
  assemble(layout, tree, kernel);
  const std::uint32_t begin = places_[tree.closures_begin].row, end = places_[tree.closures_end].row;
  for (std::uint32_t i = begin; i < end; ++i) {
    const std::size_t at = row_at_[i];
    for (std::uint32_t j = left_[i]; j <= i; ++j) {
      const double w = scale_[i] * scale_[j] * W_[at + (j - left_[i])];
      W_[at + (j - left_[i])] = w;
      K_[at + (j - left_[i])] = w;
    }
    K_[at + (i - left_[i])] += scale_[i] == 0 ? 1 : kProximal;
  }
  factor_envelope(begin, end);
}

void ClosureSolver::assemble(const TreeLayout& layout, const Tree& tree, const Articulated& kernel) {
  for (std::uint32_t c = tree.closures_begin; c < tree.closures_end; ++c) {
    const Closure& closure = layout.closures[c];
    for (std::uint32_t r = 0; r < closure.rows; ++r) {
      const std::uint32_t row = places_[c].row + r;
      const std::span<double> y =
          std::span{y_}.subspan(places_[c].y + std::size_t{r} * closure.path_rates, closure.path_rates);
      const Articulated::Reduction reduction = kernel.reduce(layout, closure, rows_[row].wrench, passing_, y);
      const double bound = reduction.bound + rows_[row].compliance;
      scale_[row] = bound > 0 ? 1 / std::sqrt(bound) : 0;
      if (!std::isfinite(reduction.squares)) scale_[row] = std::numeric_limits<double>::quiet_NaN();
    }
    for (std::uint32_t d = tree.closures_begin; d <= c; ++d) {
      if (places_[d + 1].row > places_[c].left) assemble_block(layout, c, d, kernel);
    }
    for (std::uint32_t i = places_[c].row; i < places_[c + 1].row; ++i)
      W_[row_at_[i] + (i - left_[i])] += rows_[i].compliance;
  }
}

void ClosureSolver::assemble_block(const TreeLayout& layout, std::uint32_t c, std::uint32_t d,
                                   const Articulated& kernel) {
  const Closure &x = layout.closures[c], &y = layout.closures[d];
  for (std::uint32_t r = 0; r < x.rows; ++r) {
    const std::uint32_t i = places_[c].row + r;
    for (std::uint32_t s = 0; s < y.rows && places_[d].row + s <= i; ++s) {
      const double* u = y_.data() + places_[c].y + std::size_t{r} * x.path_rates;
      const double* v = y_.data() + places_[d].y + std::size_t{s} * y.path_rates;
      double sum = 0;
      // Both paths go from later links to earlier ones.
      for (std::uint32_t k = x.path_begin, l = y.path_begin; k < x.path_end && l < y.path_end;) {
        const PathLink &a = layout.paths[k], &b = layout.paths[l];
        if (a.link == b.link) sum += kernel.product(layout, a.link, u + a.rates, v + b.rates);
        k += a.link >= b.link ? 1 : 0;
        l += b.link >= a.link ? 1 : 0;
      }
      W_[row_at_[i] + (places_[d].row + s - left_[i])] = sum;
    }
  }
}

/// K = L d L^T within the envelope, in place.
void ClosureSolver::factor_envelope(std::uint32_t begin, std::uint32_t end) {
  for (std::uint32_t i = begin; i < end; ++i) {
    double* row = K_.data() + row_at_[i];
    const std::uint32_t li = left_[i];
    for (std::uint32_t j = li; j < i; ++j) {
      const double* other = K_.data() + row_at_[j];
      const std::uint32_t lj = left_[j], from = std::max(li, lj);
      double sum = row[j - li];
      for (std::uint32_t k = from; k < j; ++k) sum -= row[k - li] * other[k - lj];  // row holds L d so far
      row[j - li] = sum;
    }
    double d = row[i - li];
    for (std::uint32_t j = li; j < i; ++j) {
      const double l_d = row[j - li], l = l_d / K_[row_at_[j] + (j - left_[j])];
      d -= l_d * l;
      row[j - li] = l;
    }
    row[i - li] = d;
  }
}

void ClosureSolver::substitute_envelope(std::uint32_t begin, std::uint32_t end,
                                        std::vector<double>& x) const {
  for (std::uint32_t i = begin; i < end; ++i) {
    const double* row = K_.data() + row_at_[i];
    for (std::uint32_t j = left_[i]; j < i; ++j) x[i] -= row[j - left_[i]] * x[j];
  }
  for (std::uint32_t i = begin; i < end; ++i) x[i] /= K_[row_at_[i] + (i - left_[i])];
  for (std::uint32_t i = end; i-- > begin;) {
    const double* row = K_.data() + row_at_[i];
    for (std::uint32_t j = left_[i]; j < i; ++j) x[j] -= row[j - left_[i]] * x[i];
  }
}

void ClosureSolver::multiply(std::uint32_t begin, std::uint32_t end, const std::vector<double>& x,
                             std::vector<double>& out) const {
  for (std::uint32_t i = begin; i < end; ++i) {
    const double* row = W_.data() + row_at_[i];
    double sum = row[i - left_[i]] * x[i];
    for (std::uint32_t j = left_[i]; j < i; ++j) {
      sum += row[j - left_[i]] * x[j];
      out[j] += row[j - left_[i]] * x[i];
    }
    out[i] = sum;
  }
}

void ClosureSolver::solve(const TreeLayout& layout, const Tree& tree, ClosureLevel level,
                          Articulated& kernel) {
  const std::uint32_t begin = places_[tree.closures_begin].row, end = places_[tree.closures_end].row;
  for (std::uint32_t i = begin; i < end; ++i) {
    const ClosureRow& row = rows_[i];
    const double has = level == ClosureLevel::Position   ? row.gap
                       : level == ClosureLevel::Velocity ? row.rate
                                                         : row.acceleration;
    b_[i] = scale_[i] == 0 ? 0 : -scale_[i] * has;
    lambda_[i] = b_[i];
  }
  substitute_envelope(begin, end, lambda_);
  for (int pass = 0; pass < kRefinements; ++pass) {
    multiply(begin, end, lambda_, residual_);
    for (std::uint32_t i = begin; i < end; ++i) residual_[i] = b_[i] - residual_[i];
    substitute_envelope(begin, end, residual_);
    for (std::uint32_t i = begin; i < end; ++i) lambda_[i] += residual_[i];
  }
  for (std::uint32_t c = tree.closures_begin; c < tree.closures_end; ++c) {
    const Closure& closure = layout.closures[c];
    for (std::uint32_t r = 0; r < closure.rows; ++r) {
      const std::uint32_t i = places_[c].row + r;
      multiplier_[i] = scale_[i] * lambda_[i];
      if (multiplier_[i] == 0) continue;
      kernel.push(
          layout, closure, multiplier_[i],
          std::span{y_}.subspan(places_[c].y + std::size_t{r} * closure.path_rates, closure.path_rates));
    }
  }
}

void ClosureSolver::keep_rotor_rates(const Tree& tree) {
  for (std::uint32_t i = places_[tree.closures_begin].row; i < places_[tree.closures_end].row; ++i)
    turned_[i] = rows_[i].turning;
}

void ClosureSolver::compare_rotor_rates(const Tree& tree) {
  for (std::uint32_t i = places_[tree.closures_begin].row; i < places_[tree.closures_end].row; ++i)
    if (rows_[i].compliance > 0) rows_[i].rate = rows_[i].turning - turned_[i];
}

namespace {

/// What is not a number stays the greatest.
void count(double difference, double size, double& most) {
  if (difference == 0) return;
  const double here = std::abs(difference) / (kRounding * size);
  if (!(here <= most)) most = here;
}

}  // namespace

double ClosureSolver::margin(const Tree& tree) const {
  double least = 1;
  for (std::uint32_t i = places_[tree.closures_begin].row; i < places_[tree.closures_end].row; ++i) {
    const double pivot = K_[row_at_[i] + (i - left_[i])];
    if (pivot > kRedundant && rows_[i].compliance == 0) least = std::min(least, pivot);
  }
  return least;
}

double ClosureSolver::gap_in_roundings(const Tree& tree) const {
  double most = 0;
  for (std::uint32_t i = places_[tree.closures_begin].row; i < places_[tree.closures_end].row; ++i) {
    count(rows_[i].gap, rows_[i].size, most);
  }
  return most;
}

double ClosureSolver::rate_in_roundings(const Tree& tree) const {
  double most = 0;
  for (std::uint32_t i = places_[tree.closures_begin].row; i < places_[tree.closures_end].row; ++i) {
    count(rows_[i].rate, rows_[i].rate_size, most);
  }
  return most;
}

double ClosureSolver::gap_squared(const Tree& tree) const {
  double sum = 0;
  for (std::uint32_t i = places_[tree.closures_begin].row; i < places_[tree.closures_end].row; ++i) {
    sum += rows_[i].gap * rows_[i].gap;
  }
  return sum;
}

std::span<const ClosureRow> ClosureSolver::rows(std::uint32_t closure) const {
  return std::span{rows_}.subspan(places_[closure].row, places_[closure + 1].row - places_[closure].row);
}

ClosureWrench ClosureSolver::wrench(std::uint32_t closure) const {
  ClosureWrench sum;
  for (std::uint32_t i = places_[closure].row; i < places_[closure + 1].row; ++i) {
    sum.force += multiplier_[i] * rows_[i].wrench.force;
    sum.torque += multiplier_[i] * rows_[i].wrench.torque;
  }
  return sum;
}

}  // namespace pantin

#include <pantin/physics/constraints/closure_solver.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace pantin {

namespace {

using kernel::dot;

constexpr double kRounding = 8 * std::numeric_limits<double>::epsilon();

}  // namespace

void ClosureSolver::resize(const TreeLayout& layout) {
  at_ = lay_out_rows(layout);
  passing_.resize(at_.longest_path);
  rows_.resize(at_.rows());
  y_.resize(at_.places.back().y);
  W_.resize(at_.begins.back());
  K_.resize(at_.begins.back());
  for (std::vector<double>* x : {&scale_, &mu_, &b_, &lambda_, &residual_, &multiplier_, &turned_})
    x->assign(at_.rows(), 0.0);
}

Proximal<double> ClosureSolver::proximal(const Tree& tree) {
  const std::size_t begin = at_.begins[at_.first_row(tree)];
  return {at_.envelope(tree), W_.data() + begin, K_.data() + begin};
}

void ClosureSolver::measure(const TreeLayout& layout, const Tree& tree, const Articulated& kernel,
                            std::span<const RigidMotion> grounds, Instant at,
                            const CoordinateMotion& motion) {
  for (std::uint32_t c = tree.closures_begin; c < tree.closures_end; ++c) {
    const Closure& closure = layout.closures[c];
    if (closure.coupling >= 0) {
      rows_[at_.places[c].row] = coupling_row(layout, closure, motion);
      continue;
    }
    write_rows(closure, motion_of(closure, kernel, grounds, at),
               std::span{rows_}.subspan(at_.places[c].row, closure.rows));
  }
}

void ClosureSolver::factor(const TreeLayout& layout, const Tree& tree, const Articulated& kernel) {
  assemble(layout, tree, kernel);
  const std::uint32_t first = at_.first_row(tree);
  for (std::uint32_t i = first; i < at_.last_row(tree); ++i) mu_[i] = scale_[i] == 0 ? 1 : kProximal;
  proximal(tree).factor(scale_.data() + first, mu_.data() + first);
}

void ClosureSolver::assemble(const TreeLayout& layout, const Tree& tree, const Articulated& kernel) {
  for (std::uint32_t c = tree.closures_begin; c < tree.closures_end; ++c) {
    const Closure& closure = layout.closures[c];
    for (std::uint32_t r = 0; r < closure.rows; ++r) {
      const std::uint32_t row = at_.places[c].row + r;
      const std::span<double> y =
          std::span{y_}.subspan(at_.places[c].y + std::size_t{r} * closure.path_rates, closure.path_rates);
      const Articulated::Reduction reduction = kernel.reduce(layout, closure, rows_[row].wrench, passing_, y);
      const double bound = reduction.bound + rows_[row].compliance;
      scale_[row] = bound > 0 ? 1 / std::sqrt(bound) : 0;
      if (!std::isfinite(reduction.squares)) scale_[row] = std::numeric_limits<double>::quiet_NaN();
    }
    for (std::uint32_t d = tree.closures_begin; d <= c; ++d) {
      if (at_.places[d + 1].row > at_.left[at_.places[c].row]) assemble_block(layout, c, d, kernel);
    }
    for (std::uint32_t i = at_.places[c].row; i < at_.places[c + 1].row; ++i)
      W_[at_.begins[i] + (i - at_.left[i])] += rows_[i].compliance;
  }
}

void ClosureSolver::assemble_block(const TreeLayout& layout, std::uint32_t c, std::uint32_t d,
                                   const Articulated& kernel) {
  const Closure &x = layout.closures[c], &y = layout.closures[d];
  for (std::uint32_t r = 0; r < x.rows; ++r) {
    const std::uint32_t i = at_.places[c].row + r;
    for (std::uint32_t s = 0; s < y.rows && at_.places[d].row + s <= i; ++s) {
      const double* u = y_.data() + at_.places[c].y + std::size_t{r} * x.path_rates;
      const double* v = y_.data() + at_.places[d].y + std::size_t{s} * y.path_rates;
      double sum = 0;
      // Both paths go from later links to earlier ones.
      for (std::uint32_t k = x.path_begin, l = y.path_begin; k < x.path_end && l < y.path_end;) {
        const PathLink &a = layout.paths[k], &b = layout.paths[l];
        if (a.link == b.link) sum += kernel.product(layout, a.link, u + a.rates, v + b.rates);
        k += a.link >= b.link ? 1 : 0;
        l += b.link >= a.link ? 1 : 0;
      }
      W_[at_.begins[i] + (at_.places[d].row + s - at_.left[i])] = sum;
    }
  }
}

void ClosureSolver::solve(const TreeLayout& layout, const Tree& tree, ClosureLevel level,
                          Articulated& kernel) {
  const std::uint32_t begin = at_.first_row(tree), end = at_.last_row(tree);
  for (std::uint32_t i = begin; i < end; ++i) {
    const ClosureRow& row = rows_[i];
    const double has = level == ClosureLevel::Position   ? row.gap
                       : level == ClosureLevel::Velocity ? row.rate
                                                         : row.acceleration;
    b_[i] = scale_[i] == 0 ? 0 : -scale_[i] * has;
  }
  proximal(tree).solve(b_.data() + begin, lambda_.data() + begin, residual_.data() + begin);
  for (std::uint32_t c = tree.closures_begin; c < tree.closures_end; ++c) {
    const Closure& closure = layout.closures[c];
    for (std::uint32_t r = 0; r < closure.rows; ++r) {
      const std::uint32_t i = at_.places[c].row + r;
      multiplier_[i] = scale_[i] * lambda_[i];
      if (multiplier_[i] == 0) continue;
      kernel.push(
          layout, closure, multiplier_[i],
          std::span{y_}.subspan(at_.places[c].y + std::size_t{r} * closure.path_rates, closure.path_rates));
    }
  }
}

void ClosureSolver::keep_rotor_rates(const Tree& tree) {
  for (std::uint32_t i = at_.first_row(tree); i < at_.last_row(tree); ++i) turned_[i] = rows_[i].turning;
}

void ClosureSolver::compare_rotor_rates(const Tree& tree) {
  for (std::uint32_t i = at_.first_row(tree); i < at_.last_row(tree); ++i)
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
  for (std::uint32_t i = at_.first_row(tree); i < at_.last_row(tree); ++i) {
    const double pivot = 1 / K_[at_.begins[i] + (i - at_.left[i])];
    if (pivot > kRedundant && rows_[i].compliance == 0) least = std::min(least, pivot);
  }
  return least;
}

double ClosureSolver::gap_in_roundings(const Tree& tree) const {
  double most = 0;
  for (std::uint32_t i = at_.first_row(tree); i < at_.last_row(tree); ++i) {
    count(rows_[i].gap, rows_[i].size, most);
  }
  return most;
}

double ClosureSolver::rate_in_roundings(const Tree& tree) const {
  double most = 0;
  for (std::uint32_t i = at_.first_row(tree); i < at_.last_row(tree); ++i) {
    count(rows_[i].rate, rows_[i].rate_size, most);
  }
  return most;
}

double ClosureSolver::gap_squared(const Tree& tree) const {
  double sum = 0;
  for (std::uint32_t i = at_.first_row(tree); i < at_.last_row(tree); ++i) {
    sum += rows_[i].gap * rows_[i].gap;
  }
  return sum;
}

std::span<const ClosureRow> ClosureSolver::rows(std::uint32_t closure) const {
  return std::span{rows_}.subspan(at_.places[closure].row,
                                  at_.places[closure + 1].row - at_.places[closure].row);
}

ClosureWrench ClosureSolver::wrench(std::uint32_t closure) const {
  ClosureWrench sum;
  for (std::uint32_t i = at_.places[closure].row; i < at_.places[closure + 1].row; ++i) {
    sum.force += multiplier_[i] * rows_[i].wrench.force;
    sum.torque += multiplier_[i] * rows_[i].wrench.torque;
  }
  return sum;
}

}  // namespace pantin

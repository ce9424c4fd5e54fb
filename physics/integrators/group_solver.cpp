#include <pantin/physics/integrators/group_solver.hpp>

#include <algorithm>
#include <cmath>

#include <pantin/physics/integrators/step_arrays.hpp>

namespace pantin {
namespace {

constexpr double kKeepsDiagonal = 0.1;  // of the greatest entry below

}  // namespace

template <class Visit>
void GroupSolver::for_each_part(const Jacobian& J, const Visit& visit) {
  std::size_t entries = 0, first = 0;
  for (std::size_t g = 0; g < J.groups.size(); ++g) {
    const std::span<const std::uint32_t> numbers = J.groups.group(g);
    const std::size_t k = numbers.size();
    visit(Part{k, std::span{matrices_}.subspan(entries, k * k), std::span{rows_}.subspan(first, k),
               std::span{pivots_}.subspan(first, k)},
          numbers);
    entries += k * k, first += k;
  }
}

void GroupSolver::factor(const Jacobian& J, double s, std::span<const double> scale) {
  inverse_scale_.resize(scale.size());
  for (std::size_t i = 0; i < scale.size(); ++i) inverse_scale_[i] = 1 / scale[i];
  matrices_.resize(J.entries().size());
  rows_.resize(J.groups.numbers());
  pivots_.resize(J.groups.numbers());
  x_.resize(J.groups.largest());
  std::size_t g = 0;
  for_each_part(J, [&](const Part& part, std::span<const std::uint32_t> numbers) {
    const std::span<const double> block = J.block(g++);
    for (std::size_t j = 0; j < part.k; ++j) {
      double* column = part.matrix.data() + j * part.k;
      const double by = -s * (scale.empty() ? 1 : scale[numbers[j]]);
      for (std::size_t i = 0; i < part.k; ++i) column[i] = by * block[j * part.k + i];
      for (std::size_t i = 0; !scale.empty() && i < part.k; ++i) column[i] *= inverse_scale_[numbers[i]];
      column[j] += 1;
    }
    scale_rows(part);
    decompose(part);
  });
}

void GroupSolver::scale_rows(const Part& part) {
  const auto [k, matrix, row, pivot] = part;
  std::fill(row.begin(), row.end(), 0.0);
  for (std::size_t j = 0; j < k; ++j) {
    for (std::size_t i = 0; i < k; ++i) row[i] = std::max(row[i], std::abs(matrix[j * k + i]));
  }
  for (double& x : row) x = 1 / x;
  for (std::size_t j = 0; j < k; ++j) {
    for (std::size_t i = 0; i < k; ++i) matrix[j * k + i] *= row[i];
  }
}

void GroupSolver::decompose(const Part& part) {
  const auto [k, matrix, row, pivot] = part;
  for (std::size_t c = 0; c < k; ++c) {
    double* column = matrix.data() + c * k;
    std::size_t greatest = c;
    for (std::size_t i = c + 1; i < k; ++i) {
      if (std::abs(column[i]) > std::abs(column[greatest])) greatest = i;
    }
    if (std::abs(column[c]) >= kKeepsDiagonal * std::abs(column[greatest])) greatest = c;
    pivot[c] = static_cast<std::uint32_t>(greatest);
    for (std::size_t j = 0; greatest != c && j < k; ++j)
      std::swap(matrix[j * k + c], matrix[j * k + greatest]);
    column[c] = 1 / column[c];
    const std::span<double> below{column + c + 1, k - c - 1};
    for (double& x : below) x *= column[c];
    for (std::size_t j = c + 1; j < k; ++j) {
      double* other = matrix.data() + j * k;
      if (other[c] != 0) add_scaled({other + c + 1, below.size()}, -other[c], below);
    }
  }
}

void GroupSolver::substitute(const Part& part, std::span<double> x) {
  const auto [k, matrix, row, pivot] = part;
  for (std::size_t c = 0; c < k; ++c) {
    if (pivot[c] != c) std::swap(x[c], x[pivot[c]]);
  }
  for (std::size_t c = 0; c < k; ++c) {
    if (x[c] != 0) add_scaled(x.subspan(c + 1), -x[c], matrix.subspan(c * k + c + 1, k - c - 1));
  }
  for (std::size_t c = k; c-- > 0;) {
    x[c] *= matrix[c * k + c];
    if (x[c] != 0) add_scaled(x.first(c), -x[c], matrix.subspan(c * k, c));
  }
}

void GroupSolver::solve(const Jacobian& J, std::span<double> x) {
  for_each_part(J, [&](const Part& part, std::span<const std::uint32_t> numbers) {
    const std::span<double> own = std::span{x_}.first(part.k);
    for (std::size_t i = 0; i < part.k; ++i) own[i] = x[numbers[i]] * part.row[i];
    substitute(part, own);
    for (std::size_t i = 0; i < part.k; ++i) x[numbers[i]] = own[i];
  });
}

}  // namespace pantin

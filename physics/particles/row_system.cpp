// Conjugate gradients after Y. Saad, Iterative Methods for Sparse Linear Systems, 2nd ed., algorithm 9.1,
// with the incomplete Cholesky factor L L^T of zero fill (section 10.3.2). A pivot that comes out too small
// is replaced by the diagonal, so that the factor exists for every positive A.
#include <pantin/physics/particles/row_system.hpp>

#include <algorithm>
#include <cmath>

namespace pantin {
namespace {

constexpr double kLeastPivot = 1e-6;  // of the diagonal

double shared(const TieRow& a, const TieRow& b, std::span<const double> inverse_mass) {
  if (a.axis >= 0 && b.axis >= 0 && a.axis != b.axis) return 0;  // their gradients are at right angles
  double sum = 0;
  for (int i = 0; i < a.particles; ++i) {
    for (int j = 0; j < b.particles; ++j) {
      if (a.particle[i] == b.particle[j]) sum += a.c[i] * b.c[j] * inverse_mass[a.particle[i]];
    }
  }
  return sum;
}

double dot(std::span<const double> a, std::span<const double> b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum;
}

}  // namespace

void RowSystem::build(std::span<const TieRow> rows, std::span<const double> inverse_mass) {
  std::vector<std::vector<std::uint32_t>> rows_of(inverse_mass.size());
  begin_.assign(1, 0);
  column_.clear();
  share_.clear();
  std::vector<std::uint32_t> near;
  for (std::uint32_t i = 0; i < rows.size(); ++i) {
    near.clear();
    for (int k = 0; k < rows[i].particles; ++k) {
      std::vector<std::uint32_t>& of = rows_of[rows[i].particle[k]];
      near.insert(near.end(), of.begin(), of.end());
      of.push_back(i);
    }
    std::sort(near.begin(), near.end());
    near.erase(std::unique(near.begin(), near.end()), near.end());
    near.push_back(i);
    for (const std::uint32_t j : near) {
      const double share = shared(rows[i], rows[j], inverse_mass);
      if (share == 0 && j != i) continue;
      column_.push_back(j);
      share_.push_back(share);
    }
    begin_.push_back(static_cast<std::uint32_t>(column_.size()));
  }
  value_.resize(share_.size());
  factor_.resize(share_.size());
  for (std::vector<double>* v : {&r_, &z_, &p_, &Ap_}) v->resize(rows.size());
}

void RowSystem::assemble(std::span<const TieRow> rows, double factor, std::span<const double> diagonal) {
  for (std::size_t i = 0; i < rows.size(); ++i) {
    for (std::uint32_t k = begin_[i]; k < begin_[i + 1]; ++k) {
      value_[k] = factor * share_[k] * rows[i].g.dot(rows[column_[k]].g);
    }
    double& own = value_[begin_[i + 1] - 1];
    own += diagonal[i];
    if (!(own > 0)) own = 1;  // nothing of this row can move: it stays as it is
  }
  factorise();
}

void RowSystem::factorise() {
  for (std::size_t i = 0; i + 1 < begin_.size(); ++i) {
    const std::uint32_t last = begin_[i + 1] - 1;
    double pivot = value_[last];
    for (std::uint32_t k = begin_[i]; k < last; ++k) {
      const std::uint32_t j = column_[k];
      double sum = value_[k];
      std::uint32_t a = begin_[i], b = begin_[j];
      const std::uint32_t last_j = begin_[j + 1] - 1;
      while (a < k && b < last_j) {
        if (column_[a] == column_[b]) {
          sum -= factor_[a++] * factor_[b++];
        } else if (column_[a] < column_[b]) {
          ++a;
        } else {
          ++b;
        }
      }
      factor_[k] = sum / factor_[last_j];
      pivot -= factor_[k] * factor_[k];
    }
    factor_[last] = std::sqrt(pivot > kLeastPivot * value_[last] ? pivot : value_[last]);
  }
}

void RowSystem::multiply(std::span<const double> x, std::span<double> y) const {
  std::fill(y.begin(), y.end(), 0.0);
  for (std::size_t i = 0; i + 1 < begin_.size(); ++i) {
    const std::uint32_t last = begin_[i + 1] - 1;
    double sum = value_[last] * x[i];
    for (std::uint32_t k = begin_[i]; k < last; ++k) {
      sum += value_[k] * x[column_[k]];
      y[column_[k]] += value_[k] * x[i];
    }
    y[i] += sum;
  }
}

void RowSystem::precondition(std::span<const double> r, std::span<double> z) const {
  const std::size_t n = begin_.size() - 1;
  for (std::size_t i = 0; i < n; ++i) {
    const std::uint32_t last = begin_[i + 1] - 1;
    double sum = r[i];
    for (std::uint32_t k = begin_[i]; k < last; ++k) sum -= factor_[k] * z[column_[k]];
    z[i] = sum / factor_[last];
  }
  for (std::size_t i = n; i-- > 0;) {
    const std::uint32_t last = begin_[i + 1] - 1;
    z[i] /= factor_[last];
    for (std::uint32_t k = begin_[i]; k < last; ++k) z[column_[k]] -= factor_[k] * z[i];
  }
}

int RowSystem::solve(std::span<const double> b, std::span<double> x, double tolerance, int most) {
  std::fill(x.begin(), x.end(), 0.0);
  std::copy(b.begin(), b.end(), r_.begin());
  const double enough = tolerance * tolerance * dot(b, b);
  precondition(r_, z_);
  std::copy(z_.begin(), z_.end(), p_.begin());
  double rz = dot(r_, z_);
  int k = 0;
  while (k < most && dot(r_, r_) > enough) {
    ++k;
    multiply(p_, Ap_);
    const double curve = dot(p_, Ap_);
    if (!(curve > 0)) break;
    const double step = rz / curve;
    for (std::size_t i = 0; i < x.size(); ++i) {
      x[i] += step * p_[i];
      r_[i] -= step * Ap_[i];
    }
    precondition(r_, z_);
    const double rz_next = dot(r_, z_), turn = rz_next / rz;
    rz = rz_next;
    for (std::size_t i = 0; i < x.size(); ++i) p_[i] = z_[i] + turn * p_[i];
  }
  return k;
}

}  // namespace pantin

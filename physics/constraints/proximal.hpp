#pragma once
// The proximal solve of closure_solver.hpp on any scalar T, a double or a register of several. W and its
// factor are stored within their envelope: of row i what stands from column left(i) to the diagonal. Holds
// nothing that is not a template on the scalar, so that the sources of the lane kernels do not share code.
//
//   K = W + mu 1,  x = K^-1 b,  then four times x += K^-1 (b - W x)
#include <cstddef>
#include <cstdint>

namespace pantin {

/// mu for scaled rows. Directions in which a loop is nearer to singular than some 1e-5 rad are let go, which
/// keeps rounding from being multiplied without end; inertia carries the mechanism through. Ten times more
/// costs short steps accuracy there (1e-7 m where bars of a chain of four-bars are in line), ten times less
/// costs long steps theirs (1e-4 m).
constexpr double kProximal = 1e-10;
/// Pivots below are those of rows that others make redundant.
constexpr double kRedundant = 100 * kProximal;
constexpr int kRefinements = 4;

/// Where the rows of one tree's closures stand in W.
struct Envelope {
  const std::uint32_t* left{nullptr};  ///< by row
  const std::size_t* begins{nullptr};  ///< by row: where W(row, left) stands, counted from any number
  std::uint32_t rows{0};
};

/// Solves W x = b, W in an envelope, for rows that are scaled.
template <class T>
struct Proximal {
  Envelope envelope{};
  T *W{nullptr}, *K{nullptr};  ///< W; room for the factor L d L^T of W + mu 1, with 1 / d in the diagonal

  T* row(T* of, std::uint32_t i) const { return of + (envelope.begins[i] - envelope.begins[0]); }
  std::uint32_t left(std::uint32_t i) const { return envelope.left[i] - envelope.left[0]; }

  T& diagonal(T* of, std::uint32_t i) const { return row(of, i)[i - left(i)]; }

  /// W <- s W s, then K = W + mu 1; mu by row.
  void factor(const T* scale, const T* mu) const {
    for (std::uint32_t i = 0; i < envelope.rows; ++i) {
      T *w = row(W, i), *k = row(K, i);
      for (std::uint32_t j = left(i), at = 0; j <= i; ++j, ++at) w[at] = k[at] = scale[i] * scale[j] * w[at];
      diagonal(K, i) += mu[i];
    }
    for (std::uint32_t i = 0; i < envelope.rows; ++i) factor_row(i);
  }

  /// x = K^-1 b, then x += K^-1 (b - W x). `residual` is room.
  void solve(const T* b, T* x, T* residual) const {
    for (std::uint32_t i = 0; i < envelope.rows; ++i) x[i] = b[i];
    substitute(x);
    for (int pass = 0; pass < kRefinements; ++pass) {
      multiply(x, residual);
      for (std::uint32_t i = 0; i < envelope.rows; ++i) residual[i] = b[i] - residual[i];
      substitute(residual);
      for (std::uint32_t i = 0; i < envelope.rows; ++i) x[i] += residual[i];
    }
  }

 private:
  void factor_row(std::uint32_t i) const {
    T* k = row(K, i);
    const std::uint32_t li = left(i);
    for (std::uint32_t j = li; j < i; ++j) {
      const T* other = row(K, j);
      const std::uint32_t lj = left(j);
      T sum = k[j - li];
      // k holds L d so far.
      for (std::uint32_t m = li > lj ? li : lj; m < j; ++m) sum -= k[m - li] * other[m - lj];
      k[j - li] = sum;
    }
    T d = k[i - li];
    for (std::uint32_t j = li; j < i; ++j) {
      const T l_d = k[j - li], l = l_d * diagonal(K, j);
      d -= l_d * l;
      k[j - li] = l;
    }
    k[i - li] = T(1) / d;
  }

  void substitute(T* x) const {
    for (std::uint32_t i = 0; i < envelope.rows; ++i) {
      const T* k = row(K, i);
      for (std::uint32_t j = left(i), at = 0; j < i; ++j, ++at) x[i] -= k[at] * x[j];
    }
    for (std::uint32_t i = 0; i < envelope.rows; ++i) x[i] = x[i] * diagonal(K, i);
    for (std::uint32_t i = envelope.rows; i-- > 0;) {
      const T* k = row(K, i);
      for (std::uint32_t j = left(i), at = 0; j < i; ++j, ++at) x[j] -= k[at] * x[i];
    }
  }

  void multiply(const T* x, T* out) const {
    for (std::uint32_t i = 0; i < envelope.rows; ++i) {
      const T* w = row(W, i);
      T sum = diagonal(W, i) * x[i];
      for (std::uint32_t j = left(i), at = 0; j < i; ++j, ++at) {
        sum += w[at] * x[j];
        out[j] += w[at] * x[i];
      }
      out[i] = sum;
    }
  }
};

}  // namespace pantin

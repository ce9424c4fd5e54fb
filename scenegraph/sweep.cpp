// c = a * b for affine 3x4 matrices, row by row: c_i = (a_i0 b_0 + a_i1 b_1) + a_i2 b_2 + (0, 0, 0, a_i3),
// where b_k are the rows of b. Both versions do the same operations in the same order, so they give the same
// bits (nothing is contracted: -ffp-contract=off). Written by hand because at -O2 the compiler does not
// vectorise the plain loop.
#include <pantin/scenegraph/sweep.hpp>

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

namespace pantin {
namespace {

#if defined(__SSE2__)

inline void multiply_rows(const double* a, const double* b, double* c) noexcept {
  const __m128d b00 = _mm_loadu_pd(b), b01 = _mm_loadu_pd(b + 2);
  const __m128d b10 = _mm_loadu_pd(b + 4), b11 = _mm_loadu_pd(b + 6);
  const __m128d b20 = _mm_loadu_pd(b + 8), b21 = _mm_loadu_pd(b + 10);
  for (int row = 0; row < 12; row += 4) {
    const __m128d a0 = _mm_set1_pd(a[row]), a1 = _mm_set1_pd(a[row + 1]), a2 = _mm_set1_pd(a[row + 2]);
    const __m128d a3 = _mm_set_pd(a[row + 3], 0.0);
    const __m128d left =
        _mm_add_pd(_mm_add_pd(_mm_mul_pd(a0, b00), _mm_mul_pd(a1, b10)), _mm_mul_pd(a2, b20));
    const __m128d right =
        _mm_add_pd(_mm_add_pd(_mm_mul_pd(a0, b01), _mm_mul_pd(a1, b11)), _mm_mul_pd(a2, b21));
    _mm_storeu_pd(c + row, left);
    _mm_storeu_pd(c + row + 2, _mm_add_pd(right, a3));
  }
}

#else

inline void multiply_rows(const double* a, const double* b, double* c) noexcept {
  for (int row = 0; row < 12; row += 4) {
    const double a0 = a[row], a1 = a[row + 1], a2 = a[row + 2], a3 = a[row + 3];
    c[row] = (a0 * b[0] + a1 * b[4]) + a2 * b[8];
    c[row + 1] = (a0 * b[1] + a1 * b[5]) + a2 * b[9];
    c[row + 2] = ((a0 * b[2] + a1 * b[6]) + a2 * b[10]) + 0.0;  // turns -0 into 0, as the other version does
    c[row + 3] = ((a0 * b[3] + a1 * b[7]) + a2 * b[11]) + a3;
  }
}

#endif

}  // namespace

Matrix34 multiply(const Matrix34& a, const Matrix34& b) noexcept {
  Matrix34 c;
  multiply_rows(a.m.data(), b.m.data(), c.m.data());
  return c;
}

void sweep(const Matrix34* locals, const std::uint32_t* parents, Matrix34* worlds, std::uint32_t begin,
           std::uint32_t end) noexcept {
  for (std::uint32_t i = begin; i < end; ++i)
    multiply_rows(worlds[parents[i]].m.data(), locals[i].m.data(), worlds[i].m.data());
}

}  // namespace pantin

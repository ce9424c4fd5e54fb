#pragma once
// A lane type: several doubles that are worked on at once, one for each stage of an integrator. It takes the
// place of double in the solver's templates. Arithmetic is elementwise; nothing branches on a value.
#include <cmath>
#include <cstdint>
#include <cstring>

// g++ remarks that functions of such types have another calling convention where registers are narrower; all
// of them are called from the source that compiles them.
#pragma GCC diagnostic ignored "-Wpsabi"

namespace pantin::lanes {

/// N doubles. `Set` is a tag of the instruction set that the source is compiled for: it makes types, and with
/// them all functions of them, differ, so that the linker never takes one for the other.
template <class Set, int N>
struct Lane {
  typedef double Pack __attribute__((vector_size(8 * N)));
  typedef std::int64_t Bits __attribute__((vector_size(8 * N)));
  static constexpr int kCount = N;

  Pack x{};

  Lane() = default;
  explicit Lane(double same) : x{same - Pack{}} {}
  explicit Lane(const Pack& pack) : x{pack} {}
  static Lane load(const double* from) {
    Lane lane;
    std::memcpy(&lane.x, from, sizeof(Pack));
    return lane;
  }
  void store(double* to) const { std::memcpy(to, &x, sizeof(Pack)); }

  friend Lane operator+(const Lane& a, const Lane& b) { return Lane{a.x + b.x}; }
  friend Lane operator-(const Lane& a, const Lane& b) { return Lane{a.x - b.x}; }
  friend Lane operator*(const Lane& a, const Lane& b) { return Lane{a.x * b.x}; }
  friend Lane operator/(const Lane& a, const Lane& b) { return Lane{a.x / b.x}; }
  friend Lane operator-(const Lane& a) { return Lane{-a.x}; }
  friend void operator+=(Lane& a, const Lane& b) { a.x += b.x; }
  friend void operator-=(Lane& a, const Lane& b) { a.x -= b.x; }
};

/// Where x > 0, else another.
template <class Set, int N>
inline Lane<Set, N> if_positive(const Lane<Set, N>& x, const Lane<Set, N>& then, const Lane<Set, N>& other) {
  using Pack = typename Lane<Set, N>::Pack;
  return Lane<Set, N>{Pack(x.x > 0 ? then.x : other.x)};
}

/// 1 / sqrt(x)
template <class Set, int N>
inline Lane<Set, N> inverse_root(const Lane<Set, N>& x) {
  Lane<Set, N> root;
  for (int i = 0; i < N; ++i) root.x[i] = __builtin_sqrt(x.x[i]);
  return Lane<Set, N>{1.0 / root.x};
}

/// Sine and cosine of an angle in each lane.
template <class T>
struct SineCosine {
  T sine{}, cosine{};
};

/// To about two units in the last place for |x| < 1e5; greater angles are handed to the standard
/// library, lane by lane. Reduction by multiples of pi/2 in three parts (W. J. Cody, W. Waite, Software
/// Manual for the Elementary Functions, 1980, ch. 8); then the minimax polynomials on [-pi/4, pi/4] of
/// FreeBSD's k_sin.c and k_cos.c.
template <class Set, int N>
inline SineCosine<Lane<Set, N>> sine_cosine(const Lane<Set, N>& angle) {
  using T = Lane<Set, N>;
  using Pack = typename T::Pack;
  using Bits = typename T::Bits;
  const Pack x = angle.x;
  const Pack size = x < 0 ? -x : x;
  const Bits large = !(size < 1e5);
  bool any = false;
  for (int i = 0; i < N; ++i) any = any || large[i] != 0;
  if (any) [[unlikely]] {
    SineCosine<T> slow;
    for (int i = 0; i < N; ++i) slow.sine.x[i] = std::sin(x[i]), slow.cosine.x[i] = std::cos(x[i]);
    return slow;
  }
  // Adding 1.5 * 2^52 rounds to a whole number, which then stands in the lowest bits.
  constexpr double kRound = 6755399441055744.0;
  const Pack shifted = x * 0x1.45f306dc9c883p-1 + kRound;
  const Pack turns = shifted - kRound;
  const Pack r =
      ((x - turns * 0x1.921fb54400000p0) - turns * 0x1.0b4611a600000p-34) - turns * 0x1.3198a2e037073p-69;
  Bits quadrant;  // not by std::bit_cast, a function of plain vectors, which sources would share
  std::memcpy(&quadrant, &shifted, sizeof(Bits));
  const Pack z = r * r;
  const Pack ps =
      r + r * z *
              (-1.66666666666666324348e-01 +
               z * (8.33333333332248946124e-03 +
                    z * (-1.98412698298579493134e-04 +
                         z * (2.75573137070700676789e-06 +
                              z * (-2.50507602534068634195e-08 + z * 1.58969099521155010221e-10)))));
  const Pack pc =
      1.0 -
      (0.5 * z - z * z *
                     (4.16666666666666019037e-02 +
                      z * (-1.38888888888741095749e-03 +
                           z * (2.48015872894767294178e-05 +
                                z * (-2.75573143513906633035e-07 +
                                     z * (2.08757232129817482790e-09 + z * -1.13596475577881948265e-11))))));
  const Bits swap = (quadrant & 1) != 0;
  const Pack s = swap ? pc : ps, c = swap ? ps : pc;
  const Bits minus_s = (quadrant & 2) != 0, minus_c = ((quadrant + 1) & 2) != 0;
  return {T{Pack(minus_s ? -s : s)}, T{Pack(minus_c ? -c : c)}};
}

template <class Set, int N>
inline Lane<Set, N> sin(const Lane<Set, N>& angle) {
  return sine_cosine(angle).sine;
}
template <class Set, int N>
inline Lane<Set, N> cos(const Lane<Set, N>& angle) {
  return sine_cosine(angle).cosine;
}

}  // namespace pantin::lanes

#pragma once
// Private to scenegraph. Unit quaternions (w, x, y, z) whose numbers are doubles or Jets.
//
// Power q^k, q = (c, v), c >= 0: with h = acos(c) half the angle, q^k = (cos(k h), sin(k h) v / |v|). To be
// smooth at the identity it is computed as
//   u = k g v,   g = h / sin h,   q^k = (cos sqrt(x), u sin sqrt(x) / sqrt(x)),   x = |u|^2
// with g as a function of y = 1 - c = |v|^2 / (1 + c). From (1 - c^2) dg/dc = c g - 1:
//   g = sum a_n y^n,  a_0 = 1,  a_{n+1} = a_n (n + 1) / (2 n + 3)
// and for C(x) = cos sqrt(x), D(x) = sin sqrt(x) / sqrt(x):  C' = -D / 2,  2 x D' = C - D,  2 x D'' = C' - 3
// D'.
#include <array>

#include <pantin/scenegraph/jet.hpp>

namespace pantin {

template <class S>
using Numbers3 = std::array<S, 3>;
template <class S>
using Numbers4 = std::array<S, 4>;

template <class S>
Numbers4<S> product(const Numbers4<S>& a, const Numbers4<S>& b) {
  return {a[0] * b[0] - a[1] * b[1] - a[2] * b[2] - a[3] * b[3],
          a[0] * b[1] + a[1] * b[0] + a[2] * b[3] - a[3] * b[2],
          a[0] * b[2] - a[1] * b[3] + a[2] * b[0] + a[3] * b[1],
          a[0] * b[3] + a[1] * b[2] - a[2] * b[1] + a[3] * b[0]};
}

template <class S>
Numbers4<S> conjugate(const Numbers4<S>& q) {
  return {q[0], -q[1], -q[2], -q[3]};
}

template <class S>
S dot(const Numbers4<S>& a, const Numbers4<S>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3];
}

template <class S>
Numbers3<S> cross(const Numbers3<S>& a, const Numbers3<S>& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// v turned by the unit quaternion q: v + 2 w (u x v) + 2 u x (u x v).
template <class S>
Numbers3<S> turned(const Numbers4<S>& q, const Numbers3<S>& v) {
  const Numbers3<S> u{q[1], q[2], q[3]};
  const Numbers3<S> uv = cross(u, v);
  const Numbers3<S> uuv = cross(u, uv);
  Numbers3<S> out;
  for (std::size_t i = 0; i < 3; ++i) out[i] = v[i] + S{2} * (q[0] * uv[i] + uuv[i]);
  return out;
}

template <class S>
Numbers4<S> unit(const Numbers4<S>& p) {
  const S length = square_root(dot(p, p));
  return {p[0] / length, p[1] / length, p[2] / length, p[3] / length};
}

/// h / sin h as a function of y = 1 - cos h, 0 <= h <= pi / 2.
template <class S>
S angle_over_sine(const S& y) {
  const double at = value_of(y);
  if (at < 0.3) {  // 22 terms: 0.15^22 is far below round-off
    double f = 0, f1 = 0, f2 = 0, a = 1, power = 1;
    double a_next = 1.0 / 3, a_after = a_next * 2 / 5;
    for (int n = 0; n < 22; ++n) {
      f += a * power;
      f1 += (n + 1) * a_next * power;
      f2 += (n + 1) * (n + 2) * a_after * power;
      a = a_next;
      a_next = a_after;
      a_after *= (n + 3) / (2.0 * n + 7);
      power *= at;
    }
    return composed(y, f, f1, f2);
  }
  const double c = 1 - at, s2 = at * (2 - at);
  const double f = std::acos(c) / std::sqrt(s2);
  const double by_c = (c * f - 1) / s2;  // df/dc = -df/dy
  return composed(y, f, -by_c, (f + 3 * c * by_c) / s2);
}

/// cos(sqrt x) and sin(sqrt x) / sqrt x, x >= 0.
template <class S>
struct CosSinc {
  explicit CosSinc(const S& x) {
    const double at = value_of(x);
    double c, d, d1, d2;
    if (at < 0.25) {
      // D = sum (-x)^n / (2 n + 1)!; the terms left out are below 0.25^9 / 19!.
      d = d1 = d2 = 0;
      double coefficient = 1, power = 1, power1 = 0, power2 = 0;  // x^n, x^(n-1), x^(n-2)
      for (int n = 0; n < 9; ++n) {
        d += coefficient * power;
        d1 += n * coefficient * power1;
        d2 += n * (n - 1) * coefficient * power2;
        coefficient /= -(2.0 * n + 2) * (2.0 * n + 3);
        power2 = power1;
        power1 = power;
        power *= at;
      }
      c = std::cos(std::sqrt(at));
    } else {
      const double root = std::sqrt(at);
      c = std::cos(root);
      d = std::sin(root) / root;
      d1 = (c - d) / (2 * at);
      d2 = (-d / 2 - 3 * d1) / (2 * at);
    }
    cosine = composed(x, c, -d / 2, -d1 / 2);
    sinc = composed(x, d, d1, d2);
  }
  S cosine, sinc;
};

/// q^k; q must be a unit quaternion with w >= 0.
template <class S>
Numbers4<S> power(const Numbers4<S>& q, const S& k) {
  const S v2 = q[1] * q[1] + q[2] * q[2] + q[3] * q[3];
  const S scale = k * angle_over_sine<S>(v2 / (S{1} + q[0]));
  const CosSinc<S> turn{scale * scale * v2};
  const S along = turn.sinc * scale;
  return {turn.cosine, along * q[1], along * q[2], along * q[3]};
}

}  // namespace pantin

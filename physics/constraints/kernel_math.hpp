#pragma once
// Three-vectors and three-by-three matrices of any scalar T, for the solver kernels: plain data, no
// alignment, no expression templates, so that T may be a double or a register of several.
#include <cmath>

namespace pantin::kernel {

template <class T>
struct Vec3 {
  T x{}, y{}, z{};
};

template <class T>
inline Vec3<T> operator+(const Vec3<T>& a, const Vec3<T>& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
template <class T>
inline Vec3<T> operator-(const Vec3<T>& a, const Vec3<T>& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
template <class T>
inline Vec3<T> operator*(const T& s, const Vec3<T>& a) {
  return {s * a.x, s * a.y, s * a.z};
}
template <class T>
inline void operator+=(Vec3<T>& a, const Vec3<T>& b) {
  a = a + b;
}
template <class T>
inline T dot(const Vec3<T>& a, const Vec3<T>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class T>
inline Vec3<T> cross(const Vec3<T>& a, const Vec3<T>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/// Row-major 3x3.
template <class T>
struct Mat3 {
  T m[9]{};
  static Mat3 identity() { return {{T(1), T(0), T(0), T(0), T(1), T(0), T(0), T(0), T(1)}}; }
  [[nodiscard]] Vec3<T> column(int j) const { return {m[j], m[3 + j], m[6 + j]}; }
};

template <class T>
inline Vec3<T> operator*(const Mat3<T>& A, const Vec3<T>& v) {
  return {A.m[0] * v.x + A.m[1] * v.y + A.m[2] * v.z, A.m[3] * v.x + A.m[4] * v.y + A.m[5] * v.z,
          A.m[6] * v.x + A.m[7] * v.y + A.m[8] * v.z};
}
/// A^T v
template <class T>
inline Vec3<T> transposed_times(const Mat3<T>& A, const Vec3<T>& v) {
  return {A.m[0] * v.x + A.m[3] * v.y + A.m[6] * v.z, A.m[1] * v.x + A.m[4] * v.y + A.m[7] * v.z,
          A.m[2] * v.x + A.m[5] * v.y + A.m[8] * v.z};
}
template <class T>
inline Mat3<T> operator*(const Mat3<T>& A, const Mat3<T>& B) {
  Mat3<T> C;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      C.m[3 * i + j] = A.m[3 * i] * B.m[j] + A.m[3 * i + 1] * B.m[3 + j] + A.m[3 * i + 2] * B.m[6 + j];
    }
  }
  return C;
}

/// Symmetric 3x3.
template <class T>
struct Sym3 {
  T xx{}, yy{}, zz{}, xy{}, xz{}, yz{};
};
template <class T>
inline Vec3<T> operator*(const Sym3<T>& A, const Vec3<T>& v) {
  return {A.xx * v.x + A.xy * v.y + A.xz * v.z, A.xy * v.x + A.yy * v.y + A.yz * v.z,
          A.xz * v.x + A.yz * v.y + A.zz * v.z};
}
/// R A R^T
template <class T>
inline Sym3<T> rotated(const Mat3<T>& R, const Sym3<T>& A) {
  const Vec3<T> a = A * Vec3<T>{R.m[0], R.m[1], R.m[2]};  // A times the rows of R
  const Vec3<T> b = A * Vec3<T>{R.m[3], R.m[4], R.m[5]};
  const Vec3<T> c = A * Vec3<T>{R.m[6], R.m[7], R.m[8]};
  const auto row = [&R](int i, const Vec3<T>& v) {
    return R.m[3 * i] * v.x + R.m[3 * i + 1] * v.y + R.m[3 * i + 2] * v.z;
  };
  return {row(0, a), row(1, b), row(2, c), row(0, b), row(0, c), row(1, c)};
}

/// Rotation by an angle [rad] about z.
template <class T>
inline Mat3<T> rotation_about_z(const T& angle) {
  using std::cos;
  using std::sin;
  const T c = cos(angle), s = sin(angle);
  return {{c, -s, T(0), s, c, T(0), T(0), T(0), T(1)}};
}

/// Rotation matrix of a quaternion (w, x, y, z) of any length but zero.
template <class T>
inline Mat3<T> rotation_of(const T* q) {
  const T s = T(2) / (q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
  const T wx = s * q[0] * q[1], wy = s * q[0] * q[2], wz = s * q[0] * q[3];
  const T xx = s * q[1] * q[1], xy = s * q[1] * q[2], xz = s * q[1] * q[3];
  const T yy = s * q[2] * q[2], yz = s * q[2] * q[3], zz = s * q[3] * q[3];
  return {{T(1) - (yy + zz), xy - wz, xz + wy, xy + wz, T(1) - (xx + zz), yz - wx, xz - wy, yz + wx,
           T(1) - (xx + yy)}};
}

/// q' = q * (0, w) / 2 for the angular velocity w in the axes of the moving frame.
template <class T>
inline void quaternion_rate_body(const T* q, const T* w, T* q_dot) {
  const T h = T(0.5);
  q_dot[0] = -h * (q[1] * w[0] + q[2] * w[1] + q[3] * w[2]);
  q_dot[1] = h * (q[0] * w[0] + q[2] * w[2] - q[3] * w[1]);
  q_dot[2] = h * (q[0] * w[1] + q[3] * w[0] - q[1] * w[2]);
  q_dot[3] = h * (q[0] * w[2] + q[1] * w[1] - q[2] * w[0]);
}

/// q' = (0, w) * q / 2 for the angular velocity w in the axes of the fixed frame.
template <class T>
inline void quaternion_rate_world(const T* q, const Vec3<T>& w, T* q_dot) {
  const T h = T(0.5);
  q_dot[0] = -h * (q[1] * w.x + q[2] * w.y + q[3] * w.z);
  q_dot[1] = h * (q[0] * w.x + q[3] * w.y - q[2] * w.z);
  q_dot[2] = h * (q[0] * w.y + q[1] * w.z - q[3] * w.x);
  q_dot[3] = h * (q[0] * w.z + q[2] * w.x - q[1] * w.y);
}

/// Scales (w, x, y, z) to unit length.
inline void normalise_quaternion(double* q) {
  const double n = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
  for (int i = 0; i < 4; ++i) q[i] /= n;
}

}  // namespace pantin::kernel

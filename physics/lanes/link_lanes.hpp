#pragma once
// What the lane kernel keeps of a link, and the steps of the elimination that know no joint.
#include <pantin/physics/constraints/kernel_math.hpp>
#include <pantin/physics/lanes/lane.hpp>
#include <pantin/physics/lanes/tree_lanes.hpp>

namespace pantin::lanes {

using kernel::cross;
using kernel::dot;
using kernel::Mat3;
using kernel::Sym3;
using kernel::Vec3;

/// Six by six, symmetric: [A B; B^T M].
template <class T>
struct SpatialInertia {
  Sym3<T> A, M;
  Mat3<T> B;
};

/// What a link keeps from one pass to the next. What the outward pass needs of the parent and what the inward
/// pass gathers from the children never live at once.
template <class T>
struct LinkLanes {
  Mat3<T> R;
  Vec3<T> r, w;
  Sym3<T> A;         ///< own inertia about the link's origin, in axes of the world
  Vec3<T> h;         ///< own first moment, the same way
  Vec3<T> p_a, p_l;  ///< bias wrench about the link's origin
  union {
    struct {
      Vec3<T> al, a;
    } motion;  ///< outward
    struct {
      SpatialInertia<T> inertia;
      Vec3<T> p_a, p_l;
    } children;  ///< inward: of all children, about this link's origin
    struct {
      Vec3<T> al, a;
    } added;  ///< outward again: acceleration added by v'
  };
};

/// What a rate keeps from the inward to the last pass.
template <class T>
struct RateLanes {
  Vec3<T> S_a, S_l, U_a, U_l;
  T u;
  T D[6];  ///< row of the factor: L, then the inverse of d

  /// What is kept of a single rate that is zero, and whose derivative is.
  void lock() {
    U_a = U_l = {};
    u = T(0), D[0] = T(1);
  }
};

template <class T>
inline Vec3<T> spread(const double* v) {
  return {T(v[0]), T(v[1]), T(v[2])};
}
template <class T>
inline Mat3<T> spread_matrix(const double* m) {
  Mat3<T> out;
  for (int i = 0; i < 9; ++i) out.m[i] = T(m[i]);
  return out;
}
template <class T>
inline Vec3<T> load3(const double* from) {
  return {T::load(from), T::load(from + T::kCount), T::load(from + 2 * T::kCount)};
}
template <class T>
inline Mat3<T> load9(const double* from) {
  Mat3<T> out;
  for (int i = 0; i < 9; ++i) out.m[i] = T::load(from + i * T::kCount);
  return out;
}
template <class T>
inline void operator-=(Vec3<T>& a, const Vec3<T>& b) {
  a.x -= b.x, a.y -= b.y, a.z -= b.z;
}

/// Of a link without its children, about its origin, in axes of the world.
template <class T>
inline Sym3<T> rotational_inertia(const LinkConstants& c, const Mat3<T>& R) {
  const double* I = c.inertia;
  return rotated(R, Sym3<T>{T(I[0]), T(I[1]), T(I[2]), T(I[3]), T(I[4]), T(I[5])});
}

template <class T>
inline Sym3<T> sum(const Sym3<T>& a, const Sym3<T>& b) {
  return {a.xx + b.xx, a.yy + b.yy, a.zz + b.zz, a.xy + b.xy, a.xz + b.xz, a.yz + b.yz};
}
template <class T>
inline Mat3<T> sum(const Mat3<T>& a, const Mat3<T>& b) {
  return {{a.m[0] + b.m[0], a.m[1] + b.m[1], a.m[2] + b.m[2], a.m[3] + b.m[3], a.m[4] + b.m[4],
           a.m[5] + b.m[5], a.m[6] + b.m[6], a.m[7] + b.m[7], a.m[8] + b.m[8]}};
}

/// Of a link without its children, where it is placed.
template <class T>
inline SpatialInertia<T> own_inertia(const LinkConstants& c, const LinkLanes<T>& l) {
  const T mass = T(c.mass), zero = T(0);
  return {l.A,
          {mass, mass, mass, zero, zero, zero},
          {{zero, -l.h.z, l.h.y, l.h.z, zero, -l.h.x, -l.h.y, l.h.x, zero}}};
}
template <class T>
inline SpatialInertia<T> sum(const SpatialInertia<T>& a, const SpatialInertia<T>& b) {
  return {sum(a.A, b.A), sum(a.M, b.M), sum(a.B, b.B)};
}

/// I - U U^T / d and p + U u / d, with a = U_a / d and b = U_l / d.
template <class T>
inline void take_out(SpatialInertia<T>& I, Vec3<T>& p_a, Vec3<T>& p_l, const Vec3<T>& x, const Vec3<T>& y,
                     const Vec3<T>& a, const Vec3<T>& b, const T& u) {
  I.A.xx -= x.x * a.x, I.A.yy -= x.y * a.y, I.A.zz -= x.z * a.z;
  I.A.xy -= x.x * a.y, I.A.xz -= x.x * a.z, I.A.yz -= x.y * a.z;
  I.M.xx -= y.x * b.x, I.M.yy -= y.y * b.y, I.M.zz -= y.z * b.z;
  I.M.xy -= y.x * b.y, I.M.xz -= y.x * b.z, I.M.yz -= y.y * b.z;
  T* B = I.B.m;
  B[0] -= x.x * b.x, B[1] -= x.x * b.y, B[2] -= x.x * b.z;
  B[3] -= x.y * b.x, B[4] -= x.y * b.y, B[5] -= x.y * b.z;
  B[6] -= x.z * b.x, B[7] -= x.z * b.y, B[8] -= x.z * b.z;
  p_a += u * a;
  p_l += u * b;
}

/// What a link is to its parent, about the parent's origin.
template <class T>
inline void shift(const LinkConstants& c, const Vec3<T>& r, const SpatialInertia<T>& I, const Vec3<T>& p_a,
                  const Vec3<T>& p_l, LinkLanes<T>& up) {
  const Sym3<T>& M = I.M;
  const T* B = I.B.m;
  // B' = B + [r] M, column by column of M.
  const Vec3<T> m0 = cross(r, Vec3<T>{M.xx, M.xy, M.xz}), m1 = cross(r, Vec3<T>{M.xy, M.yy, M.yz}),
                m2 = cross(r, Vec3<T>{M.xz, M.yz, M.zz});
  const Mat3<T> C{{B[0] + m0.x, B[1] + m1.x, B[2] + m2.x, B[3] + m0.y, B[4] + m1.y, B[5] + m2.y, B[6] + m0.z,
                   B[7] + m1.z, B[8] + m2.z}};
  // -B [r]: row i is r x (row i of B); [r] B'^T: column j is r x (row j of B').
  const Vec3<T> b0 = cross(r, Vec3<T>{B[0], B[1], B[2]}), b1 = cross(r, Vec3<T>{B[3], B[4], B[5]}),
                b2 = cross(r, Vec3<T>{B[6], B[7], B[8]});
  const Vec3<T> c0 = cross(r, Vec3<T>{C.m[0], C.m[1], C.m[2]}),
                c1 = cross(r, Vec3<T>{C.m[3], C.m[4], C.m[5]}),
                c2 = cross(r, Vec3<T>{C.m[6], C.m[7], C.m[8]});
  const Sym3<T> A{I.A.xx + b0.x + c0.x, I.A.yy + b1.y + c1.y, I.A.zz + b2.z + c2.z,
                  I.A.xy + b0.y + c1.x, I.A.xz + b0.z + c2.x, I.A.yz + b1.z + c2.y};
  const Vec3<T> torque = p_a + cross(r, p_l);
  auto& sums = up.children;
  if (c.first_child) {
    sums.inertia = {A, M, C};
    sums.p_a = torque, sums.p_l = p_l;
  } else {
    sums.inertia = sum(sums.inertia, {A, M, C});
    sums.p_a += torque, sums.p_l += p_l;
  }
}

}  // namespace pantin::lanes

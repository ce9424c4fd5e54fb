#pragma once
// The elimination of articulated.hpp on any lane type. Included once by each source that compiles it for an
// instruction set; holds nothing that is not a template on the lane type, so that sources do not share code.
#include <type_traits>

#include <pantin/physics/constraints/ball.hpp>
#include <pantin/physics/constraints/cylindrical.hpp>
#include <pantin/physics/constraints/fixed.hpp>
#include <pantin/physics/constraints/free_root.hpp>
#include <pantin/physics/constraints/kernel_math.hpp>
#include <pantin/physics/constraints/pivot.hpp>
#include <pantin/physics/constraints/planar.hpp>
#include <pantin/physics/constraints/screw.hpp>
#include <pantin/physics/constraints/slider.hpp>
#include <pantin/physics/constraints/universal.hpp>
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
  Sym3<T> A{}, M{};
  Mat3<T> B{};
};

/// What a link keeps from one pass to the next. What the outward pass needs of the parent and what the inward
/// pass gathers from the children never live at once.
template <class T>
struct LinkLanes {
  Mat3<T> R;
  Vec3<T> p, r, w, v;
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

template <class T>
class TreeKernel {
 public:
  using Vec = Vec3<T>;

  static std::size_t work_size(std::size_t links, std::size_t rates) {
    return (links * sizeof(LinkLanes<T>) + rates * sizeof(RateLanes<T>)) / sizeof(double);
  }

  static void outward(const Task& task) {
    for (std::uint32_t i = task.begin; i < task.end; ++i) {
      const LinkConstants& c = task.links[i];
      with_kind(c, [&](auto model) { place<decltype(model)>(task, c, model, link(task, i)); });
    }
  }

  static void motion(const Task& task, std::uint32_t i, double* out) {
    const LinkLanes<T>& l = link(task, i);
    for (int k = 0; k < 9; ++k) l.R.m[k].store(out + k * T::kCount);
    store3(l.p, out + 9 * T::kCount);
    store3(l.v, out + 12 * T::kCount);
    store3(l.w, out + 15 * T::kCount);
  }

  static void add_wrench(const Task& task, std::uint32_t i, const double* wrench) {
    LinkLanes<T>& l = link(task, i);
    const Vec f = load3<T>(wrench), t = load3<T>(wrench + 3 * T::kCount);
    l.p_l -= f;
    l.p_a -= t;
  }

  static void solve(const Task& task) {
    for (std::uint32_t i = task.end; i-- > task.begin;) {
      const LinkConstants& c = task.links[i];
      with_kind(c, [&](auto model) { eliminate<decltype(model)>(task, c, link(task, i)); });
    }
    for (std::uint32_t i = task.begin; i < task.end; ++i) {
      const LinkConstants& c = task.links[i];
      with_kind(c, [&](auto model) { substitute<decltype(model)>(task, c, link(task, i)); });
    }
  }

  static void free_rates(const FreeTask& task) {
    for (std::size_t i = 0; i < task.count; ++i) {
      const FreeConstants& c = task.bodies[i];
      const double* q = task.q + 7 * i * task.stages + task.first;
      const double* v = task.v + 6 * i * task.stages + task.first;
      double* out = task.q_dot + 7 * i * task.stages + task.first;
      T attitude[4], rate[4];
      for (std::size_t k = 0; k < 4; ++k) attitude[k] = T::load(q + (3 + k) * task.stages);
      const Mat3<T> R = kernel::rotation_of(attitude);
      const Vec L{T::load(v + 3 * task.stages), T::load(v + 4 * task.stages), T::load(v + 5 * task.stages)};
      const Vec w = R * (spread_matrix<T>(c.inverse_inertia) * transposed_times(R, L));
      kernel::quaternion_rate_world(attitude, w, rate);
      for (std::size_t k = 0; k < 3; ++k)
        (T(c.inverse_mass) * T::load(v + k * task.stages)).store(out + k * task.stages);
      for (std::size_t k = 0; k < 4; ++k) rate[k].store(out + (3 + k) * task.stages);
    }
  }

 private:
  /// A joint whose motion is given: no rates.
  struct Given {
    static constexpr int kCoordinates = 0, kRates = 0;
  };

  template <class F>
  static void with_kind(const LinkConstants& c, F&& f) {
    if (c.given >= 0) return f(Given{});
    switch (c.kind) {
      case JointKind::Pivot:
        return f(PivotModel{});
      case JointKind::Slider:
        return f(SliderModel{});
      case JointKind::Ball:
        return f(BallModel{});
      case JointKind::Fixed:
        return f(FixedModel{});
      case JointKind::Cylindrical:
        return f(CylindricalModel{});
      case JointKind::Universal:
        return f(UniversalModel{});
      case JointKind::Planar:
        return f(PlanarModel{});
      case JointKind::Screw:
        return f(ScrewModel{c.pitch});
      case JointKind::Free:
        return f(FreeModel{});
      case JointKind::Driven:
        return;  // always given
    }
  }

  static LinkLanes<T>& link(const Task& task, std::uint32_t i) {
    return reinterpret_cast<LinkLanes<T>*>(task.work)[i - task.begin];
  }
  static RateLanes<T>* rates(const Task& task, const LinkConstants& c) {
    double* after = task.work + (task.end - task.begin) * sizeof(LinkLanes<T>) / sizeof(double);
    return reinterpret_cast<RateLanes<T>*>(after) + (c.v - task.links[task.begin].v);
  }
  static T number(const Task& task, const double* of, std::uint32_t i) {
    return T::load(of + i * task.stages + task.first);
  }
  static void store3(const Vec& v, double* to) {
    v.x.store(to), v.y.store(to + T::kCount), v.z.store(to + 2 * T::kCount);
  }

  /// What a joint moves its B by, against A, in axes of the world but for the turn itself.
  struct Relative {
    Mat3<T> R = Mat3<T>::identity();
    Vec p{}, w{}, v{}, al{}, a{};
  };

  template <class Model>
  static void place(const Task& task, const LinkConstants& c, const Model& model, LinkLanes<T>& out) {
    Mat3<T> R_p = Mat3<T>::identity();
    Vec p_p{}, w_p{}, v_p{}, al_p{}, a_p{};
    if (c.parent >= 0) {
      const LinkLanes<T>& up = link(task, static_cast<std::uint32_t>(c.parent));
      R_p = up.R, p_p = up.p, w_p = up.w, v_p = up.v, al_p = up.motion.al, a_p = up.motion.a;
    } else {
      if (c.ground >= 0) {
        const double* m = task.motions + static_cast<std::size_t>(c.ground) * kMotionNumbers * T::kCount;
        R_p = load9<T>(m), p_p = load3<T>(m + 9 * T::kCount), w_p = load3<T>(m + 12 * T::kCount);
        v_p = load3<T>(m + 15 * T::kCount), al_p = load3<T>(m + 18 * T::kCount);
        a_p = load3<T>(m + 21 * T::kCount);
      }
      // Gravity is an acceleration of the ground the other way.
      a_p -= spread<T>(task.gravity);
    }
    const Mat3<T> R_J = R_p * spread_matrix<T>(c.R_PJ);
    Vec r = R_p * spread<T>(c.p_PJ);
    Vec w_rel{}, v_rel{}, al_rel{}, a_rel{};
    if constexpr (std::is_same_v<Model, PivotModel>) {
      const SineCosine<T> turn = sine_cosine(number(task, task.q, c.q));
      const T &s = turn.sine, &k = turn.cosine;
      for (int row = 0; row < 9; row += 3) {
        out.R.m[row] = k * R_J.m[row] + s * R_J.m[row + 1];
        out.R.m[row + 1] = k * R_J.m[row + 1] - s * R_J.m[row];
        out.R.m[row + 2] = R_J.m[row + 2];
      }
      w_rel = number(task, task.v, c.v) * R_J.column(2);
    } else if constexpr (std::is_same_v<Model, Given>) {
      const double* m = task.motions + static_cast<std::size_t>(c.given) * kMotionNumbers * T::kCount;
      out.R = R_J * load9<T>(m);
      r += R_J * load3<T>(m + 9 * T::kCount);
      w_rel = R_J * load3<T>(m + 12 * T::kCount), v_rel = R_J * load3<T>(m + 15 * T::kCount);
      al_rel = R_J * load3<T>(m + 18 * T::kCount), a_rel = R_J * load3<T>(m + 21 * T::kCount);
    } else {
      T q[Model::kCoordinates + 1], rate[Model::kRates + 1];
      for (std::uint32_t k = 0; k < Model::kCoordinates; ++k) q[k] = number(task, task.q, c.q + k);
      for (std::uint32_t k = 0; k < Model::kRates; ++k) rate[k] = number(task, task.v, c.v + k);
      Mat3<T> R_rel;
      Vec p_rel, S_a[Model::kRates + 1], S_l[Model::kRates + 1];
      model.place(q, R_rel, p_rel);
      model.columns(R_rel, S_a, S_l);
      RateLanes<T>* kept = rates(task, c);
      for (int j = 0; j < Model::kRates; ++j) {
        kept[j].S_a = R_J * S_a[j], kept[j].S_l = R_J * S_l[j];
        w_rel += rate[j] * kept[j].S_a;
        v_rel += rate[j] * kept[j].S_l;
      }
      if constexpr (requires { model.bias(R_rel, rate, al_rel, a_rel); }) {
        model.bias(R_rel, rate, al_rel, a_rel);
        al_rel = R_J * al_rel, a_rel = R_J * a_rel;
      }
      out.R = R_J * R_rel;
      r += R_J * p_rel;
    }
    const Vec w_p_x_r = cross(w_p, r);
    const Vec w = w_p + w_rel;
    const Vec al = al_p + cross(w_p, w_rel) + al_rel;
    const Vec a = a_p + cross(al_p, r) + cross(w_p, w_p_x_r + v_rel + v_rel) + a_rel;
    out.r = r, out.p = p_p + r, out.w = w, out.v = v_p + w_p_x_r + v_rel;
    out.motion.al = al, out.motion.a = a;
    const Vec h = out.R * spread<T>(c.moment);
    const Sym3<T> A = own_inertia(c, out.R);
    out.p_a = A * al + cross(w, A * w) + cross(h, a);
    out.p_l = T(c.mass) * a + cross(al, h) + cross(w, cross(w, h));
  }

  static Sym3<T> own_inertia(const LinkConstants& c, const Mat3<T>& R) {
    const double* I = c.inertia;
    return rotated(R, Sym3<T>{T(I[0]), T(I[1]), T(I[2]), T(I[3]), T(I[4]), T(I[5])});
  }

  template <class Model>
  static void eliminate(const Task& task, const LinkConstants& c, LinkLanes<T>& l) {
    SpatialInertia<T> I;
    Vec p_a = l.p_a, p_l = l.p_l;
    const Vec h = l.R * spread<T>(c.moment);
    const T mass = T(c.mass), zero = T(0);
    I.A = own_inertia(c, l.R);
    I.B = {{zero, -h.z, h.y, h.z, zero, -h.x, -h.y, h.x, zero}};
    I.M = {mass, mass, mass, zero, zero, zero};
    if (!c.leaf) {
      const auto& children = l.children;
      I.A = sum(I.A, children.inertia.A), I.M = sum(I.M, children.inertia.M);
      for (int k = 0; k < 9; ++k) I.B.m[k] += children.inertia.B.m[k];
      p_a += children.p_a, p_l += children.p_l;
    }
    if constexpr (std::is_same_v<Model, PivotModel>) eliminate_pivot(task, c, l, I, p_a, p_l);
    else if constexpr (Model::kRates > 0) eliminate_rates<Model::kRates>(task, c, I, p_a, p_l);
    if (c.parent >= 0) shift(c, l.r, I, p_a, p_l, link(task, static_cast<std::uint32_t>(c.parent)));
  }

  static Sym3<T> sum(const Sym3<T>& a, const Sym3<T>& b) {
    return {a.xx + b.xx, a.yy + b.yy, a.zz + b.zz, a.xy + b.xy, a.xz + b.xz, a.yz + b.yz};
  }

  /// I - U U^T / d and p + U u / d, with a = U_a / d and b = U_l / d.
  static void take_out(SpatialInertia<T>& I, Vec& p_a, Vec& p_l, const Vec& x, const Vec& y, const Vec& a,
                       const Vec& b, const T& u) {
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

  static void eliminate_pivot(const Task& task, const LinkConstants& c, const LinkLanes<T>& l,
                              SpatialInertia<T>& I, Vec& p_a, Vec& p_l) {
    const Vec n = l.R.column(2);
    const Vec x = I.A * n, y = transposed_times(I.B, n);
    T u = -dot(n, p_a);
    if (c.damping[0] != 0) u -= T(c.damping[0]) * number(task, task.v, c.v);
    const T inverse = T(1) / dot(n, x);
    RateLanes<T>& kept = *rates(task, c);
    kept.U_a = x, kept.U_l = y, kept.u = u, kept.D[0] = inverse;
    take_out(I, p_a, p_l, x, y, inverse * x, inverse * y, u);
  }

  template <int N>
  static void eliminate_rates(const Task& task, const LinkConstants& c, SpatialInertia<T>& I, Vec& p_a,
                              Vec& p_l) {
    RateLanes<T>* k = rates(task, c);
    for (int j = 0; j < N; ++j) {
      k[j].U_a = I.A * k[j].S_a + I.B * k[j].S_l;
      k[j].U_l = transposed_times(I.B, k[j].S_a) + I.M * k[j].S_l;
      k[j].u = -dot(k[j].S_a, p_a) - dot(k[j].S_l, p_l);
      if (c.damping[j] != 0)
        k[j].u -= T(c.damping[j]) * number(task, task.v, c.v + static_cast<std::uint32_t>(j));
    }
    // D = S^T U = L d L^T: row j keeps L(j, 0..j-1) and 1 / d(j).
    for (int j = 0; j < N; ++j) {
      T e[N];  // L(j, i) d(i)
      for (int i = 0; i <= j; ++i) {
        e[i] = dot(k[j].S_a, k[i].U_a) + dot(k[j].S_l, k[i].U_l);
        for (int m = 0; m < i; ++m) e[i] -= e[m] * (i < j ? k[i].D[m] : k[j].D[m]);
        k[j].D[i] = i < j ? e[i] * k[i].D[i] : T(1) / e[i];
      }
    }
    // U <- U L^-T, u <- L^-1 u: then each column is taken out by itself.
    for (int j = 0; j < N; ++j) {
      for (int i = 0; i < j; ++i) {
        k[j].U_a -= k[j].D[i] * k[i].U_a;
        k[j].U_l -= k[j].D[i] * k[i].U_l;
        k[j].u -= k[j].D[i] * k[i].u;
      }
      take_out(I, p_a, p_l, k[j].U_a, k[j].U_l, k[j].D[j] * k[j].U_a, k[j].D[j] * k[j].U_l, k[j].u);
    }
  }

  /// What a link is to its parent, about the parent's origin.
  static void shift(const LinkConstants& c, const Vec& r, const SpatialInertia<T>& I, const Vec& p_a,
                    const Vec& p_l, LinkLanes<T>& up) {
    const Sym3<T>& M = I.M;
    const T* B = I.B.m;
    // B' = B + [r] M, column by column of M.
    const Vec m0 = cross(r, Vec{M.xx, M.xy, M.xz}), m1 = cross(r, Vec{M.xy, M.yy, M.yz}),
              m2 = cross(r, Vec{M.xz, M.yz, M.zz});
    const Mat3<T> C{{B[0] + m0.x, B[1] + m1.x, B[2] + m2.x, B[3] + m0.y, B[4] + m1.y, B[5] + m2.y,
                     B[6] + m0.z, B[7] + m1.z, B[8] + m2.z}};
    // -B [r]: row i is r x (row i of B); [r] B'^T: column j is r x (row j of B').
    const Vec b0 = cross(r, Vec{B[0], B[1], B[2]}), b1 = cross(r, Vec{B[3], B[4], B[5]}),
              b2 = cross(r, Vec{B[6], B[7], B[8]});
    const Vec c0 = cross(r, Vec{C.m[0], C.m[1], C.m[2]}), c1 = cross(r, Vec{C.m[3], C.m[4], C.m[5]}),
              c2 = cross(r, Vec{C.m[6], C.m[7], C.m[8]});
    const Sym3<T> A{I.A.xx + b0.x + c0.x, I.A.yy + b1.y + c1.y, I.A.zz + b2.z + c2.z,
                    I.A.xy + b0.y + c1.x, I.A.xz + b0.z + c2.x, I.A.yz + b1.z + c2.y};
    const Vec torque = p_a + cross(r, p_l);
    auto& sums = up.children;
    if (c.first_child) {
      sums.inertia.A = A, sums.inertia.M = M, sums.inertia.B = C;
      sums.p_a = torque, sums.p_l = p_l;
    } else {
      sums.inertia.A = sum(sums.inertia.A, A), sums.inertia.M = sum(sums.inertia.M, M);
      for (int k = 0; k < 9; ++k) sums.inertia.B.m[k] += C.m[k];
      sums.p_a += torque, sums.p_l += p_l;
    }
  }

  template <class Model>
  static void substitute(const Task& task, const LinkConstants& c, LinkLanes<T>& l) {
    Vec al{}, a{};
    if (c.parent >= 0) {
      const auto& up = link(task, static_cast<std::uint32_t>(c.parent)).added;
      al = up.al;
      a = up.a + cross(up.al, l.r);
    }
    [[maybe_unused]] const RateLanes<T>* k = rates(task, c);
    if constexpr (std::is_same_v<Model, PivotModel>) {
      const T x = (k->u - dot(k->U_a, al) - dot(k->U_l, a)) * k->D[0];
      x.store(task.v_dot + c.v * task.stages + task.first);
      al += x * l.R.column(2);
    } else {
      // L^T v' = d^-1 (L^-1 (u - U^T da')), with U and u already multiplied by L^-1.
      const Vec al_p = al, a_p = a;
      T x[Model::kRates + 1];
      for (int j = Model::kRates - 1; j >= 0; --j) {
        x[j] = (k[j].u - dot(k[j].U_a, al_p) - dot(k[j].U_l, a_p)) * k[j].D[j];
        for (int i = j + 1; i < Model::kRates; ++i) x[j] -= k[i].D[j] * x[i];
        x[j].store(task.v_dot + (c.v + static_cast<std::uint32_t>(j)) * task.stages + task.first);
        al += x[j] * k[j].S_a;
        a += x[j] * k[j].S_l;
      }
    }
    l.added.al = al, l.added.a = a;
  }
};

/// The functions of TreeKernel<T> as a Kernel.
template <class T>
Kernel kernel_of(InstructionSet set) {
  using K = TreeKernel<T>;
  return {set, T::kCount, K::work_size, K::outward, K::motion, K::add_wrench, K::solve, K::free_rates};
}

}  // namespace pantin::lanes

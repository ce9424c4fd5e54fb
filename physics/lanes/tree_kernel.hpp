#pragma once
// The elimination of articulated.hpp on any lane type. Included once by each source that compiles it for an
// instruction set; holds nothing that is not a template on the lane type, so that sources do not share code.
#include <type_traits>

#include <pantin/physics/lanes/lane.hpp>
#include <pantin/physics/lanes/task_links.hpp>

namespace pantin::lanes {

template <class T>
class TreeKernel : public TaskLinks<T> {
  using Links = TaskLinks<T>;
  using Links::link, Links::rates, Links::number, Links::with_kind;
  using typename Links::Given;

 public:
  using Vec = Vec3<T>;

  static std::size_t work_size(std::size_t links, std::size_t rates) {
    return ((links + 1) * sizeof(LinkLanes<T>) + rates * sizeof(RateLanes<T>)) / sizeof(double);
  }

  static void outward(const Task& task) {
    for (std::uint32_t i = task.begin; i < task.end; ++i) {
      const LinkConstants& c = task.links[i];
      with_kind(c, [&](auto model) { place<decltype(model)>(task, c, model, link(task, i)); });
    }
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
    substitute(task);
  }

  /// v' by what eliminate has left at the joints.
  static void substitute(const Task& task) {
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
  template <class Model>
  static void place(const Task& task, const LinkConstants& c, const Model& model, LinkLanes<T>& out) {
    const LinkLanes<T>& up =
        c.parent >= 0 ? link(task, static_cast<std::uint32_t>(c.parent)) : ground(task, c);
    const Mat3<T>& R_p = up.R;
    const Vec &w_p = up.w, &al_p = up.motion.al, &a_p = up.motion.a;
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
        if (c.holds && c.locked[j]) kept[j].S_a = kept[j].S_l = {};
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
    out.r = r, out.w = w;
    out.motion.al = al, out.motion.a = a;
    const Vec h = out.R * spread<T>(c.moment);
    const Sym3<T> A = rotational_inertia<T>(c, out.R);
    out.A = A, out.h = h;
    out.p_a = A * al + cross(w, A * w) + cross(h, a);
    out.p_l = T(c.mass) * a + cross(al, h) + cross(w, cross(w, h));
  }

  /// The motion that a root hangs on. Gravity is an acceleration of the ground the other way.
  static const LinkLanes<T>& ground(const Task& task, const LinkConstants& c) {
    LinkLanes<T>& out = link(task, task.end);
    out.R = Mat3<T>::identity(), out.w = {}, out.motion.al = {}, out.motion.a = {};
    if (c.ground >= 0) {
      const double* m = task.motions + static_cast<std::size_t>(c.ground) * kMotionNumbers * T::kCount;
      out.R = load9<T>(m), out.w = load3<T>(m + 12 * T::kCount);
      out.motion.al = load3<T>(m + 18 * T::kCount), out.motion.a = load3<T>(m + 21 * T::kCount);
    }
    out.motion.a -= spread<T>(task.gravity);
    return out;
  }

  template <class Model>
  static void eliminate(const Task& task, const LinkConstants& c, LinkLanes<T>& l) {
    SpatialInertia<T> I = c.leaf ? own_inertia(c, l) : sum(own_inertia(c, l), l.children.inertia);
    Vec p_a = l.p_a, p_l = l.p_l;
    if (!c.leaf) p_a += l.children.p_a, p_l += l.children.p_l;
    if constexpr (std::is_same_v<Model, PivotModel>) eliminate_pivot(task, c, l, I, p_a, p_l);
    else if constexpr (Model::kRates > 0) eliminate_rates<Model::kRates>(task, c, I, p_a, p_l);
    if (c.parent >= 0) shift(c, l.r, I, p_a, p_l, link(task, static_cast<std::uint32_t>(c.parent)));
  }

  static void eliminate_pivot(const Task& task, const LinkConstants& c, const LinkLanes<T>& l,
                              SpatialInertia<T>& I, Vec& p_a, Vec& p_l) {
    const Vec n = l.R.column(2);
    const Vec x = I.A * n, y = transposed_times(I.B, n);
    T u = -dot(n, p_a);
    T d = dot(n, x);
    if (c.is_damped || c.is_loaded) [[unlikely]] {
      u -= T(c.damping[0]) * number(task, task.v, c.v);
      if (c.is_loaded) u += number(task, task.efforts, c.v), d += T(c.armature[0]);
    }
    RateLanes<T>& kept = *rates(task, c);
    if (c.holds) {
      if (c.locked[0]) return kept.lock();
      u += T(c.effort[0]);
    }
    const T inverse = T(1) / d;
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
      if constexpr (N <= 3) {
        const std::uint32_t rate = c.v + static_cast<std::uint32_t>(j);
        if (c.is_damped) k[j].u -= T(c.damping[j]) * number(task, task.v, rate);
        if (c.is_loaded) k[j].u += number(task, task.efforts, rate);
      }
      if (c.holds) k[j].u = c.locked[j] ? T(0) : k[j].u + T(c.effort[j]);
    }
    // D = S^T U + armature = L d L^T: row j keeps L(j, 0..j-1) and 1 / d(j).
    for (int j = 0; j < N; ++j) {
      T e[N];  // L(j, i) d(i)
      for (int i = 0; i <= j; ++i) {
        e[i] = dot(k[j].S_a, k[i].U_a) + dot(k[j].S_l, k[i].U_l);
        if constexpr (N <= 3) {
          if (i == j && c.is_loaded) e[i] += T(c.armature[j]);
        }
        if (c.holds && i == j && c.locked[j]) e[i] = T(1);
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

}  // namespace pantin::lanes

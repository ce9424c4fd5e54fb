#pragma once
// The rows of closures (closure_rows.hpp) on any lane type, and the motion of the links that they are
// between.
#include <pantin/physics/lanes/loop_lanes.hpp>
#include <pantin/physics/lanes/task_links.hpp>

namespace pantin::lanes {

template <class T>
class LoopRows : public TaskLinks<T> {
 protected:
  using Links = TaskLinks<T>;
  using Links::link, Links::rates, Links::number, Links::with_kind, Links::with_model_of;
  using typename Links::Given;
  using Vec = Vec3<T>;
  using Frame = kernel::MovingFrame<T>;

 public:
  /// What a link keeps besides LinkLanes: its origin and how that moves, accelerations at v' = 0.
  struct Trace {
    Vec p, v, al, a;
  };
  /// A row, by a multiplier of one: at a point on B, and the opposite on A.
  struct Row {
    Vec force, torque, point;
    T acceleration;
    double compliance;
  };
  /// Of a coupling, whose row has no wrench: efforts at the joints of a and b, by rate.
  struct Efforts {
    T of[2][3]{};
  };

  static constexpr int kMostRowsAndRotors = 9;

  /// By link of the tree.
  static Trace* traces(const LoopTask& loop) { return reinterpret_cast<Trace*>(loop.work); }

  static void trace(const Task& task, const LoopTask& loop) {
    for (std::uint32_t i = task.begin; i < task.end; ++i) {
      const LinkConstants& c = task.links[i];
      with_kind(c, [&](auto model) { trace_link<decltype(model)>(task, loop, c, i); });
    }
  }

  /// The rows of a closure, with the accelerations of the links as substituted last.
  static void write(const Task& task, const LoopTask& loop, const ClosureConstants& c, Row* rows,
                    Efforts& efforts) {
    if (c.coupling >= 0) write_coupling(task, loop, c, rows[0], efforts);
    else write_rows(task, loop, c, rows);
  }

 private:
  /// Takes what list_rows and list_rotors list.
  struct Rows {
    kernel::FramePair<T> pair;
    double pitch{0};
    Row* next{nullptr};

    void write(const kernel::RowTerms<T>& row, double compliance = 0) {
      *next++ = {row.force, row.torque, pair.b().p, row.acceleration, compliance};
    }
    void across(int i) { write(pair.along(pair.a().R.column(i))); }
    void square(int i, int j) { write(pair.square(i, j)); }
    void threaded() {
      const Vec z = pair.a().R.column(2);
      kernel::RowTerms<T> row = pair.along(z);
      row.torque = T(-pitch) * z;
      row.acceleration -= T(pitch) * pair.about(z, pair.a().w).acceleration;
      write(row);
    }
    void rotor(const kernel::RowTerms<T>& row, double armature) { write(row, 1 / armature); }
  };

  template <class Model>
  static void trace_link(const Task& task, const LoopTask& loop, const LinkConstants& c, std::uint32_t i) {
    Trace* all = traces(loop);
    const LinkLanes<T>& l = link(task, i);
    Trace& out = all[i - task.begin];
    Vec p{}, v{}, w_p{};
    Mat3<T> R_p = Mat3<T>::identity();
    if (c.parent >= 0) {
      const auto up = static_cast<std::uint32_t>(c.parent);
      p = all[up - task.begin].p, v = all[up - task.begin].v;
      w_p = link(task, up).w, R_p = link(task, up).R;
    } else if (c.ground >= 0) {
      const double* m = given_motion(task, c.ground);
      R_p = load9<T>(m);
      p = load3<T>(m + 9 * T::kCount), w_p = load3<T>(m + 12 * T::kCount), v = load3<T>(m + 15 * T::kCount);
    }
    out.p = p + l.r;
    out.v = v + cross(w_p, l.r);
    out.al = l.motion.al, out.a = l.motion.a;
    if constexpr (std::is_same_v<Model, Given>) {
      const double* m = given_motion(task, c.given);
      out.v += R_p * (spread_matrix<T>(c.R_PJ) * load3<T>(m + 15 * T::kCount));
    } else if constexpr (!std::is_same_v<Model, PivotModel>) {
      const RateLanes<T>* k = rates(task, c);
      for (std::uint32_t j = 0; j < std::uint32_t{Model::kRates}; ++j)
        out.v += number(task, task.v, c.v + j) * k[j].S_l;
    }
  }

  static const double* given_motion(const Task& task, std::int32_t which) {
    return task.motions + static_cast<std::size_t>(which) * kMotionNumbers * T::kCount;
  }
  static Frame given_frame(const Task& task, std::int32_t which) {
    const double* m = given_motion(task, which);
    constexpr int n = T::kCount;
    return {load9<T>(m),          load3<T>(m + 9 * n),  load3<T>(m + 12 * n),
            load3<T>(m + 15 * n), load3<T>(m + 18 * n), load3<T>(m + 21 * n)};
  }

  /// Accelerations as substituted last; all of them, the ground's too, less gravity.
  static Frame frame_of(const Task& task, const LoopTask& loop, const ClosureEndConstants& end) {
    Frame L;
    L.R = Mat3<T>::identity();
    if (end.link >= 0) {
      const auto i = static_cast<std::uint32_t>(end.link);
      const LinkLanes<T>& l = link(task, i);
      const Trace& t = traces(loop)[i - task.begin];
      L = {l.R, t.p, l.w, t.v, t.al + l.added.al, t.a + l.added.a};
    } else {
      if (end.ground >= 0) L = given_frame(task, end.ground);
      L.a -= spread<T>(task.gravity);
    }
    return kernel::carried(L, spread_matrix<T>(end.R_LJ), spread<T>(end.p_LJ));
  }

  static void write_rows(const Task& task, const LoopTask& loop, const ClosureConstants& c, Row* out) {
    Frame a = frame_of(task, loop, c.a);
    if (c.given >= 0) a = kernel::composed(a, given_frame(task, c.given));
    const Frame b = frame_of(task, loop, c.b);
    Rows rows{{a, b}, c.pitch, out};
    kernel::list_rows(c.kind, rows);
    if (c.rigid_rows == c.rows) return;
    with_model_of(c.kind, c.pitch,
                  [&](auto model) { kernel::list_rotors(model, c.kind, c.rotors, rows.pair, rows); });
  }

  static void write_coupling(const Task& task, const LoopTask& loop, const ClosureConstants& c, Row& row,
                             Efforts& efforts) {
    const double* numbers =
        loop.couplings + static_cast<std::size_t>(c.coupling) * kCouplingNumbers * T::kCount;
    row = {{}, {}, {}, T::load(numbers + 6 * T::kCount), 0};
    const ClosureEndConstants* ends[] = {&c.a, &c.b};
    for (int i = 0; i < 2; ++i) {
      const LinkConstants& tied = task.links[ends[i]->link];
      with_kind(tied, [&](auto model) {
        for (std::uint32_t k = 0; k < 3 && k < std::uint32_t{decltype(model)::kRates}; ++k) {
          efforts.of[i][k] = T::load(numbers + (3 * static_cast<std::uint32_t>(i) + k) * T::kCount);
          row.acceleration += efforts.of[i][k] * number(task, task.v_dot, tied.v + k);
        }
      });
    }
  }
};

}  // namespace pantin::lanes

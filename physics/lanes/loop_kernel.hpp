#pragma once
// Multipliers of closures (closure_solver.hpp) on any lane type. Included once by each source that compiles
// it for an instruction set, as tree_kernel.hpp.
#include <pantin/physics/lanes/loop_rows.hpp>
#include <pantin/physics/lanes/tree_kernel.hpp>

namespace pantin::lanes {

template <class T>
class LoopKernel : public LoopRows<T> {
  using Rows = LoopRows<T>;
  using Rows::kMostRowsAndRotors, Rows::write, Rows::link, Rows::rates, Rows::with_kind;
  using typename Rows::Row, typename Rows::Efforts, typename Rows::Trace;
  using Vec = Vec3<T>;

  struct Passing {
    Vec p_a, p_l;
  };

 public:
  static std::size_t work_size(const LoopSizes& s) {
    return s.links * (sizeof(Trace) / sizeof(double)) + s.longest_path * (sizeof(Passing) / sizeof(double)) +
           (s.y + 2 * s.entries + kVectors * s.rows) * std::size_t{T::kCount};
  }

  static double close(const Task& task, const LoopTask& loop) {
    const Room room{loop};
    for (std::uint32_t c = loop.begin; c < loop.end; ++c) assemble(task, loop, c, room);
    const Proximal<T> proximal{loop.envelope, room.W, room.K};
    proximal.factor(room.scale, room.mu);
    proximal.solve(room.b, room.x, room.residual);
    push(task, loop, room);
    TreeKernel<T>::substitute(task);
    return margin(loop, proximal);
  }

 private:
  static constexpr std::size_t kVectors = 5;

  /// The work space.
  struct Room {
    explicit Room(const LoopTask& loop) {
      const LoopSizes& s = loop.sizes;
      traces = Rows::traces(loop);
      passing = reinterpret_cast<Passing*>(traces + s.links);
      y = reinterpret_cast<T*>(passing + s.longest_path);
      W = y + s.y, K = W + s.entries;
      scale = K + s.entries, mu = scale + s.rows, b = mu + s.rows, x = b + s.rows, residual = x + s.rows;
    }
    Trace* traces;
    Passing* passing;
    T *y, *W, *K, *scale, *mu, *b, *x, *residual;
  };

  struct Reduction {
    T squares{}, bound{};
  };

  template <class Model>
  static void reduce_link(const Task& task, const LinkConstants& c, const Trace& at, const Row& row,
                          Passing& here, const T* efforts, T* y, Reduction& sum) {
    constexpr int kRates = Model::kRates;
    const LinkLanes<T>& l = link(task, static_cast<std::uint32_t>(&c - task.links));
    if constexpr (kRates > 0) {
      const RateLanes<T>* k = rates(task, c);
      const Vec lever = row.point - at.p, p_a = here.p_a, p_l = here.p_l;
      const T linear = dot(row.force, row.force),
              angular = dot(row.torque, row.torque) + dot(lever, lever) * linear;
      for (int j = 0; j < kRates; ++j) {
        Vec S_a, S_l{};
        if constexpr (std::is_same_v<Model, PivotModel>) S_a = l.R.column(2);
        else S_a = k[j].S_a, S_l = k[j].S_l;
        y[j] = T(0) - dot(S_a, p_a) - dot(S_l, p_l);
        if constexpr (kRates <= 3) y[j] += efforts[j];
        if (c.holds && c.locked[j]) y[j] = T(0);
        T bound = angular * dot(S_a, S_a) + linear * dot(S_l, S_l);
        for (int m = 0; m < j; ++m) {
          y[j] -= k[j].D[m] * y[m];
          bound += k[j].D[m] * k[j].D[m] * y[m] * y[m];
        }
        const T s = y[j] * k[j].D[j];
        sum.squares += y[j] * s;
        sum.bound += bound * k[j].D[j];
        here.p_a += s * k[j].U_a;
        here.p_l += s * k[j].U_l;
      }
    }
    here.p_a += cross(l.r, here.p_l);
  }

  /// Articulated::reduce.
  static Reduction reduce(const Task& task, const LoopTask& loop, const ClosureConstants& c, const Row& row,
                          const Efforts& efforts, const Room& room, T* y) {
    Reduction sum;
    const std::uint32_t count = c.path_end - c.path_begin;
    const PathLink* path = loop.paths + c.path_begin;
    for (std::uint32_t k = 0; k < count; ++k) {
      Passing& here = room.passing[k];
      here = {};
      const auto i = static_cast<std::int32_t>(path[k].link);
      if ((i == c.a.link) == (i == c.b.link)) continue;
      const T sign = T(i == c.a.link ? 1 : -1);
      here.p_l = sign * row.force;
      here.p_a = sign * (row.torque + cross(row.point - room.traces[path[k].link - task.begin].p, row.force));
    }
    const T none[3]{};
    for (std::uint32_t k = 0; k < count; ++k) {
      const LinkConstants& tied = task.links[path[k].link];
      Passing& here = room.passing[k];
      const auto i = static_cast<std::int32_t>(path[k].link);
      const T* acting = i == c.b.link ? efforts.of[1] : i == c.a.link ? efforts.of[0] : none;
      with_kind(tied, [&](auto model) {
        reduce_link<decltype(model)>(task, tied, room.traces[path[k].link - task.begin], row, here, acting,
                                     y + path[k].rates, sum);
      });
      if (path[k].up < 0) continue;
      room.passing[path[k].up].p_a += here.p_a;
      room.passing[path[k].up].p_l += here.p_l;
    }
    if (c.coupling >= 0) sum.bound = sum.squares;
    return sum;
  }

  static void assemble(const Task& task, const LoopTask& loop, std::uint32_t which, const Room& room) {
    const ClosureConstants& c = loop.closures[which];
    const ClosureConstants& first = loop.closures[loop.begin];
    Row rows[kMostRowsAndRotors];
    Efforts efforts;
    write(task, loop, c, rows, efforts);
    for (std::uint32_t r = 0; r < c.rows; ++r) {
      const std::uint32_t i = c.row - first.row + r;
      const Reduction sum = reduce(task, loop, c, rows[r], efforts, room,
                                   room.y + (c.y - first.y) + std::size_t{r} * c.path_rates);
      const T bound = sum.bound + T(rows[r].compliance), zero = T(0);
      // What is not a number stays so.
      const T broken = sum.squares - sum.squares;
      room.scale[i] = if_positive(bound, inverse_root(bound), zero) + broken;
      room.mu[i] = if_positive(bound, T(kProximal), T(1));
      room.b[i] = -room.scale[i] * rows[r].acceleration;
    }
    const Proximal<T> proximal{loop.envelope, room.W, room.K};
    for (std::uint32_t d = loop.begin; d <= which; ++d) {
      const ClosureConstants& other = loop.closures[d];
      if (other.row + other.rows <= loop.envelope.left[c.row - first.row]) continue;
      for (std::uint32_t r = 0; r < c.rows; ++r) product_row(task, loop, c, r, other, room, proximal);
    }
    for (std::uint32_t r = 0; r < c.rows; ++r)
      proximal.diagonal(room.W, c.row - first.row + r) += T(rows[r].compliance);
  }

  /// Row r of c with all rows of another up to the diagonal.
  static void product_row(const Task& task, const LoopTask& loop, const ClosureConstants& c, std::uint32_t r,
                          const ClosureConstants& other, const Room& room, const Proximal<T>& proximal) {
    const ClosureConstants& first = loop.closures[loop.begin];
    const std::uint32_t i = c.row - first.row + r;
    const T* y = room.y + (c.y - first.y) + std::size_t{r} * c.path_rates;
    for (std::uint32_t s = 0; s < other.rows; ++s) {
      const std::uint32_t j = other.row - first.row + s;
      if (j > i) break;
      const T* z = room.y + (other.y - first.y) + std::size_t{s} * other.path_rates;
      T sum = T(0);
      // Both paths go from later links to earlier ones.
      for (std::uint32_t k = c.path_begin, l = other.path_begin; k < c.path_end && l < other.path_end;) {
        const PathLink &a = loop.paths[k], &b = loop.paths[l];
        if (a.link == b.link) {
          const LinkConstants& tied = task.links[a.link];
          with_kind(tied, [&](auto model) {
            [[maybe_unused]] const RateLanes<T>* kept = rates(task, tied);
            for (int n = 0; n < decltype(model)::kRates; ++n)
              sum += y[a.rates + static_cast<std::uint32_t>(n)] * z[b.rates + static_cast<std::uint32_t>(n)] *
                     kept[n].D[n];
          });
        }
        k += a.link >= b.link ? 1 : 0;
        l += b.link >= a.link ? 1 : 0;
      }
      proximal.row(room.W, i)[j - proximal.left(i)] = sum;
    }
  }

  /// Adds what the multipliers leave at the joints to the right-hand side of the elimination.
  static void push(const Task& task, const LoopTask& loop, const Room& room) {
    const ClosureConstants& first = loop.closures[loop.begin];
    for (std::uint32_t n = loop.begin; n < loop.end; ++n) {
      const ClosureConstants& c = loop.closures[n];
      for (std::uint32_t r = 0; r < c.rows; ++r) {
        const std::uint32_t i = c.row - first.row + r;
        const T multiplier = room.scale[i] * room.x[i];
        const T* y = room.y + (c.y - first.y) + std::size_t{r} * c.path_rates;
        for (std::uint32_t k = c.path_begin; k < c.path_end; ++k) {
          const PathLink& at = loop.paths[k];
          RateLanes<T>* kept = rates(task, task.links[at.link]);
          const std::uint32_t end = k + 1 < c.path_end ? loop.paths[k + 1].rates : c.path_rates;
          for (std::uint32_t j = 0; at.rates + j < end; ++j) kept[j].u += multiplier * y[at.rates + j];
        }
      }
    }
  }

  /// ClosureSolver::margin, the least of all lanes.
  static double margin(const LoopTask& loop, const Proximal<T>& proximal) {
    double least = 1;
    for (std::uint32_t n = loop.begin; n < loop.end; ++n) {
      const ClosureConstants& c = loop.closures[n];
      for (std::uint32_t r = 0; r < c.rigid_rows; ++r) {
        const T inverse = proximal.diagonal(proximal.K, c.row - loop.closures[loop.begin].row + r);
        for (int lane = 0; lane < T::kCount; ++lane) {
          const double pivot = 1 / inverse.x[lane];
          if (pivot > kRedundant && pivot < least) least = pivot;
        }
      }
    }
    return least;
  }
};

}  // namespace pantin::lanes

// With y = (q, v) and y' = f(t, y):
//   k1 = f(t, y)   k2 = f(t + h/2, y + h/2 k1)   k3 = f(t + h/2, y + h/2 k2)   k4 = f(t + h, y + h k3)
//   y1 = y + h/6 (k1 + 2 k2 + 2 k3 + k4)
// E. Hairer, S. Norsett, G. Wanner, Solving Ordinary Differential Equations I, 2nd ed., table II.1.2.
// One pass over memory after each evaluation: it adds k to the sum and makes the next stage.
#include <pantin/physics/integrators/rk4.hpp>

#include <pantin/physics/integrators/step_arrays.hpp>

namespace pantin {
namespace {

/// What a step needs of q or of v.
struct Part {
  std::span<double> y, k, sum, stage;

  /// After k1: sum = k, stage = y + s k.
  void first(double s) const {
    const double *from = y.data(), *slope = k.data();
    double *total = sum.data(), *next = stage.data();
    for (std::size_t i = 0, n = y.size(); i < n; ++i) {
      total[i] = slope[i];
      next[i] = from[i] + s * slope[i];
    }
  }
  /// After k2 and k3: sum += 2 k, stage = y + s k.
  void middle(double s) const {
    const double *from = y.data(), *slope = k.data();
    double *total = sum.data(), *next = stage.data();
    for (std::size_t i = 0, n = y.size(); i < n; ++i) {
      total[i] += 2 * slope[i];
      next[i] = from[i] + s * slope[i];
    }
  }
  /// After k4: y += s (sum + k).
  void last(double s) const {
    const double *slope = k.data(), *total = sum.data();
    double* to = y.data();
    for (std::size_t i = 0, n = y.size(); i < n; ++i) to[i] += s * (total[i] + slope[i]);
  }
};

class Rk4 final : public Integrator {
 public:
  std::string_view name() const override { return "rk4"; }
  int order() const override { return 4; }
  double stability_radius() const override { return 2.78; }
  int evaluations(const Dynamics&) const override { return 4; }

  void step(Dynamics& dynamics, double t, double h, std::span<double> q, std::span<double> v) override {
    expect_step(dynamics, t, h, q, v);
    work_.reserve(3 * (q.size() + v.size()));
    const Part Q = part(q);
    const Part V = part(v);
    const Instant middle{t + 0.5 * h, Side::Before};
    const Instant end{t + h, Side::Before};

    dynamics.derivative({t, Side::After}, q, v, Q.k, V.k);
    Q.first(0.5 * h);
    V.first(0.5 * h);
    dynamics.derivative(middle, Q.stage, V.stage, Q.k, V.k);
    Q.middle(0.5 * h);
    V.middle(0.5 * h);
    dynamics.derivative(middle, Q.stage, V.stage, Q.k, V.k);
    Q.middle(h);
    V.middle(h);
    dynamics.derivative(end, Q.stage, V.stage, Q.k, V.k);
    Q.last(h / 6);
    V.last(h / 6);
    dynamics.settle({t + h, Side::Before}, q, v);
  }

 private:
  Part part(std::span<double> y) {
    return {y, work_.take(y.size()), work_.take(y.size()), work_.take(y.size())};
  }

  WorkSpace work_{};
};

}  // namespace

std::unique_ptr<Integrator> make_rk4() { return std::make_unique<Rk4>(); }

}  // namespace pantin

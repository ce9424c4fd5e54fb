// One step from (q, v) at t, with a = v'(t, q, v) and r = q'(q, v):
//   a0     = a(t, q, v)
//   v_half = v + h/2 a0                      half kick
//   q_mid  = q + h/2 r(q, v_half)
//   q1     = q + h r(q_mid, v_half)          drift; q_mid makes it second order where r depends on q
//   (attitudes) a1     = a(t + h, q1, v + h a0)          velocity at t + h predicted v1     = v_half + h/2 a1
//   half kick
// and, where a depends on v, once more a1 = a(t + h, q1, v1) and v1 = v_half + h/2 a1. The prediction alone
// leaves an error of h^3 in v1, so the order is two already; the correction takes most of that error away. L.
// Verlet, Phys. Rev. 159, 98 (1967); W. Swope et al., J. Chem. Phys. 76, 637 (1982), eqs. 5 and 6.
#include <pantin/physics/integrators/verlet.hpp>

#include <pantin/physics/integrators/step_arrays.hpp>

namespace pantin {
namespace {

/// v_half = v + h/2 a and v = v + h a in one pass.
void kick_and_predict(std::span<double> v, double h, std::span<const double> a, std::span<double> v_half) {
  double* full = v.data();
  double* half = v_half.data();
  const double* from = a.data();
  const double half_step = 0.5 * h;
  for (std::size_t i = 0, n = v.size(); i < n; ++i) {
    half[i] = full[i] + half_step * from[i];
    full[i] += h * from[i];
  }
}

class Verlet final : public Integrator {
 public:
  std::string_view name() const override { return "verlet"; }
  int order() const override { return 2; }
  double stability_radius() const override { return 2; }
  int evaluations(const Dynamics& dynamics) const override {
    return dynamics.acceleration_depends_on_velocity() ? 3 : 2;
  }

  void step(Dynamics& dynamics, double t, double h, std::span<double> q, std::span<double> v) override {
    expect_step(dynamics, t, h, q, v);
    work_.reserve(2 * (q.size() + v.size()));
    const std::span<double> q_dot = work_.take(q.size());
    const std::span<double> q_mid = work_.take(q.size());
    const std::span<double> a = work_.take(v.size());
    const std::span<double> v_half = work_.take(v.size());
    const Instant middle{t + 0.5 * h, Side::Before};
    const Instant end{t + h, Side::Before};

    dynamics.acceleration({t, Side::After}, q, v, a);
    kick_and_predict(v, h, a, v_half);  // v is the prediction from here on
    dynamics.rate({t, Side::After}, q, v_half, q_dot);
    set_sum(q_mid, q, 0.5 * h, q_dot);
    dynamics.rate(middle, q_mid, v_half, q_dot);
    add_scaled(q, h, q_dot);
    dynamics.settle(end, q, v);

    dynamics.acceleration(end, q, v, a);
    set_sum(v, v_half, 0.5 * h, a);
    if (dynamics.acceleration_depends_on_velocity()) {
      dynamics.acceleration(end, q, v, a);
      set_sum(v, v_half, 0.5 * h, a);
    }
    dynamics.settle(end, q, v);
  }

 private:
  WorkSpace work_{};
};

}  // namespace

std::unique_ptr<Integrator> make_verlet() { return std::make_unique<Verlet>(); }

}  // namespace pantin

#include <pantin/physics/integrators/euler.hpp>

#include <pantin/physics/integrators/step_arrays.hpp>

namespace pantin {
namespace {

class Euler final : public Integrator {
 public:
  std::string_view name() const override { return "euler"; }
  int order() const override { return 1; }
  // What swings grows slowly at any step; this bounds what decays, and the growth to e a radian.
  double stability_radius() const override { return 1; }
  int evaluations(const Dynamics&) const override { return 1; }

  void step(Dynamics& dynamics, double t, double h, std::span<double> q, std::span<double> v) override {
    expect_step(dynamics, t, h, q, v);
    work_.reserve(q.size() + v.size());
    const std::span<double> q_dot = work_.take(q.size());
    const std::span<double> v_dot = work_.take(v.size());
    dynamics.derivative({t, Side::After}, q, v, q_dot, v_dot);
    add_scaled(q, h, q_dot);
    add_scaled(v, h, v_dot);
    dynamics.settle({t + h, Side::Before}, q, v);
  }

 private:
  WorkSpace work_{};
};

}  // namespace

std::unique_ptr<Integrator> make_euler() { return std::make_unique<Euler>(); }

}  // namespace pantin

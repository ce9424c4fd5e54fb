#include <pantin/physics/integrators/semi_implicit_euler.hpp>

#include <pantin/physics/integrators/step_arrays.hpp>

namespace pantin {
namespace {

class SemiImplicitEuler final : public Integrator {
 public:
  std::string_view name() const override { return "semi-implicit-euler"; }
  int order() const override { return 1; }
  double stability_radius() const override { return 2; }
  int evaluations(const Dynamics&) const override { return 1; }

  void step(Dynamics& dynamics, double t, double h, std::span<double> q, std::span<double> v) override {
    expect_step(dynamics, t, h, q, v);
    work_.reserve(q.size() + v.size());
    const std::span<double> q_dot = work_.take(q.size());
    const std::span<double> v_dot = work_.take(v.size());
    dynamics.acceleration({t, Side::After}, q, v, v_dot);
    add_scaled(v, h, v_dot);
    dynamics.rate({t + h, Side::Before}, q, v, q_dot);  // v is the velocity at t + h by now
    add_scaled(q, h, q_dot);
    dynamics.settle({t + h, Side::Before}, q, v);
  }

 private:
  WorkSpace work_{};
};

}  // namespace

std::unique_ptr<Integrator> make_semi_implicit_euler() { return std::make_unique<SemiImplicitEuler>(); }

}  // namespace pantin

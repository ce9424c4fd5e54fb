// What stiff springs between free bodies cost, by the implicit integrators: pairs of bodies far from each
// other, on springs of 1e3 to 1e6 N/m with dampers, turning, 0.2 s in steps of 0.01 s. Prints evaluations of
// the derivative and CPU time a pair and step, least of several runs; the same where a law that couples all
// bodies without saying how makes one island of them, which is what differences of everything cost.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <memory>
#include <string>

#include "bench/cpu_time.hpp"

#include <pantin/physics/forces/damped_spring.hpp>
#include <pantin/physics/forces/force_function.hpp>
#include <pantin/physics/integrators/implicit_midpoint.hpp>
#include <pantin/physics/integrators/radau.hpp>
#include <pantin/physics/physics_manager.hpp>

namespace pantin::bench {
namespace {

constexpr int kSteps = 20;
constexpr double kStep = 0.01;

PhysicsManager pairs(int count, bool coupled) {
  PhysicsManager physics;
  for (int i = 0; i < count; ++i) {
    BodyId ends[2];
    for (int k = 0; k < 2; ++k) {
      RigidBodySettings body{.name = std::to_string(i) + (k == 0 ? " left" : " right")};
      body.X_WB = {{1.0001 * k, 0, 10.0 * i}};
      body.w_WB = {0.1, 0.2, -0.3};
      body.mass.I_BBcm_B = Vector3{0.03, 0.02, 0.025}.asDiagonal();
      ends[k] = physics.add(std::move(body));
    }
    const double stiffness = 1e3 * std::pow(1e3, count > 1 ? i / (count - 1.0) : 1.0);
    physics.forces().add(
        DampedSpring{{ends[0], {0, 0.1, 0}}, {ends[1], {0, 0.1, 0}}, stiffness, 1e-3 * stiffness, 1});
  }
  if (coupled)
    physics.forces().add(ForceFunction{.on_body = [](const BodiesAt&, std::size_t) { return Wrench{}; }});
  return physics;
}

void measure(const char* name, const Integrator& integrator, int count, bool coupled) {
  double seconds = std::numeric_limits<double>::infinity();
  int evaluations = 0;
  bool ok = true;
  for (int repeat = 0; repeat < (coupled ? 1 : 5); ++repeat) {
    PhysicsManager physics = pairs(count, coupled);
    physics.set_integrator(integrator.another());
    evaluations = 0;
    const double from = cpu_seconds();
    for (int i = 0; i < kSteps; ++i) {
      const StepReport report = physics.step(kStep);
      evaluations += report.evaluations;
      ok = ok && report.ok();
    }
    seconds = std::min(seconds, cpu_seconds() - from);
  }
  std::printf("| %s | %d%s | %d | %.1f |%s\n", name, count, coupled ? ", one island" : "", evaluations,
              1e6 * seconds / kSteps / count, ok ? "" : " failed");
}

}  // namespace
}  // namespace pantin::bench

int main() {
  using namespace pantin;
  const std::unique_ptr<Integrator> radau = make_radau({.tolerance = 1e-6}),
                                    midpoint = make_implicit_midpoint();
  std::puts("| integrator | pairs | evaluations | us a pair and step |\n|---|---|---|---|");
  for (const int count : {1, 10, 50, 200}) {
    bench::measure("radau 1e-6", *radau, count, false);
    bench::measure("implicit-midpoint", *midpoint, count, false);
  }
  bench::measure("radau 1e-6", *radau, 10, true);
  bench::measure("implicit-midpoint", *midpoint, 10, true);
}

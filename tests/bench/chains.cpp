// What the chains of chain.hpp cost at an error, 1 s under gravity, by every solver that keeps to a
// tolerance. Error: the greatest distance of a centre of gravity from the same chain solved by gauss16 at
// 1e-14, which dormand-prince at 1e-13 confirms first. Prints a row a solver and tolerance: error, CPU time,
// least of several runs, and evaluations of the derivative. Then a long run, extremes, and chains with stiff
// springs on joints and between bodies.
#include <cmath>
#include <cstdio>
#include <limits>
#include <string>
#include <vector>

#include "bench/cpu_time.hpp"
#include "bench/own_chain.hpp"
#include "bench/stiff_chain.hpp"
#include "bench/tied_chain.hpp"

#include <pantin/physics/integrators/gauss.hpp>

namespace pantin::bench {
namespace {

struct Outcome {
  std::vector<Vector3> centres{};
  double seconds{std::numeric_limits<double>::infinity()};
  int evaluations{0};
  bool ok{true};
};

Outcome run(const Chain& chain, const std::string& solver, double tolerance, int repeats) {
  Outcome outcome;
  PhysicsManager physics = build(chain);
  physics.set_integrator(make_integrator(solver, tolerance));
  const State start = physics.snapshot();
  for (int repeat = 0; repeat < repeats; ++repeat) {
    physics.restore(start);
    const double from = cpu_seconds();
    const StepReport report = physics.step(chain.duration);
    outcome.seconds = std::min(outcome.seconds, cpu_seconds() - from);
    outcome.evaluations = report.evaluations;
    outcome.ok = outcome.ok && report.ok();
  }
  for (const BodyId id : physics.bodies()) outcome.centres.push_back(physics.body(id).p_WBcm());
  return outcome;
}

double distance(const std::vector<Vector3>& a, const std::vector<Vector3>& b) {
  double most = 0;
  for (std::size_t i = 0; i < a.size(); ++i) most = std::max(most, (a[i] - b[i]).norm());
  return most;
}

void measure(const Chain& chain) {
  const std::vector<Vector3> reference = run(chain, "gauss16", 1e-14, 1).centres;
  if (chain.links <= 20) {
    std::printf("| %d %s | dormand-prince confirms | 1e-13 | %.1e | | |\n", chain.links,
                chain.bent ? "bent" : "planar",
                distance(run(chain, "dormand-prince", 1e-13, 1).centres, reference));
  }
  for (const char* solver : {"gauss8", "gauss16", "dormand-prince"}) {
    for (double tolerance = 1e-2; tolerance > 2e-13; tolerance /= 100) {
      if (solver == std::string{"dormand-prince"} && (tolerance < 1e-9 || chain.links > 100)) continue;
      const Outcome outcome = run(chain, solver, tolerance, chain.links > 100 ? 3 : 15);
      std::printf("| %d %s | %s | %.0e | %.1e | %.3f | %d |%s\n", chain.links, chain.bent ? "bent" : "planar",
                  solver, tolerance, distance(outcome.centres, reference), 1e3 * outcome.seconds,
                  outcome.evaluations, outcome.ok ? "" : " failed");
      std::fflush(stdout);
    }
  }
}

/// How far the energy strays over 1000 s, looked at every second.
void long_run() {
  PhysicsManager physics = build(Chain{5, true});
  physics.set_integrator(make_gauss({.stages = 8, .tolerance = 1e-12}));
  const double start = physics.energy().total(), from = cpu_seconds();
  double strays = 0, gap = 0;
  for (int second = 0; second < 1000; ++second) {
    if (!physics.step(1).ok()) std::printf("failed\n");
    strays = std::max(strays, std::abs(physics.energy().total() - start));
    gap = std::max(gap, physics.joint_drift().distance);
  }
  std::printf("\n1000 s of 5 bent, gauss16 at 1e-12: energy strays %.1e J, joint gap %.1e m, %.2f s CPU\n",
              strays, gap, cpu_seconds() - from);
}

/// Heavy and light tips over 0.5 s, and a fast spin: error against the same at 1e-13.
void extremes() {
  for (const Chain& chain : {Chain{20, true, 1e4, 0, 0.5}, Chain{20, true, 1e6, 0, 0.5},
                             Chain{20, true, 1e-6, 0, 0.5}, Chain{5, true, 1, 100}}) {
    const Outcome tight = run(chain, "gauss16", 1e-13, 1);
    for (const double tolerance : {1e-3, 1e-6, 1e-9}) {
      const Outcome outcome = run(chain, "gauss16", tolerance, 5);
      std::printf("%d bent, tip %g kg, spin %g rad/s, gauss16 at %.0e: error %.1e m, %.2f ms CPU%s\n",
                  chain.links, chain.tip_mass, chain.spin, tolerance,
                  distance(outcome.centres, tight.centres), 1e3 * outcome.seconds,
                  outcome.ok && tight.ok ? "" : ", failed");
    }
  }
}

}  // namespace
}  // namespace pantin::bench

int main() {
  std::printf(
      "| chain | solver | tolerance | error [m] | CPU [ms] | evaluations |\n|---|---|---|---|---|---|\n");
  for (const int links : {5, 20, 100}) {
    for (const bool bent : {false, true}) pantin::bench::measure({links, bent});
  }
  pantin::bench::measure({1000, true});
  pantin::bench::long_run();
  pantin::bench::extremes();
  pantin::bench::measure_stiff_chains();
  pantin::bench::measure_tied_chains();
}

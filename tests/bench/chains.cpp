// What chains of pivots cost at an error: rods of 0.2 m and 1 kg on axes that alternate between x and y, the
// first lifted by a right angle, in one plane or bent by 0.3 rad at every second joint, 1 s under gravity.
// Error: the greatest distance of a centre of gravity from the same chain solved by gauss16 at 1e-14, which
// dormand-prince at 1e-13 confirms first. Prints a row a solver and tolerance: error, CPU time, least of
// several runs, and evaluations of the derivative.
#include <cmath>
#include <cstdio>
#include <limits>
#include <string>
#include <vector>

#include "bench/cpu_time.hpp"
#include "support/mechanisms.hpp"

#include <pantin/physics/constraints/pivot.hpp>
#include <pantin/physics/forces/gravity.hpp>
#include <pantin/physics/integrators/gauss.hpp>
#include <pantin/physics/physics_manager.hpp>

namespace pantin::bench {
namespace {

struct Chain {
  int links{1};
  bool bent{false};
};

PhysicsManager build(const Chain& chain) {
  PhysicsManager physics;
  physics.forces().add(Gravity{.g_W = {0, 0, -9.81}});
  const Vector3 size{0.02, 0.02, 0.2};
  const Matrix3 inertia =
      (size.squaredNorm() * Matrix3::Identity() - Matrix3{size.cwiseAbs2().asDiagonal()}) / 12;
  BodyId up{};
  Pose X_WJ{};
  for (int i = 0; i < chain.links; ++i) {
    const Vector3 axis = i % 2 == 0 ? Vector3::UnitX() : Vector3::UnitY();
    const double angle = i == 0 ? std::acos(0.0) : (chain.bent && i % 2 == 1 ? 0.3 : 0);
    X_WJ.q = (X_WJ.q * Quaternion{Eigen::AngleAxisd{angle, axis}}).normalized();
    RigidBodySettings rod{.X_WB = X_WJ};
    rod.mass = {1, {0, 0, -0.1}, inertia};
    const BodyId id = physics.add(std::move(rod));
    physics.add(
        test::joint_here<PivotSettings>(physics, up, id, X_WJ * Pose{Vector3::Zero(), test::facing(axis)}));
    up = id;
    X_WJ.p = X_WJ * Vector3{0, 0, -0.2};
  }
  return physics;
}

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
    const StepReport report = physics.step(1);
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

}  // namespace
}  // namespace pantin::bench

int main() {
  std::printf(
      "| chain | solver | tolerance | error [m] | CPU [ms] | evaluations |\n|---|---|---|---|---|---|\n");
  for (const int links : {5, 20, 100}) {
    for (const bool bent : {false, true}) pantin::bench::measure({links, bent});
  }
  pantin::bench::measure({1000, true});
}

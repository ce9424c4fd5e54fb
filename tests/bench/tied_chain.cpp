#include "bench/tied_chain.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <vector>

#include "bench/cpu_time.hpp"
#include "bench/own_chain.hpp"

#include <pantin/physics/forces/damped_spring.hpp>
#include <pantin/physics/integrators/radau.hpp>

namespace pantin::bench {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();

void tie(PhysicsManager& physics, BodyId a, const Vector3& p_BQa, BodyId b, const Vector3& p_BQb, double k) {
  const Vector3 p_W = a ? physics.body(a).X_WB() * p_BQa : p_BQa;
  physics.forces().add(DampedSpring{.a = {a, p_BQa},
                                    .b = {b, p_BQb},
                                    .stiffness = k,
                                    .damping = 2 * std::sqrt(k),
                                    .rest_length = (physics.body(b).X_WB() * p_BQb - p_W).norm()});
}

PhysicsManager tied(bool by_tip, double k) {
  PhysicsManager physics = build(Chain{5, true});
  const std::vector<BodyId> rods{physics.bodies().begin(), physics.bodies().end()};
  if (by_tip) tie(physics, BodyId{}, {2, 1, 0}, rods[4], {0, 0, -kRodLength}, k);
  for (std::size_t i = 0; !by_tip && i + 2 < rods.size(); ++i)
    tie(physics, rods[i], {0.1, 0, -0.5}, rods[i + 2], {0.05, 0.05, -0.3}, k);
  return physics;
}

struct Motion {
  std::vector<Vector3> centres{};
  double milliseconds{kInfinite};  ///< CPU, least of several runs
  int evaluations{0};
  bool ok{true};
};

Motion run(PhysicsManager& physics, double tolerance, int steps, int repeats) {
  physics.set_integrator(make_radau({.tolerance = tolerance}));
  const State start = physics.snapshot();
  Motion motion;
  for (int repeat = 0; repeat < repeats; ++repeat) {
    physics.restore(start);
    motion.evaluations = 0;
    const double from = cpu_seconds();
    for (int i = 0; i < steps && motion.ok; ++i) {
      const StepReport report = physics.step(1.0 / steps);
      motion.ok = report.ok();
      motion.evaluations += report.evaluations;
    }
    motion.milliseconds = std::min(motion.milliseconds, 1e3 * (cpu_seconds() - from));
  }
  for (const BodyId id : physics.bodies()) motion.centres.push_back(physics.body(id).p_WBcm());
  physics.restore(start);
  return motion;
}

double distance(const Motion& a, const Motion& b) {
  double most = 0;
  for (std::size_t i = 0; i < a.centres.size(); ++i)
    most = std::max(most, (a.centres[i] - b.centres[i]).norm());
  return most;
}

}  // namespace

void measure_tied_chains() {
  std::printf(
      "\n| ties | N/m | 4,000 steps from 2,000 | 10 steps | 40 steps | 1e-06 | 1e-09 "
      "|\n|---|---|---|---|---|---|---|\n");
  for (const bool by_tip : {true, false}) {
    for (const double k : {1e2, 1e4, 1e6, 1e8, 1e10}) {
      PhysicsManager chain = tied(by_tip, k);
      const Motion fine = run(chain, kInfinite, 4000, 1), half = run(chain, kInfinite, 2000, 1);
      std::printf("| %s | %.0e | %.1e |", by_tip ? "tip to world" : "rods to next but one", k,
                  distance(fine, half));
      const auto cell = [&](double tolerance, int steps) {
        const Motion motion = run(chain, tolerance, steps, 5);
        if (motion.ok)
          std::printf(" %.1e, %.2f ms, %d |", distance(motion, fine), motion.milliseconds,
                      motion.evaluations);
        else std::printf(" failed |");
      };
      cell(kInfinite, 10), cell(kInfinite, 40), cell(1e-6, 1), cell(1e-9, 1);
      std::printf("\n");
      std::fflush(stdout);
    }
  }
}

}  // namespace pantin::bench

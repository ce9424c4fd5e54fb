#include "bench/stiff_chain.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <memory>
#include <vector>

#include "bench/cpu_time.hpp"
#include "bench/own_chain.hpp"

#include <pantin/physics/integrators/gauss.hpp>
#include <pantin/physics/integrators/radau.hpp>

namespace pantin::bench {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();
constexpr double kInertia = 0.05;  ///< for which dampers are critical [kg m^2]
constexpr double kResolved = 1e6;  ///< up to it explicit stages follow springs [N m/rad]

struct Motion {
  std::vector<Vector3> centres{};
  double milliseconds{kInfinite};  ///< CPU, least of several runs
  bool ok{true};
};

Motion run(const Chain& chain, std::unique_ptr<Integrator> integrator, int steps, int repeats = 1) {
  PhysicsManager physics = build(chain);
  physics.set_integrator(std::move(integrator));
  const State start = physics.snapshot();
  Motion motion;
  for (int repeat = 0; repeat < repeats; ++repeat) {
    physics.restore(start);
    const double from = cpu_seconds();
    for (int i = 0; i < steps && motion.ok; ++i) motion.ok = physics.step(chain.duration / steps).ok();
    motion.milliseconds = std::min(motion.milliseconds, 1e3 * (cpu_seconds() - from));
  }
  for (const BodyId id : physics.bodies()) motion.centres.push_back(physics.body(id).p_WBcm());
  return motion;
}

/// Greatest difference of a coordinate of a centre of gravity [m].
double difference(const Motion& a, const Motion& b) {
  double most = 0;
  for (std::size_t i = 0; i < a.centres.size(); ++i) {
    const double d = (a.centres[i] - b.centres[i]).lpNorm<Eigen::Infinity>();
    if (!(d <= most)) most = d;
  }
  return most;
}

void print_cell(const Chain& chain, const Motion& reference, double tolerance, int steps) {
  const Motion motion = run(chain, make_radau({.tolerance = tolerance}), steps, 5);
  std::printf(" %.1e, %.2f ms%s |", difference(motion, reference), motion.milliseconds,
              motion.ok ? "" : ", failed");
}

}  // namespace

void measure_stiff_chains() {
  Chain rigid{5, true};
  rigid.stiffness = kInfinite;
  const Motion limit = run(rigid, make_gauss({.stages = 8, .tolerance = 1e-13}), 1);
  std::printf(
      "\n| N m/rad | damping | radau in 4,000 steps: from 2,000, from gauss16, from a rigid chain | 10 steps "
      "| 40 "
      "steps | 1e-06 | 1e-09 |\n|---|---|---|---|---|---|---|\n");
  for (const bool damped : {true, false}) {
    for (const double k : {1e2, 1e4, 1e6, 1e8, 1e10}) {
      Chain chain{5, true};
      chain.stiffness = k;
      chain.damping = damped ? 2 * std::sqrt(kInertia * k) : 0;
      const Motion fine = run(chain, make_radau({.tolerance = kInfinite}), 4000);
      const Motion coarse = run(chain, make_radau({.tolerance = kInfinite}), 2000);
      std::printf("| %.0e | %s | %.1e, ", k, damped ? "critical" : "none", difference(fine, coarse));
      Motion reference = fine;
      if (k <= kResolved) {
        reference = run(chain, make_gauss({.stages = 8, .tolerance = 1e-12}), 1);
        std::printf("%.1e, ", difference(fine, reference));
      } else {
        std::printf("-, ");
      }
      std::printf("%.1e |", difference(fine, limit));
      print_cell(chain, reference, kInfinite, 10);
      print_cell(chain, reference, kInfinite, 40);
      print_cell(chain, reference, 1e-6, 1);
      print_cell(chain, reference, 1e-9, 1);
      std::printf("\n");
      std::fflush(stdout);
    }
  }
}

}  // namespace pantin::bench

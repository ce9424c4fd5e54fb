// What closed loops cost at an error: rows of four-bars that share their posts (N loops, 2 N + 1 bars, one
// freedom; five rows a loop, three of them redundant), and nets of bars on ball joints (N meshes side by
// side, all freedoms), 1 s under gravity, by every solver that keeps to a tolerance. Error: the greatest
// distance of a centre of gravity from the same mechanism solved by gauss16 at 1e-13, which dormand-prince at
// 1e-12 confirms first. Prints a row a solver and tolerance: error, CPU time, least of several runs,
// evaluations of the derivative, and time of one and a bar.
#include <cmath>
#include <cstdio>
#include <limits>
#include <string>
#include <vector>

#include "bench/cpu_time.hpp"
#include "support/mechanisms.hpp"

#include <pantin/physics/constraints/ball.hpp>
#include <pantin/physics/constraints/pivot.hpp>
#include <pantin/physics/forces/gravity.hpp>
#include <pantin/physics/physics_manager.hpp>

namespace pantin::bench {
namespace {

using test::joint_here;

BodyId bar(PhysicsManager& physics, const Vector3& from, const Vector3& to) {
  RigidBodySettings s{.name = "bar",
                      .X_WB = {0.5 * (from + to), Quaternion::FromTwoVectors(Vector3::UnitX(), to - from)}};
  s.mass.I_BBcm_B = Vector3{1e-3, 1. / 12, 1. / 12}.asDiagonal();
  return physics.add(std::move(s));
}

/// Posts of 1 m on pivots, 1 m apart, each joined to the next at the top, that begin to fall over, by half a
/// radian in 1 s.
PhysicsManager four_bars(int loops) {
  PhysicsManager physics;
  physics.forces().add(Gravity{.g_W = {0, -9.81, 0}});
  const auto pivot = [&](BodyId a, BodyId b, const Vector3& at) {
    return physics.add(joint_here<PivotSettings>(physics, a, b, {at, Quaternion::Identity()}));
  };
  BodyId last{};
  JointId base{};
  for (int i = 0; i <= loops; ++i) {
    const Vector3 foot{1.0 * i, 0, 0}, top{1.0 * i, 1, 0};
    const BodyId post = bar(physics, foot, top);
    const JointId joint = pivot({}, post, foot);
    if (i == 0) base = joint;
    else {
      const BodyId link = bar(physics, top - Vector3::UnitX(), top);
      pivot(last, link, top - Vector3::UnitX());
      pivot(link, post, top);
    }
    last = post;
  }
  physics.set_joint_rate(base, 0.1);
  return physics;
}

/// A ladder of bars that hangs by its first rung, stretched out sideways: two ropes of bars, a rung a mesh.
PhysicsManager net(int meshes) {
  PhysicsManager physics;
  physics.forces().add(Gravity{.g_W = {0.5, 0.3, -9.81}});
  const auto ball = [&](BodyId a, BodyId b, const Vector3& at) {
    physics.add(joint_here<BallSettings>(physics, a, b, {at, Quaternion::Identity()}));
  };
  BodyId ends[2]{};
  for (int i = 0; i < meshes; ++i) {
    BodyId next[2];
    for (const int side : {0, 1}) {
      const Vector3 from{1.0 * i, 1.0 * side, 0};
      next[side] = bar(physics, from, from + Vector3::UnitX());
      ball(ends[side], next[side], from);
    }
    const Vector3 left{i + 1.0, 0, 0}, right{i + 1.0, 1, 0};
    const BodyId rung = bar(physics, left, right);
    ball(next[0], rung, left);
    ball(next[1], rung, right);
    ends[0] = next[0], ends[1] = next[1];
  }
  return physics;
}

struct Outcome {
  std::vector<Vector3> centres{};
  double seconds{std::numeric_limits<double>::infinity()};
  int evaluations{0};
  bool ok{true};
};

Outcome run(PhysicsManager& physics, const std::string& solver, double tolerance, int repeats) {
  Outcome outcome;
  physics.set_integrator(make_integrator(solver, tolerance));
  const State start = physics.snapshot();
  for (int repeat = 0; repeat < repeats; ++repeat) {
    const double from = cpu_seconds();
    const StepReport report = physics.step(1);
    outcome.seconds = std::min(outcome.seconds, cpu_seconds() - from);
    outcome.evaluations = report.evaluations;
    outcome.ok = outcome.ok && report.ok();
    if (repeat + 1 == repeats) {
      for (const BodyId id : physics.bodies()) outcome.centres.push_back(physics.body(id).p_WBcm());
    }
    physics.restore(start);
  }
  return outcome;
}

double distance(const std::vector<Vector3>& a, const std::vector<Vector3>& b) {
  double most = 0;
  for (std::size_t i = 0; i < a.size(); ++i) most = std::max(most, (a[i] - b[i]).norm());
  return most;
}

void measure(const char* name, PhysicsManager physics) {
  const auto bars = static_cast<double>(physics.bodies().size());
  const std::vector<Vector3> reference = run(physics, "gauss16", 1e-13, 1).centres;
  std::printf("| %s, %.0f bars | dormand-prince confirms | 1e-12 | %.1e | | | |\n", name, bars,
              distance(run(physics, "dormand-prince", 1e-12, 1).centres, reference));
  for (const char* solver : {"gauss8", "gauss16", "dormand-prince"}) {
    for (const double tolerance : {1e-4, 1e-6, 1e-8, 1e-10}) {
      const Outcome outcome = run(physics, solver, tolerance, 7);
      std::printf("| %s, %.0f bars | %s | %.0e | %.1e | %.3f | %d | %.0f |%s\n", name, bars, solver,
                  tolerance, distance(outcome.centres, reference), 1e3 * outcome.seconds, outcome.evaluations,
                  1e9 * outcome.seconds / outcome.evaluations / bars, outcome.ok ? "" : " failed");
      std::fflush(stdout);
    }
  }
}

}  // namespace
}  // namespace pantin::bench

int main() {
  using namespace pantin::bench;
  std::printf("| mechanism | solver | tolerance | error [m] | CPU [ms] | evaluations | ns/bar |\n");
  std::printf("|---|---|---|---|---|---|---|\n");
  for (const int loops : {1, 10}) measure("four-bars", four_bars(loops));
  for (const int meshes : {2, 10}) measure("net", net(meshes));
}

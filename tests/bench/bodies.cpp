// What bodies cost: 10,000 free bodies under gravity by RK4 beside a hand-written loop of the same
// arithmetic, and chains of pivots by the articulated elimination. Interleaved in one run, minimum of several
// repeats, ratios.
#include <cstdio>
#include <functional>
#include <limits>
#include <vector>

#include "bench/cpu_time.hpp"
#include "support/mechanisms.hpp"

namespace pantin {
namespace {

using bench::seconds_of;

constexpr int kBodies = 10000;
constexpr double kStep = 1e-3;

RigidBodySettings tumbling(int i) {
  RigidBodySettings s;
  s.X_WB.p = {0.1 * i, 0, 0};
  s.w_WB = {1, 0.01 * i, 2};
  s.mass = test::lopsided_mass();
  return s;
}

/// The same bodies, each stepped by RK4 on (position, quaternion, P, L) in a loop written for them alone.
struct HandWritten {
  struct Body {
    BodyState s{};
    Matrix3 inverse_inertia{};
    double mass{1};
  };
  struct Slope {
    Vector3 v{}, force{};
    Eigen::Vector4d q_dot{};
  };
  std::vector<Body> bodies{};

  static Slope slope(const Body& body, const Vector3& P, const Quaternion& q) {
    const Matrix3 R = q.normalized().toRotationMatrix();
    const Vector3 L_B = R.transpose() * body.s.angular_momentum;
    const Vector3 w = R * (body.inverse_inertia * L_B);
    const Quaternion dq = Quaternion{0, w.x(), w.y(), w.z()} * q;
    return {P / body.mass, body.mass * Vector3{0, 0, -9.81}, 0.5 * dq.coeffs()};
  }
  void step(double h) {
    for (Body& body : bodies) {
      const auto moved = [&](double f, const Eigen::Vector4d& q_dot) {
        Quaternion q;
        q.coeffs() = body.s.q_WB.coeffs() + f * q_dot;
        return q;
      };
      const Vector3 P = body.s.linear_momentum;
      const Slope a = slope(body, P, body.s.q_WB);
      const Slope b = slope(body, P + h / 2 * a.force, moved(h / 2, a.q_dot));
      const Slope c = slope(body, P + h / 2 * b.force, moved(h / 2, b.q_dot));
      const Slope d = slope(body, P + h * c.force, moved(h, c.q_dot));
      body.s.p_WBcm += h / 6 * (a.v + 2 * b.v + 2 * c.v + d.v);
      body.s.linear_momentum += h / 6 * (a.force + 2 * b.force + 2 * c.force + d.force);
      body.s.q_WB.coeffs() += h / 6 * (a.q_dot + 2 * b.q_dot + 2 * c.q_dot + d.q_dot);
      body.s.q_WB.normalize();
    }
  }
};

void bench_free_bodies() {
  PhysicsManager physics;
  physics.forces().add(Gravity{});
  HandWritten hand;
  for (int i = 0; i < kBodies; ++i) {
    const RigidBody body = physics.body(physics.add(tumbling(i)));
    hand.bodies.push_back({body.state(), body.I_BBcm_B_inverse(), body.mass()});
  }
  static_cast<void>(physics.step(kStep));
  hand.step(kStep);
  double ours = std::numeric_limits<double>::infinity(), by_hand = ours;
  for (int repeat = 0; repeat < 30; ++repeat) {
    ours = std::min(ours, seconds_of([&] { static_cast<void>(physics.step(kStep)); }));
    by_hand = std::min(by_hand, seconds_of([&] { hand.step(kStep); }));
  }
  double difference = 0;
  for (std::size_t i = 0; i < hand.bodies.size(); ++i) {
    difference =
        std::max(difference, (hand.bodies[i].s.p_WBcm - physics.body(physics.bodies()[i]).p_WBcm()).norm());
  }
  std::printf(
      "free bodies, RK4 under gravity: %.0f ns a body and step, by hand %.0f, ratio %.2f; positions differ "
      "by %.1e m\n",
      1e9 * ours / kBodies, 1e9 * by_hand / kBodies, ours / by_hand, difference);
}

void bench_chain(int links) {
  PhysicsManager physics;
  physics.forces().add(Gravity{});
  BodyId last{};
  for (int i = 0; i < links; ++i) {
    RigidBodySettings s{.X_WB = {{0.2 * i, 0, 0}}, .mass = test::lopsided_mass()};
    const BodyId id = physics.add(std::move(s));
    const Vector3 axis = i % 2 == 0 ? Vector3{0, 1, 0} : Vector3{1, 0, 0};
    physics.add(test::joint_here<PivotSettings>(physics, last, id, {{0.2 * i, 0, 0}, test::facing(axis)}));
    last = id;
  }
  static_cast<void>(physics.step(1e-5));
  double best = std::numeric_limits<double>::infinity();
  for (int repeat = 0; repeat < 30; ++repeat) {
    best = std::min(best, seconds_of([&] {
                      for (int k = 0; k < 2000 / links; ++k) static_cast<void>(physics.step(1e-5));
                    }));
  }
  std::printf("chain of %d pivots: %.0f ns a body and evaluation (a quarter of an RK4 step)\n", links,
              1e9 * best / (2000 / links) / links / 4);
}

}  // namespace
}  // namespace pantin

int main() {
  pantin::bench_free_bodies();
  for (const int links : {1, 5, 20, 100, 1000}) pantin::bench_chain(links);
}

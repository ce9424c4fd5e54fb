#include <pantin/physics/integrators/motion_record.hpp>

#include <cmath>
#include <limits>

#include <gtest/gtest.h>
#include <support/expect_contract.hpp>
#include <support/mechanisms.hpp>
#include <support/toy_dynamics.hpp>

#include <pantin/physics/constraints/pivot.hpp>
#include <pantin/physics/integrators/dormand_prince.hpp>
#include <pantin/physics/integrators/gauss.hpp>
#include <pantin/physics/integrators/radau.hpp>

namespace pantin {
namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();

TEST(MotionRecord, CubicThroughBothEndsIsExactForACubic) {
  // y = 2 - t + 3 t^2 - t^3 from t = 1 to 3, given by values and derivatives at the ends.
  const auto y = [](double t) { return 2 - t + 3 * t * t - t * t * t; };
  const auto slope = [](double t) { return -1 + 6 * t - 3 * t * t; };
  MotionRecord record;
  const double q0 = y(1), v0 = -y(1);
  const MotionRecord::Room part = record.add(1, 2, 3, {&q0, 1}, {&v0, 1});
  for (const std::size_t i : {0, 1}) {
    const double sign = i == 0 ? 1 : -1;
    part.at(1)[i] = sign * y(3);
    part.at(2)[i] = sign * slope(3);
    part.at(3)[i] = sign * slope(1);
  }
  MotionRecord::fit_cubic(part, 2);
  for (const double t : {1.0, 1.3, 2.0, 2.9, 3.0}) {
    double q = 0, v = 0;
    record.evaluate(t, {&q, 1}, {&v, 1});
    EXPECT_NEAR(q, y(t), 1e-13);
    EXPECT_NEAR(v, -y(t), 1e-13);
  }
  EXPECT_EQ(record.begin(), 1);
  EXPECT_EQ(record.end(), 3);
}

/// The greatest error inside one step of h of a driven, damped oscillator, whose motion is known.
double error_inside(Integrator& integrator, double h) {
  test::Oscillator oscillator{{.omega = 3, .decay = 0.2, .force = 1, .force_frequency = 2}};
  const test::State start{{1}, {0}};
  MotionRecord record;
  integrator.record_into(&record);
  test::State state = start;
  integrator.step(oscillator, 0, h, state.q, state.v);
  EXPECT_EQ(record.parts(), 1);
  double greatest = 0;
  for (const double x : {0.1, 0.3, 0.5, 0.7, 0.9}) {
    test::State inside = start;
    record.evaluate(x * h, inside.q, inside.v);
    const test::State exact = oscillator.exact(start, x * h);
    greatest = std::max({greatest, std::abs(inside.q[0] - exact.q[0]), std::abs(inside.v[0] - exact.v[0])});
  }
  record.evaluate(h, state.q, state.v);
  EXPECT_NEAR(state.q[0], oscillator.exact(start, h).q[0], greatest + 1e-13);
  return greatest;
}

TEST(MotionRecord, InterpolantsAreOfTheirOrder) {
  // Against the closed form inside one step: a polynomial of collocation with s stages is off by h^(s+1), the
  // interpolant of Dormand-Prince by h^5.
  const auto order = [](Integrator& integrator, double h) {
    return std::log2(error_inside(integrator, h) / error_inside(integrator, h / 2));
  };
  EXPECT_NEAR(order(*make_dormand_prince({.tolerance = kInf}), 0.1), 5, 0.5);
  EXPECT_NEAR(order(*make_gauss({.stages = 2, .tolerance = kInf}), 0.1), 3, 0.4);
  EXPECT_NEAR(order(*make_gauss({.stages = 4, .tolerance = kInf}), 0.2), 5, 0.5);
  EXPECT_NEAR(order(*make_radau({.tolerance = kInf}), 0.2), 5, 0.5);
  EXPECT_LT(error_inside(*make_gauss({.stages = 8, .tolerance = kInf}), 0.1), 1e-12);
}

/// A pendulum beside a free body, a swing and a parabola.
struct Scene {
  PhysicsManager physics{};
  BodyId bob{}, stone{};
  explicit Scene(std::unique_ptr<Integrator> integrator) {
    physics.set_integrator(std::move(integrator));
    physics.forces().add(Gravity{.g_W = {0, 0, -9.81}});
    const MassProperties mass{.mass = 1, .I_BBcm_B = Vector3{0.1, 0.2, 0.15}.asDiagonal()};
    bob = physics.add(RigidBodySettings{.name = "bob", .X_WB = {.p = {0.4, 0, 0}}, .mass = mass});
    stone = physics.add(RigidBodySettings{.name = "stone", .X_WB = {.p = {5, 0, 0}}, .mass = mass});
    physics.set_velocity(stone, {1, 0, 3}, {0.5, 2, -1});
    physics.add(
        PivotSettings{.b = bob,
                      .X_AJ = {.q = Quaternion{Eigen::AngleAxisd{1.5707963267948966, Vector3::UnitX()}}},
                      .X_BJ = {.p = {-0.4, 0, 0},
                               .q = Quaternion{Eigen::AngleAxisd{1.5707963267948966, Vector3::UnitX()}}}});
  }
};

TEST(DenseOutput, IsTheMotionInsideAStep) {
  // The same scene advanced in short steps tells where the bodies are; inside one step of 0.05 s an
  // interpolant of order p is off by at most some (3 rad/s * 0.05 s)^p.
  struct Case {
    const char* integrator;
    double tolerance, error;
  };
  for (const auto& [name, tolerance, error] : {Case{"rk4", 0, 2e-5}, Case{"dormand-prince", 1e-10, 1e-8},
                                               Case{"gauss16", 1e-10, 1e-9}, Case{"radau", 1e-10, 1e-7}}) {
    Scene scene{tolerance > 0 ? make_integrator(name, tolerance) : make_integrator(name)};
    Scene fine{make_integrator("gauss16", 1e-13)};
    scene.physics.keep_motion(true);
    ASSERT_TRUE(scene.physics.step(0.05).ok());
    for (const double t : {0.01, 0.02, 0.03, 0.04}) {
      ASSERT_TRUE(fine.physics.step(t - fine.physics.time()).ok());
      const std::vector<BodyKinematics> inside = scene.physics.motion_at(t);
      ASSERT_EQ(inside.size(), 2U);
      for (std::size_t i = 0; i < 2; ++i) {
        const RigidBody body = fine.physics.body(fine.physics.bodies()[i]);
        EXPECT_LT((inside[i].p_WBcm - body.p_WBcm()).norm(), error) << name << ' ' << t;
        EXPECT_LT((inside[i].R_WB - body.q_WB().toRotationMatrix()).norm(), error) << name << ' ' << t;
        EXPECT_LT((inside[i].v_WBcm - body.v_WBcm()).norm(), 20 * error) << name << ' ' << t;
        EXPECT_LT((inside[i].w_WB - body.w_WB()).norm(), 20 * error) << name << ' ' << t;
      }
      // A parabola is a polynomial that all of them hold.
      EXPECT_LT((inside[1].p_WBcm - Vector3{5 + t, 0, 3 * t - 4.905 * t * t}).norm(), 1e-13) << name;
    }
  }
}

TEST(DenseOutput, ChangesNothingOfTheMotion) {
  // Keeping the motion only listens: states after ten steps are the same to the bit.
  for (const char* name : {"rk4", "dormand-prince", "gauss8", "radau"}) {
    Scene with{make_integrator(name)}, without{make_integrator(name)};
    with.physics.keep_motion(true);
    for (int i = 0; i < 10; ++i) {
      ASSERT_TRUE(with.physics.step(0.01).ok());
      ASSERT_TRUE(without.physics.step(0.01).ok());
    }
    EXPECT_EQ(hash(with.physics.snapshot()), hash(without.physics.snapshot())) << name;
  }
}

TEST(DenseOutput, SaysWhatIsMissing) {
  // Each question that cannot be answered breaks the contract, with its remedy.
  Scene scene{make_integrator("rk4")};
  test::expect_contract([&] { static_cast<void>(scene.physics.motion_at(0)); }, "keep_motion");
  scene.physics.keep_motion(true);
  ASSERT_TRUE(scene.physics.step(0.01).ok());
  test::expect_contract([&] { static_cast<void>(scene.physics.motion_at(0.02)); },
                        "not inside the last step");
  scene.physics.make_static(scene.stone);
  static_cast<void>(scene.physics.snapshot());
  test::expect_contract([&] { static_cast<void>(scene.physics.motion_at(0.005)); },
                        "have changed since the last step");
}

}  // namespace
}  // namespace pantin

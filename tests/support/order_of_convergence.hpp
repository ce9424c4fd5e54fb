#pragma once
// Smooth problems of every kind of state, and the measured order of an integrator on them.
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <support/tight_solution.hpp>
#include <support/toy_dynamics.hpp>

namespace pantin::test {

/// A problem whose solution after `duration` is known.
struct SmoothProblem {
  std::string kind{};  ///< of state: "translation", "rotation", "coupled" and what is special
  std::shared_ptr<Dynamics> dynamics{};
  State start{}, end{};
  double duration{0};
};

/// `steps` equal steps from t = 0.
inline State run(Integrator& integrator, Dynamics& dynamics, State state, double duration, int steps) {
  const double h = duration / steps;
  for (int step = 0; step < steps; ++step) integrator.step(dynamics, step * h, h, state.q, state.v);
  return state;
}

/// Root of the sum of the squared differences of all numbers. Quaternions keep their sign along a motion, so
/// they compare as they are.
inline double distance(const State& a, const State& b) {
  double squares = 0;
  for (std::size_t i = 0; i < a.q.size(); ++i) squares += std::pow(a.q[i] - b.q[i], 2);
  for (std::size_t i = 0; i < a.v.size(); ++i) squares += std::pow(a.v[i] - b.v[i], 2);
  return std::sqrt(squares);
}

inline const Pose kToyPose{{0.3, -0.2, 0.5}, Quaternion{0.5, -0.1, 0.7, 0.5}.normalized()};

/// Pulled to the origin by a spring at an off-centre point, optionally damped there and pushed around in
/// time: neither half of the state moves without the other.
inline ToyBody::Load off_centre_spring(double damping, double push) {
  return [damping, push](const ToyBody::Motion& m) {
    const Vector3 r = m.R * Vector3{0.4, 0.3, -0.2};
    const Vector3 force = -6 * (m.p + r) - damping * (m.v + m.w.cross(r)) +
                          push * Vector3{std::cos(3 * m.t), std::sin(2 * m.t), 0};
    return Wrench{force, r.cross(force)};
  };
}

inline std::vector<SmoothProblem> smooth_problems() {
  std::vector<SmoothProblem> problems;
  const auto oscillator = [&](const std::string& kind, const Oscillator::Settings& settings) {
    const auto dynamics = std::make_shared<Oscillator>(settings);
    const State start{{0.8}, {-0.5}};
    problems.push_back({kind, dynamics, start, dynamics->exact(start, 2), 2});
  };
  oscillator("translation", {.omega = 2});
  oscillator("translation, damped", {.omega = 2, .decay = 0.4});
  oscillator("translation, driven in time", {.omega = 2, .force = 1.5, .force_frequency = 3});

  const auto body = [&](const std::string& kind, const ToyBody::Settings& settings) {
    const auto dynamics = std::make_shared<ToyBody>(settings);
    const State start = ToyBody::state(kToyPose, {0.5, 1, -0.3}, {1.2, 0.7, -1.5});
    problems.push_back({kind, dynamics, start, tight_solution(*dynamics, start, 1.5), 1.5});
  };
  const auto symmetric = std::make_shared<ToyBody>(ToyBody::Settings{.moments = {1, 1, 0.6}});
  const State start = ToyBody::state(kToyPose, {0.5, 1, -0.3}, {1.2, 0.7, -1.5});
  problems.push_back(
      {"rotation, free symmetric body", symmetric, start, symmetric->exact_symmetric(start, 1.5), 1.5});
  body("rotation, free asymmetric body", {.moments = {1, 1.5, 0.7}});
  body("rotation, torque in time and attitude",
       {.moments = {1, 1.5, 0.7}, .load = [](const ToyBody::Motion& m) {
          const Vector3 torque = 2 * m.R.col(0).cross(Vector3::UnitZ()) + Vector3{std::cos(2 * m.t), 0, 0.5};
          return Wrench{Vector3::Zero(), torque};
        }});
  body("coupled", {.mass = 2, .moments = {1, 1.5, 0.7}, .load = off_centre_spring(0, 0)});
  body("coupled, damped and driven in time", {.mass = 2,
                                              .moments = {1, 1.5, 0.7},
                                              .load = off_centre_spring(0.5, 2),
                                              .load_looks_at_velocity = true});
  return problems;
}

/// Halving the step divides the error by 2^order, twice in a row, for every smooth problem. `steps` of the
/// coarsest run must be many enough for higher powers of the step to be small (the tolerance), and few enough
/// for the error of the finest to stay well over rounding (checked).
inline void expect_order(Integrator& integrator, double order, int steps, double tolerance) {
  EXPECT_EQ(integrator.order(), static_cast<int>(order));
  for (const SmoothProblem& problem : smooth_problems()) {
    double errors[3];
    for (int i = 0; i < 3; ++i) {
      errors[i] = distance(run(integrator, *problem.dynamics, problem.start, problem.duration, steps << i),
                           problem.end);
    }
    EXPECT_GT(errors[2], 4e-12) << problem.kind;
    EXPECT_NEAR(std::log2(errors[0] / errors[1]), order, tolerance) << problem.kind;
    EXPECT_NEAR(std::log2(errors[1] / errors[2]), order, tolerance) << problem.kind;
  }
}

inline void expect_order(const std::string& name, double order, int steps, double tolerance) {
  expect_order(*make_integrator(name), order, steps, tolerance);
}

}  // namespace pantin::test

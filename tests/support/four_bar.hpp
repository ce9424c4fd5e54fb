#pragma once
// A planar four-bar of rods in the x-y plane, held by pivots about z, and its motion by quadrature: with one
// coordinate theta, M(theta) theta'^2 / 2 + V(theta) = E, so t = integral of sqrt(M / (2 (E - V))) d theta.
#include <array>
#include <cmath>
#include <vector>

#include "support/mechanisms.hpp"

namespace pantin::test {

/// Crank (turns fully), coupler, rocker; the ground pivots are at the origin and at (kGround, 0).
struct FourBar {
  static constexpr double kGround = 1.0, kG = 9.81;
  static constexpr std::array<double, 3> kLength{0.3, 0.9, 0.7}, kMass{1.0, 2.0, 1.5};

  struct Point {
    double x{0}, y{0};
  };
  /// Absolute angles of the rods and their derivatives by theta.
  struct Shape {
    std::array<double, 3> angle{}, rate{};
    std::array<Point, 3> centre{}, velocity{};
  };
  static Shape shape(double theta) {
    const auto [l1, l2, l3] = kLength;
    const Point a{l1 * std::cos(theta), l1 * std::sin(theta)};
    const double dx = kGround - a.x, dy = -a.y, d = std::hypot(dx, dy);
    const double along = (d * d + l2 * l2 - l3 * l3) / (2 * d), up = std::sqrt(l2 * l2 - along * along);
    const Point b{a.x + (along * dx - up * dy) / d, a.y + (along * dy + up * dx) / d};
    Shape s;
    s.angle = {theta, std::atan2(b.y - a.y, b.x - a.x), std::atan2(b.y, b.x - kGround)};
    // From the tips' velocities: l1 (n1) + l2 w2 (n2) = l3 w3 (n3), n across a rod.
    const double s2 = std::sin(s.angle[1] - s.angle[2]);
    s.rate = {1, l1 * std::sin(s.angle[2] - theta) / (l2 * s2),
              l1 * std::sin(s.angle[1] - theta) / (l3 * s2)};
    const std::array<Point, 3> start{Point{0, 0}, a, Point{kGround, 0}};
    const std::array<Point, 3> start_v{Point{}, Point{-a.y, a.x}, Point{}};
    for (std::size_t i = 0; i < 3; ++i) {
      const double h = kLength[i] / 2, c = std::cos(s.angle[i]), n = std::sin(s.angle[i]);
      s.centre[i] = {start[i].x + h * c, start[i].y + h * n};
      s.velocity[i] = {start_v[i].x - h * n * s.rate[i], start_v[i].y + h * c * s.rate[i]};
    }
    return s;
  }
  static double inertia_of(std::size_t i) { return kMass[i] * kLength[i] * kLength[i] / 12; }
  static double inertia(double theta) {
    const Shape s = shape(theta);
    double sum = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const Point& v = s.velocity[i];
      sum += kMass[i] * (v.x * v.x + v.y * v.y) + inertia_of(i) * s.rate[i] * s.rate[i];
    }
    return sum;
  }
  static double potential(double theta) {
    const Shape s = shape(theta);
    double sum = 0;
    for (std::size_t i = 0; i < 3; ++i) sum += kMass[i] * kG * s.centre[i].y;
    return sum;
  }
  /// Time from `from`, with the rate given there, to `to`; by composite Gauss quadrature with five points,
  /// whose error is of tenth order in pieces of 0.02 rad.
  static double time(double from, double rate, double to) {
    const double energy = 0.5 * inertia(from) * rate * rate + potential(from);
    constexpr std::array<double, 5> x{-0.9061798459386640, -0.5384693101056831, 0, 0.5384693101056831,
                                      0.9061798459386640};
    constexpr std::array<double, 5> w{0.2369268850561891, 0.4786286704993665, 0.5688888888888889,
                                      0.4786286704993665, 0.2369268850561891};
    const int pieces = static_cast<int>(std::ceil(std::abs(to - from) / 0.02));
    const double h = (to - from) / pieces;
    double sum = 0;
    for (int i = 0; i < pieces; ++i) {
      for (std::size_t k = 0; k < 5; ++k) {
        const double theta = from + h * (i + 0.5 + 0.5 * x[k]);
        sum += 0.5 * h * w[k] * std::sqrt(inertia(theta) / (2 * (energy - potential(theta))));
      }
    }
    return sum;
  }

  static constexpr double kStart = 0.7, kRate = 12;  ///< fast enough never to stop

  PhysicsManager physics{};
  ForceId gravity{};
  std::array<BodyId, 3> rods{};
  std::array<JointId, 4> joints{};  ///< ground-crank, crank-coupler, coupler-rocker, ground-rocker

  /// `order` in which the joints are added, which decides on the one that is cut among equals.
  explicit FourBar(std::array<int, 4> order = {0, 1, 2, 3}, double damping = 0, bool moves = true,
                   const std::array<JointAxis, 4>& axes = {}) {
    gravity = physics.forces().add(Gravity{.g_W = {0, -kG, 0}});
    const Shape s = shape(kStart);
    const double speed = moves ? kRate : 0;
    for (std::size_t i = 0; i < 3; ++i) {
      MassProperties m;
      m.mass = kMass[i];
      m.I_BBcm_B = Vector3{1e-3, inertia_of(i), inertia_of(i)}.asDiagonal();
      rods[i] =
          physics.add(RigidBodySettings{.name = std::array<const char*, 3>{"crank", "coupler", "rocker"}[i],
                                        .X_WB = {{s.centre[i].x, s.centre[i].y, 0},
                                                 Quaternion{Eigen::AngleAxisd{s.angle[i], Vector3::UnitZ()}}},
                                        .v_WBcm = {speed * s.velocity[i].x, speed * s.velocity[i].y, 0},
                                        .w_WB = {0, 0, speed * s.rate[i]},
                                        .mass = m});
    }
    const Vector3 tip{kLength[0] * std::cos(kStart), kLength[0] * std::sin(kStart), 0};
    const Vector3 far{kGround + kLength[2] * std::cos(s.angle[2]), kLength[2] * std::sin(s.angle[2]), 0};
    const std::array<Vector3, 4> place{Vector3::Zero(), tip, far, Vector3{kGround, 0, 0}};
    const std::array<std::pair<BodyId, BodyId>, 4> ends{
        std::pair{BodyId{}, rods[0]}, {rods[0], rods[1]}, {rods[1], rods[2]}, {BodyId{}, rods[2]}};
    constexpr std::array<const char*, 4> names{"base", "tip", "far", "post"};
    for (const int k : order) {
      const auto j = static_cast<std::size_t>(k);
      PivotSettings pivot = joint_here<PivotSettings>(physics, ends[j].first, ends[j].second,
                                                      {place[j], Quaternion::Identity()}, names[j]);
      pivot.damping = damping;
      pivot.axis = axes[j];
      joints[j] = physics.add(pivot);
    }
  }
  [[nodiscard]] double crank_angle() const { return kStart + double{physics.joint_value(joints[0])}; }
};

}  // namespace pantin::test

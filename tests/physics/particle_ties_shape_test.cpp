// The shapes that ties hang and bend in; what else ties do is tested in particle_ties_test.cpp.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include <pantin/physics/forces/gravity.hpp>
#include <pantin/physics/forces/linear_drag.hpp>
#include <pantin/physics/particles/ties.hpp>
#include <pantin/physics/physics_manager.hpp>

#include "support/mechanisms.hpp"
#include "support/rope.hpp"

namespace pantin {
namespace {

using test::Rope;
using test::run;

constexpr double kG = 9.81;

/// Greatest distance of a hanging rope of this many links from the catenary through its ends.
double catenary_error(int links) {
  // Length 2 between points at distance 1: y = a cosh(x / a) + c with 2 a sinh(1 / (2 a)) = 2.
  double a = 0.3;
  for (int k = 0; k < 60; ++k) {
    const double u = 1 / (2 * a);
    a -= (2 * a * std::sinh(u) - 2) / (2 * std::sinh(u) - 2 * u * std::cosh(u));
  }
  Rope rope{links + 1, {-0.5, 0, 0}, {0, 0, 0}, 0.01 * 20 / links};
  // Laid out along the curve, with the length of each link as it has to be, and let settle in a medium.
  ParticleManager& particles = rope.physics.particles();
  for (const ParticleConstraintId tie : rope.ties) particles.remove(tie);
  for (int i = 0; i <= links; ++i) {
    const double s = -1 + 2.0 * i / links, x = a * std::asinh(s / a);
    particles.set_position(rope.ids[static_cast<std::size_t>(i)],
                           {x, 0, a * std::cosh(x / a) - a * std::cosh(0.5 / a)});
  }
  for (std::size_t i = 1; i < rope.ids.size(); ++i) {
    particles.add(DistanceTie{.a = rope.ids[i - 1], .b = rope.ids[i], .length = 2.0 / links});
  }
  rope.physics.forces().add(Gravity{.g_W = {0, 0, -kG}});
  rope.physics.forces().add(LinearDrag{.coefficient = 0.3 / links});
  rope.pin(0);
  rope.pin(rope.ids.size() - 1);
  EXPECT_TRUE(run(rope.physics, 1.0 / 60, 1200));
  double worst = 0;
  for (std::size_t i = 0; i < rope.ids.size(); ++i) {
    EXPECT_LT(rope.v(i).norm(), 1e-4);
    const Vector3 p = rope.p(i);
    worst = std::max(worst, std::abs(p.z() - (a * std::cosh(p.x() / a) - a * std::cosh(0.5 / a))));
  }
  return worst;
}

TEST(ParticleTies, HangAsACatenary) {
  // At rest a rope of n links hangs as a chain of bars; its knots tend to the catenary with the square of the
  // link.
  const double coarse = catenary_error(10), fine = catenary_error(20);
  EXPECT_LT(fine, 2e-3);
  EXPECT_GT(coarse / fine, 3.3) << coarse << " " << fine;
}

/// Deflection of a clamped rod's free end under a small force there, over F l^3 / (3 E I).
double cantilever(int links) {
  const double B = 2e-2, l = 1, force = 1e-4;
  Rope rope{links + 2, {-l / links, 0, 0}, {l / links, 0, 0}, 1e-3};
  for (std::size_t i = 2; i < rope.ids.size(); ++i) {
    rope.physics.particles().add(BendTie{
        .a = rope.ids[i - 2], .b = rope.ids[i - 1], .c = rope.ids[i], .stiffness = B, .damping_time = 0.2});
  }
  rope.pin(0);
  rope.pin(1);
  class Tip final : public ForceLaw {
   public:
    explicit Tip(double f) : f_{f} {}
    void add_wrenches(const BodiesAt&, std::span<Wrench>) const override {}
    ParticleAction acts_on(ParticleSystemId) const override { return ParticleAction::Each; }
    void add_particle_forces(const ParticlesAt& at, const ParticleForces& forces) const override {
      for (std::size_t i = 0; i < at.size(); ++i) {
        if (at.x[i] > 0.99) forces.z[i] += f_;
      }
    }

   private:
    double f_;
  };
  rope.physics.forces().add_law(std::make_unique<Tip>(force));
  EXPECT_TRUE(run(rope.physics, 0.02, 500));
  return rope.p(rope.ids.size() - 1).z() / (force * l * l * l / (3 * B));
}

TEST(ParticleTies, BendAsABeam) {
  // Euler and Bernoulli: a clamped beam gives by F l^3 / (3 E I) under a force at its end. The rod of n links
  // lumps its curvature at knots, the first of them at the clamp with the length of the link before it in
  // part: first order in 1/n, here extrapolated from two.
  const double coarse = cantilever(10), fine = cantilever(20);
  EXPECT_NEAR(fine, 1, 0.15);
  EXPECT_NEAR(2 * fine - coarse, 1, 0.02) << coarse << " " << fine;
}

TEST(ParticleTies, HingesStoreTheEnergyOfABentSheet) {
  // A sheet bent about its edges to a cylinder of radius R holds (stiffness / 2) (area) / R^2; the hinges'
  // energy tends to it with the mesh, whose two outermost rows of edges have no hinge: 1/24 is missing. The
  // sheet is laid flat, hinged, then placed on the cylinder.
  const double R = 2, k = 0.3;
  PhysicsManager physics;
  const ParticleSystemId cloth = physics.particles().add(ParticleSystemSettings{});
  constexpr int n = 24;
  const double d = 1.0 / n;
  std::vector<ParticleId> ids;
  const auto at = [&](int i, int j) { return ids[static_cast<std::size_t>(i * (n + 1) + j)]; };
  for (int i = 0; i <= n; ++i) {
    for (int j = 0; j <= n; ++j)
      ids.push_back(physics.particles().add_particle(cloth, {.p_WP = {i * d, j * d, 0}}));
  }
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      const auto hinge = [&](ParticleId a, ParticleId b, ParticleId c, ParticleId e) {
        physics.particles().add(HingeTie{.a = a, .b = b, .c = c, .d = e, .stiffness = k});
      };
      hinge(at(i, j), at(i + 1, j + 1), at(i + 1, j), at(i, j + 1));
      if (i > 0) hinge(at(i, j), at(i, j + 1), at(i + 1, j + 1), at(i - 1, j));
      if (j > 0) hinge(at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j - 1));
    }
  }
  EXPECT_NEAR(physics.particles().energy().potential, 0, 1e-15);
  for (int i = 0; i <= n; ++i) {
    for (int j = 0; j <= n; ++j) {
      const double angle = i * d / R;
      physics.particles().set_position(at(i, j), {R * std::sin(angle), j * d, R * (1 - std::cos(angle))});
    }
  }
  EXPECT_NEAR(physics.particles().energy().potential, 0.5 * k / (R * R) * 23 / 24, 2e-3 * 0.5 * k / (R * R));
}

}  // namespace
}  // namespace pantin

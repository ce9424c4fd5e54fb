#include <pantin/physics/integrators/jacobian.hpp>

#include <cmath>
#include <limits>

#include <gtest/gtest.h>
#include <support/allocation_guard.hpp>
#include <support/mechanisms.hpp>
#include <support/toy_dynamics.hpp>

#include <pantin/physics/forces/damped_spring.hpp>
#include <pantin/physics/forces/linear_drag.hpp>
#include <pantin/physics/forces/torsion_spring.hpp>
#include <pantin/physics/integrators/group_solver.hpp>
#include <pantin/physics/integrators/implicit_midpoint.hpp>
#include <pantin/physics/integrators/radau.hpp>

namespace pantin {
namespace {

/// Oscillators that know nothing of each other: x_i'' = -(i + 1) x_i^3 - v_i.
class Crowd final : public Dynamics {
 public:
  explicit Crowd(std::size_t count) : count_{count} {}
  std::size_t coordinates() const override { return count_; }
  std::size_t velocities() const override { return count_; }
  void rate(Instant, std::span<const double>, std::span<const double> v, std::span<double> q_dot) override {
    std::copy(v.begin(), v.end(), q_dot.begin());
  }
  void acceleration(Instant, std::span<const double> q, std::span<const double> v,
                    std::span<double> v_dot) override {
    ++evaluations;
    for (std::size_t i = 0; i < count_; ++i)
      v_dot[i] = -(1.0 + static_cast<double>(i)) * q[i] * q[i] * q[i] - v[i];
  }
  void list_groups(NumberGroups& groups) override {
    groups.clear();
    for (std::size_t i = 0; i < count_; ++i) {
      groups.add(i, 1);
      groups.add(count_ + i, 1);
      groups.end_group();
    }
  }
  int evaluations{0};

 private:
  std::size_t count_;
};

TEST(Jacobian, TakesAsManyDerivativesAsTheGreatestGroupHasNumbers) {
  // Two numbers a group: two derivatives, however many groups there are; the blocks in closed form.
  constexpr std::size_t kCount = 20;
  Crowd crowd{kCount};
  std::vector<double> q(kCount), v(kCount, 0.5), slope(2 * kCount), change(2 * kCount, 1e-7);
  for (std::size_t i = 0; i < kCount; ++i) q[i] = 0.1 * static_cast<double>(i);
  crowd.derivative({}, q, v, std::span{slope}.first(kCount), std::span{slope}.subspan(kCount));
  Jacobian J;
  crowd.list_groups(J.groups);
  J.fit();
  crowd.evaluations = 0;
  crowd.jacobian({{}, q, v, slope, change}, J);
  EXPECT_EQ(crowd.evaluations, 2);
  ASSERT_EQ(J.groups.size(), kCount);
  for (std::size_t i = 0; i < kCount; ++i) {
    const std::span<const double> block = J.block(i);
    EXPECT_EQ(block[0], 0);
    EXPECT_NEAR(block[1], -3 * (1.0 + static_cast<double>(i)) * q[i] * q[i], 1e-4);
    EXPECT_NEAR(block[2], 1, 1e-6);
    EXPECT_NEAR(block[3], -1, 1e-6);
  }
}

TEST(Jacobian, IsOneGroupUnlessTheDynamicsSaysMore) {
  test::Oscillator oscillator{{.omega = 3, .decay = 0.25}};
  const std::vector<double> q{0.5}, v{-1}, slope{-1, -9 * 0.5 + 0.5}, change{1e-7, 1e-7};
  Jacobian J;
  oscillator.list_groups(J.groups);
  J.fit();
  oscillator.jacobian({{}, q, v, slope, change}, J);
  ASSERT_EQ(J.groups.size(), 1u);
  EXPECT_EQ(J.groups.largest(), 2u);
  const double expected[] = {0, -9, 1, -0.5};
  for (std::size_t k = 0; k < 4; ++k) EXPECT_NEAR(J.block(0)[k], expected[k], 1e-6);
}

TEST(GroupSolver, SolvesEveryGroupWhateverItsSize) {
  // The product with what it has solved is the right-hand side again; rows differ by 1e12, and the second
  // group has nothing on its first diagonal, 1 - 0.2 * 5.
  Jacobian J;
  J.groups.add(0, 1);
  J.groups.add(3, 2);
  J.groups.end_group();
  J.groups.add(1, 2);
  J.groups.end_group();
  J.fit();
  const double first[] = {-1, 4e12, 2, 0.3, -7e12, 1, 5, 2e12, -3};
  std::copy(std::begin(first), std::end(first), J.block(0).begin());
  const double second[] = {5, -25, 1, -0.1};
  std::copy(std::begin(second), std::end(second), J.block(1).begin());
  const double s = 0.2;
  std::vector<double> x{1, 2, 3, 4, 5}, b = x;
  GroupSolver solver;
  solver.factor(J, s);
  solver.solve(J, x);
  for (std::size_t g = 0; g < J.groups.size(); ++g) {
    const std::span<const std::uint32_t> numbers = J.groups.group(g);
    for (std::size_t i = 0; i < numbers.size(); ++i) {
      double sum = x[numbers[i]], size = std::abs(sum);
      for (std::size_t j = 0; j < numbers.size(); ++j) {
        const double term = s * J.block(g)[j * numbers.size() + i] * x[numbers[j]];
        sum -= term;
        size = std::max(size, std::abs(term));
      }
      EXPECT_NEAR(sum, b[numbers[i]], 1e-14 * size) << g << ' ' << i;
    }
  }
}

/// Compares the Jacobian that a Dynamics states with differences of it, and moves nothing.
class Comparer final : public Integrator {
 public:
  std::string_view name() const override { return "comparer"; }
  int order() const override { return 1; }
  int evaluations(const Dynamics&) const override { return 1; }
  void step(Dynamics& dynamics, double t, double, std::span<double> q, std::span<double> v) override {
    const Instant at{t, Side::After};
    std::vector<double> slope(q.size() + v.size()), change(slope.size(), 1e-7);
    dynamics.derivative(at, q, v, std::span{slope}.first(q.size()), std::span{slope}.subspan(q.size()));
    Jacobian stated, differences;
    dynamics.list_groups(stated.groups);
    dynamics.list_groups(differences.groups);
    stated.fit();
    differences.fit();
    dynamics.jacobian({at, q, v, slope, change}, stated);
    dynamics.Dynamics::jacobian({at, q, v, slope, change}, differences);
    groups = stated.groups.size();
    for (std::size_t g = 0; g < groups; ++g) {
      double size = 1;
      for (const double entry : differences.block(g)) size = std::max(size, std::abs(entry));
      for (std::size_t k = 0; k < stated.block(g).size(); ++k) {
        const double off = std::abs(stated.block(g)[k] - differences.block(g)[k]) / size;
        if (!(off <= worst)) worst = off;
      }
    }
  }
  double worst{0};
  std::size_t groups{0};
};

TEST(Jacobian, OfFreeBodiesIsExactIslandByIsland) {
  // Two pairs of thrown bodies on springs, a body in drag, a pendulum on a spring with another body: four
  // islands, and what is stated agrees with differences of the whole derivative, which know no group. A
  // change of 1e-7 leaves some 1e-7 of the second derivatives.
  PhysicsManager physics;
  std::vector<BodyId> ids;
  for (int i = 0; i < 7; ++i) {
    RigidBodySettings body = test::thrown_body();
    body.name += std::to_string(i);
    body.X_WB.p += Vector3{2.0 * i, 0.3 * i, -0.2 * i};
    body.w_WB *= 0.2 * i - 0.5;
    ids.push_back(physics.add(std::move(body)));
  }
  physics.forces().add(Gravity{});
  physics.forces().add(LinearDrag{.coefficient = 0.7, .angular_coefficient = 0.2});
  const auto tie = [&](std::size_t a, std::size_t b) {
    physics.forces().add(DampedSpring{{ids[a], {0.2, 0, 0.1}}, {ids[b], {0, -0.3, 0}}, 40, 2, 1});
  };
  tie(0, 1), tie(2, 3), tie(5, 6);
  physics.forces().add(TorsionSpring{.a = ids[0], .b = ids[1], .stiffness = 8, .damping = 1});
  physics.add(test::joint_here<BallSettings>(physics, {}, ids[5], {{9, 1, 4}}));
  auto comparer = std::make_unique<Comparer>();
  const Comparer& seen = *comparer;
  physics.set_integrator(std::move(comparer));
  ASSERT_TRUE(physics.step(0.01).ok());
  EXPECT_EQ(seen.groups, 4u);
  EXPECT_LT(seen.worst, 2e-6);
}

/// Pairs of bodies on stiff, damped springs, far from each other.
PhysicsManager pairs(int count, std::unique_ptr<Integrator> integrator) {
  PhysicsManager physics;
  for (int i = 0; i < count; ++i) {
    std::vector<BodyId> ids;
    for (const double x : {0.0, 1.0001}) {
      RigidBodySettings body{.name = "b" + std::to_string(i) + (x > 0 ? "right" : "left")};
      body.X_WB = {{x, 0, 10.0 * i}};
      body.w_WB = {0.1, 0.2, -0.3};
      body.mass = test::lopsided_mass();
      ids.push_back(physics.add(std::move(body)));
    }
    physics.forces().add(DampedSpring{{ids[0], {0, 0.1, 0}}, {ids[1], {0, 0.1, 0}}, 1e6, 1e3, 1});
  }
  physics.set_integrator(std::move(integrator));
  return physics;
}

std::unique_ptr<Integrator> implicit(bool is_radau) {
  return is_radau ? make_radau({.tolerance = 1e-6}) : make_implicit_midpoint();
}

TEST(Jacobian, CostsNoDerivativesForFreeBodiesUnderLawsThatStateTheirs) {
  // What implicit steps evaluate does not grow with the number of islands that are advanced together, and is
  // what the iteration itself takes: differences would cost 26 derivatives more each time, or 26 * 50.
  for (const bool is_radau : {false, true}) {
    const auto evaluations = [is_radau](int count) {
      PhysicsManager physics = pairs(count, implicit(is_radau));
      int sum = 0;
      for (int i = 0; i < 20; ++i) {
        const StepReport report = physics.step(0.01);
        EXPECT_TRUE(report.ok());
        sum += report.evaluations;
      }
      return sum;
    };
    const int of_one = evaluations(1);
    EXPECT_LT(of_one, is_radau ? 1000 : 300);
    EXPECT_NEAR(evaluations(50), of_one, 0.2 * of_one) << is_radau;
  }
}

TEST(Jacobian, TakesEveryParticleByItself) {
  // Under drag alone the midpoint rule divides every velocity by (1 + a) / (1 - a) a step, a = c h / 2 m, in
  // closed form. Stiff as it is (a = 50), only Newton's method gets there; with one particle a group it needs
  // six derivatives for the matrix, not six for each of 300, and then few steps, since drag is linear.
  PhysicsManager physics;
  const ParticleSystemId dust = physics.particles().add({.name = "dust", .mass = 0.1});
  physics.forces().add(LinearDrag{.coefficient = 1000});
  physics.set_integrator(make_implicit_midpoint());
  for (int i = 0; i < 300; ++i)
    physics.particles().add_particle(dust, {.p_WP = {1.0 * i, 0, 0}, .v_WP = {1, -0.01 * i, 2}});
  const double a = 1000 * 0.01 / (2 * 0.1), left = (1 - a) / (1 + a);
  const StepReport report = physics.step(0.01);
  ASSERT_TRUE(report.ok());
  EXPECT_LT(report.particles.evaluations, 2 * 25);  // in batches of 256
  for (std::size_t i = 0; i < 300; ++i) {
    const Vector3 expected = left * Vector3{1, -0.01 * static_cast<double>(i), 2};
    EXPECT_LT((physics.particles().system(dust).v_WP(i) - expected).norm(), 1e-9) << i;
  }
}

TEST(Jacobian, LetsImplicitStepsAllocateNothing) {
  // Once the work space has grown to the scene.
  for (const bool is_radau : {false, true}) {
    const double whole = std::numeric_limits<double>::infinity();
    PhysicsManager physics =
        pairs(40, is_radau ? make_radau({.tolerance = whole}) : make_implicit_midpoint());
    for (int i = 0; i < 5; ++i) ASSERT_TRUE(physics.step(0.01).ok());
    const std::size_t before = test::allocations_so_far();
    for (int i = 0; i < 30; ++i) static_cast<void>(physics.step(0.01));
    EXPECT_EQ(test::allocations_so_far() - before, 0u) << is_radau;
  }
}

}  // namespace
}  // namespace pantin

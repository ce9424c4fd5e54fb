#include <pantin/physics/lanes/tree_lanes.hpp>

#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>
#include <support/lane_trees.hpp>
#include <support/mixed_tree.hpp>

#include <pantin/physics/forces/damped_spring.hpp>
#include <pantin/physics/integrators/gauss.hpp>
#include <pantin/physics/lanes/lane.hpp>

namespace pantin {
namespace {

struct Baseline {};  // the flags of this source
using Four = lanes::Lane<Baseline, 4>;

/// Distance of two doubles in units of the last place of the true value.
double units(double found, long double exact) {
  const double nearest = std::abs(static_cast<double>(exact)), unit = std::nextafter(nearest, 2.0) - nearest;
  return static_cast<double>(std::abs(static_cast<long double>(found) - exact)) / unit;
}

TEST(Lane, SineAndCosineAreRightToTwoUnitsInTheLastPlace) {
  // Against the extended precision of the standard library, near 0, near multiples of pi/2, up to 1e5, where
  // reduction is hardest, and beyond, where the standard library takes over.
  std::mt19937_64 random{7};
  for (const double range : {1e-3, 0.8, 6.0, 1e3, 9.9e4, 1e9}) {
    std::uniform_real_distribution<double> angle{-range, range};
    double worst = 0;
    for (int i = 0; i < 20000; ++i) {
      double x[4], s[4], c[4];
      for (double& one : x) one = angle(random);
      if (i % 4 == 0) x[0] = std::round(x[0] / 1.5707963267948966) * 1.5707963267948966;
      const lanes::SineCosine<Four> both = lanes::sine_cosine(Four::load(x));
      both.sine.store(s), both.cosine.store(c);
      for (int k = 0; k < 4; ++k) {
        if (x[k] == 0) continue;
        worst = std::max({worst, units(s[k], std::sin(static_cast<long double>(x[k]))),
                          units(c[k], std::cos(static_cast<long double>(x[k])))});
      }
    }
    EXPECT_LT(worst, 2.3) << range;
  }
}

TEST(TreeLanes, AllInstructionSetsSayTheSame) {
  // One source, three translations: they differ by the rounding of fused products only, which an elimination
  // of 40 links of masses around 1 does not enlarge much.
  test::LaneTree tree{40};
  std::vector<double> first;
  for (const lanes::InstructionSet set : lanes::instruction_sets()) {
    const std::vector<double> v_dot = tree.solve(lanes::kernel_for(set));
    if (first.empty()) first = v_dot;
    for (std::size_t i = 0; i < v_dot.size(); ++i) {
      EXPECT_NEAR(v_dot[i], first[i], 1e-10 * (1 + std::abs(first[i]))) << to_string(set) << ' ' << i;
    }
  }
}

/// Positions of all bodies of `physics` after 1 s by collocation with so many stages.
std::vector<Vector3> after_a_second(PhysicsManager physics, int stages) {
  physics.set_integrator(make_gauss({.stages = stages, .tolerance = 1e-13}));
  EXPECT_TRUE(physics.step(1).ok());
  std::vector<Vector3> positions;
  for (const BodyId id : physics.bodies()) positions.push_back(physics.body(id).p_WBcm());
  return positions;
}

TEST(TreeLanes, MoveTreesAsTheScalarKernelDoes) {
  // Four and eight stages are computed in lanes, seven one after the other by the scalar kernel; all solve
  // the same equations to 1e-13 a second. Gravity alone takes one way through the lanes, a law of its own
  // another.
  for (const bool floating : {false, true}) {
    for (const bool springs : {false, true}) {
      const auto made = [&] {
        PhysicsManager physics = test::mixed_tree(floating);
        if (springs) {
          physics.forces().add(DampedSpring{.a = {BodyId{}, {1, 1, 1}},
                                            .b = {physics.bodies()[6], {0.1, 0, 0}},
                                            .stiffness = 10,
                                            .damping = 1,
                                            .rest_length = 0.5});
        }
        return physics;
      };
      const std::vector<Vector3> scalar = after_a_second(made(), 7), four = after_a_second(made(), 4),
                                 eight = after_a_second(made(), 8);
      for (std::size_t i = 0; i < scalar.size(); ++i) {
        EXPECT_LT((four[i] - scalar[i]).norm(), 1e-10) << i;
        EXPECT_LT((eight[i] - scalar[i]).norm(), 1e-10) << i;
      }
    }
  }
}

TEST(TreeLanes, CarryAnimatedGroundsAndDrivenJoints) {
  // The same on a turning arm and with a part driven against its parent, whose motions differ from stage to
  // stage.
  const auto made = [] { return test::driven_chain(); };
  const std::vector<Vector3> scalar = after_a_second(made(), 7), eight = after_a_second(made(), 8);
  for (std::size_t i = 0; i < scalar.size(); ++i) EXPECT_LT((eight[i] - scalar[i]).norm(), 1e-11) << i;
}

}  // namespace
}  // namespace pantin

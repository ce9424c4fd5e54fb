#include <pantin/physics/lanes/tree_lanes.hpp>

#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>
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

/// A tree of `count` links of all kinds, its root floating, with numbers from a seed.
std::vector<lanes::LinkConstants> random_tree(int count, std::uint32_t& coordinates, std::uint32_t& rates) {
  constexpr JointKind kKinds[] = {JointKind::Free,   JointKind::Pivot, JointKind::Slider,
                                  JointKind::Ball,   JointKind::Fixed, JointKind::Universal,
                                  JointKind::Planar, JointKind::Screw, JointKind::Cylindrical};
  constexpr std::uint32_t kSizes[][2] = {{7, 6}, {1, 1}, {1, 1}, {4, 3}, {0, 0},
                                         {2, 2}, {3, 3}, {1, 1}, {2, 2}};
  std::mt19937 random{11};
  std::uniform_real_distribution<double> any{-1, 1};
  std::vector<lanes::LinkConstants> links(static_cast<std::size_t>(count));
  coordinates = rates = 0;
  for (int i = 0; i < count; ++i) {
    lanes::LinkConstants& c = links[static_cast<std::size_t>(i)];
    const int kind = i == 0 ? 0 : 1 + (i - 1) % 8;
    c.kind = kKinds[kind];
    c.parent = i == 0 ? -1 : static_cast<std::int32_t>(std::uniform_int_distribution<int>{0, i - 1}(random));
    c.q = coordinates, c.v = rates;
    coordinates += kSizes[kind][0], rates += kSizes[kind][1];
    const Matrix3 R =
        Quaternion{any(random), any(random), any(random), any(random)}.normalized().toRotationMatrix();
    for (int k = 0; k < 9; ++k) c.R_PJ[k] = R(k / 3, k % 3);
    for (double& p : c.p_PJ) p = any(random);
    c.mass = 1 + any(random) / 2;
    for (double& h : c.moment) h = 0.1 * any(random);
    for (int k = 0; k < 3; ++k) c.inertia[k] = 1 + any(random) / 3, c.inertia[3 + k] = 0.1 * any(random);
    for (double& d : c.damping) d = 0.1;
    c.is_damped = true;
    c.is_loaded = i % 2 == 1;
    if (c.is_loaded) std::fill_n(c.armature, 3, 0.05);
    c.pitch = 0.2;
  }
  for (std::size_t i = links.size(); i-- > 1;) {
    lanes::LinkConstants& up = links[static_cast<std::size_t>(links[i].parent)];
    links[i].first_child = up.leaf;
    up.leaf = false;
  }
  return links;
}

TEST(TreeLanes, AllInstructionSetsSayTheSame) {
  // One source, three translations: they differ by the rounding of fused products only, which an elimination
  // of 40 links of masses around 1 does not enlarge much.
  std::uint32_t coordinates = 0, rates = 0;
  const std::vector<lanes::LinkConstants> links = random_tree(40, coordinates, rates);
  constexpr std::size_t kStages = 8;
  std::mt19937 random{5};
  std::uniform_real_distribution<double> any{-1, 1};
  std::vector<double> q(coordinates * kStages), v(rates * kStages), efforts(rates * kStages);
  for (double& x : q) x = any(random);
  for (double& x : v) x = any(random);
  for (double& x : efforts) x = any(random);
  std::vector<double> first;
  for (const lanes::InstructionSet set : lanes::instruction_sets()) {
    const lanes::Kernel& kernel = lanes::kernel_for(set);
    std::vector<double> v_dot(rates * kStages), room(kernel.work_size(links.size(), rates) + 8);
    const auto address = reinterpret_cast<std::uintptr_t>(room.data());
    for (std::size_t s = 0; s < kStages; s += static_cast<std::size_t>(kernel.lanes)) {
      const lanes::Task task{.links = links.data(),
                             .begin = 0,
                             .end = static_cast<std::uint32_t>(links.size()),
                             .q = q.data(),
                             .v = v.data(),
                             .v_dot = v_dot.data(),
                             .stages = kStages,
                             .first = s,
                             .gravity = {0.1, 0.2, -9.81},
                             .efforts = efforts.data(),
                             .work = room.data() + (64 - address % 64) % 64 / sizeof(double)};
      kernel.outward(task);
      kernel.solve(task);
    }
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

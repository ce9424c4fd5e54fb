#include <pantin/physics/lanes/loop_lanes.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include <pantin/physics/constraints/gear.hpp>
#include <pantin/physics/integrators/gauss.hpp>

#include "support/four_bar.hpp"
#include "support/gears.hpp"
#include "support/lane_trees.hpp"
#include "support/mixed_tree.hpp"
#include "support/two_hands.hpp"

namespace pantin {
namespace {

using test::joint_here;
using test::TwoHands;

/// Closures between links of a tree by hand: the paths to its root, the rows and their envelope.
struct LaneLoops {
  std::vector<PathLink> paths{};
  std::vector<lanes::ClosureConstants> closures{};
  std::vector<std::uint32_t> left{};
  std::vector<std::size_t> begins{0};
  lanes::LoopSizes sizes{};

  void add(const test::LaneTree& tree, JointKind kind, std::uint32_t rows, std::int32_t a, std::int32_t b) {
    lanes::ClosureConstants c;
    c.kind = kind, c.rows = c.rigid_rows = rows;
    c.a.link = a, c.b.link = b;
    for (lanes::ClosureEndConstants* end : {&c.a, &c.b}) {
      for (int k = 0; k < 9; k += 4) end->R_LJ[k] = 1;
      end->p_LJ[0] = 0.3, end->p_LJ[2] = 0.1;
    }
    c.row = static_cast<std::uint32_t>(left.size()), c.y = sizes.y;
    c.path_begin = static_cast<std::uint32_t>(paths.size());
    std::vector<std::int32_t> above;
    for (std::int32_t link : {a, b}) {
      for (; link >= 0; link = tree.links[static_cast<std::size_t>(link)].parent) above.push_back(link);
    }
    std::sort(above.begin(), above.end(), std::greater{});
    above.erase(std::unique(above.begin(), above.end()), above.end());
    for (const std::int32_t link : above) {
      const lanes::LinkConstants& l = tree.links[static_cast<std::size_t>(link)];
      const auto up = std::find(above.begin(), above.end(), l.parent);
      paths.push_back({static_cast<std::uint32_t>(link),
                       up == above.end() ? -1 : static_cast<std::int32_t>(up - above.begin()), c.path_rates});
      const auto next = static_cast<std::size_t>(link) + 1;
      c.path_rates += (next < tree.links.size() ? tree.links[next].v : tree.rates) - l.v;
    }
    c.path_end = static_cast<std::uint32_t>(paths.size());
    for (std::uint32_t r = 0; r < rows; ++r) {
      left.push_back(0);
      begins.push_back(begins.back() + left.size());
    }
    sizes.y += std::size_t{rows} * c.path_rates;
    sizes.rows = left.size(), sizes.entries = begins.back();
    sizes.links = tree.links.size(), sizes.longest_path = std::max(sizes.longest_path, above.size());
    closures.push_back(c);
  }
  [[nodiscard]] lanes::LoopTask task() const {
    return {.closures = closures.data(),
            .begin = 0,
            .end = static_cast<std::uint32_t>(closures.size()),
            .paths = paths.data(),
            .envelope = {left.data(), begins.data(), static_cast<std::uint32_t>(left.size())},
            .sizes = sizes};
  }
};

TEST(LoopLanes, AllInstructionSetsSayTheSame) {
  // One source, three translations, which differ by the rounding of fused products only. That closures act at
  // all is seen from what the tree does without them.
  const test::LaneTree tree{40};
  LaneLoops loops;
  loops.add(tree, JointKind::Ball, 3, 17, 38);
  loops.add(tree, JointKind::Cylindrical, 4, 25, 31);
  loops.add(tree, JointKind::Slider, 5, 39, -1);
  std::vector<double> first;
  for (const lanes::InstructionSet set : lanes::instruction_sets()) {
    lanes::LoopTask task = loops.task();
    const std::vector<double> v_dot = tree.solve(lanes::kernel_for(set), &task);
    if (first.empty()) first = v_dot;
    for (std::size_t i = 0; i < v_dot.size(); ++i) {
      EXPECT_NEAR(v_dot[i], first[i], 1e-9 * (1 + std::abs(first[i]))) << to_string(set) << ' ' << i;
    }
  }
  const std::vector<double> open = tree.solve(lanes::kernel_for(lanes::InstructionSet::Sse2));
  EXPECT_GT(std::abs(open[0] - first[0]), 1e-3);
}

/// Where bodies of `physics` are after a second by collocation with so many stages: seven are computed one
/// after the other by the scalar kernel, four and eight in lanes.
std::vector<Vector3> after_a_second(PhysicsManager physics, int stages) {
  physics.set_integrator(make_gauss({.stages = stages, .tolerance = 1e-12}));
  EXPECT_TRUE(physics.step(1).ok());
  EXPECT_LT(physics.joint_drift().distance, 1e-12);
  std::vector<Vector3> positions;
  for (const BodyId id : physics.bodies()) positions.push_back(physics.body(id).p_WBcm());
  return positions;
}

/// All stages solve the same equations to 1e-12 a second.
void expect_same_motion(const std::function<PhysicsManager()>& made) {
  const std::vector<Vector3> scalar = after_a_second(made(), 7);
  for (const int stages : {4, 8}) {
    const std::vector<Vector3> lanes = after_a_second(made(), stages);
    for (std::size_t i = 0; i < scalar.size(); ++i)
      EXPECT_LT((lanes[i] - scalar[i]).norm(), 1e-9) << stages << ' ' << i;
  }
}

class LoopLanesOf : public testing::TestWithParam<test::CutKind> {};

TEST_P(LoopLanesOf, MoveAsTheScalarKernelDoes) {
  // Springs between bodies and the world take the way through the lanes on which laws are asked.
  expect_same_motion([] {
    TwoHands t;
    GetParam().add(t);
    return std::move(t.physics);
  });
}

TEST_P(LoopLanesOf, BearSpringsMotorsAndRotorsAsTheScalarKernelDoes) {
  expect_same_motion([] {
    TwoHands t{0.05};
    GetParam().add_loaded(t);
    return std::move(t.physics);
  });
}

INSTANTIATE_TEST_SUITE_P(Kinds, LoopLanesOf, testing::ValuesIn(test::kCutKinds),
                         [](const auto& test) { return std::string{test.param.name}; });

TEST(LoopLanes, TurnAFourBarUnderUniformGravity) {
  // Redundant rows, and the way through the lanes on which gravity is the ground's acceleration.
  expect_same_motion([] { return std::move(test::FourBar{}.physics); });
}

TEST(LoopLanes, FollowAnimatedGrounds) {
  // A loop from a driven chain to a ground that sways, whose motions differ from stage to stage.
  expect_same_motion([] {
    PhysicsManager physics = test::driven_chain();
    const BodyId last = physics.bodies().back(), ground = physics.bodies().front();
    const Pose here{physics.body(last).p_WBcm() + Vector3{0.2, 0.1, 0}, Quaternion::Identity()};
    const BodyId rod = physics.add(RigidBodySettings{.X_WB = here, .mass = test::lopsided_mass()});
    physics.add(joint_here<BallSettings>(physics, last, rod, here));
    physics.add(joint_here<PlanarSettings>(physics, ground, rod, {{0.4, 0.1, 0.2}, test::facing({1, 1, 2})}));
    return physics;
  });
}

/// Slides along x and turns about z, from rest.
std::unique_ptr<Driver> starting() {
  return std::make_unique<test::FunctionDriver>([](double t, Side) {
    RigidMotion m;
    m.X_AB = {{0.3 + 0.02 * t * t, 0, 0}, Quaternion{Eigen::AngleAxisd{0.1 * t * t, Vector3::UnitZ()}}};
    m.v_AB = {0.04 * t, 0, 0}, m.a_AB = {0.04, 0, 0};
    m.w_AB = {0, 0, 0.2 * t}, m.alpha_AB = {0, 0, 0.2};
    return m;
  });
}

TEST(LoopLanes, FollowADriverThatIsCut) {
  // Between bodies on joints that wheels outside the loop are coupled to, so that these stay in the tree.
  const auto made = [] {
    PhysicsManager physics;
    physics.forces().add(Gravity{.g_W = {0.02, -0.03, -0.1}});
    const auto body = [&](const Vector3& at) {
      return physics.add(RigidBodySettings{.X_WB = {at}, .mass = test::lopsided_mass()});
    };
    const BodyId a = body({0, 0, 0}), b = body({0.3, 0, 0}), c = body({0.6, 0.3, 0.1}),
                 wheel = body({2, 0, 0});
    const auto joint = [&]<class Settings>(Settings, BodyId x, BodyId y, const Vector3& at,
                                           const Vector3& z) {
      return physics.add(joint_here<Settings>(physics, x, y, {at, test::facing(z)}));
    };
    const JointId one = joint(PlanarSettings{}, {}, a, {0, 0.2, 0.1}, {1, 0, 1});
    const JointId two = joint(UniversalSettings{}, b, c, {0.4, 0.2, 0}, {0, 1, 1});
    const JointId three = joint(PlanarSettings{}, {}, c, {0.7, 0.3, 0.2}, {-1, 1, 1});
    const JointId axle = joint(PivotSettings{}, {}, wheel, {2, 0, 0.1}, {0, 1, 0});
    const JointId other = joint(PivotSettings{}, {}, body({3, 0, 0}), {3, 0, 0.1}, {0, 1, 0});
    physics.add(DrivenSettings{.name = "arm", .a = a, .b = b, .driver = starting()});
    physics.add(GearSettings{.a = one, .axis_a = 2, .b = axle, .ratio = 0.5});
    physics.add(GearSettings{.a = two, .axis_a = 0, .b = axle, .ratio = 0.8});
    physics.add(GearSettings{.a = three, .axis_a = 0, .b = other, .ratio = 0.7});
    return physics;
  };
  expect_same_motion(made);
}

TEST(LoopLanes, CoupleJointsAsTheScalarKernelDoes) {
  // Two pendulums, and a planar joint that the tree sees from its other side, whose numbers change with each
  // other.
  expect_same_motion([] { return std::move(test::Pendulums{-0.7, 0.2}.physics); });
  expect_same_motion([] {
    PhysicsManager physics;
    physics.forces().add(Gravity{.g_W = {1, -3, -2}});
    std::vector<JointId> joints;
    for (const double x : {0.0, 1.0}) {
      const BodyId arm = physics.add(RigidBodySettings{.X_WB = {{x, 0, 0}}, .mass = test::lopsided_mass()});
      const BodyId tip =
          physics.add(RigidBodySettings{.X_WB = {{x + 0.1, 0.3, 0}}, .mass = test::lopsided_mass(0.7)});
      physics.add(joint_here<PivotSettings>(physics, BodyId{}, arm, {{x, 0, 0}, test::facing({0, 1, 0})}));
      joints.push_back(physics.add(
          joint_here<PlanarSettings>(physics, tip, arm, {{x + 0.1, 0.2, 0.1}, test::facing({1, x, 2})})));
    }
    physics.add(GearSettings{.a = joints[0], .axis_a = 1, .b = joints[1], .axis_b = 2, .ratio = -1.3});
    return physics;
  });
}

}  // namespace
}  // namespace pantin

#include <pantin/physics/constraints/spanning_tree.hpp>

#include <gtest/gtest.h>

#include <algorithm>

#include <pantin/physics/constraints/planar.hpp>
#include <pantin/physics/constraints/tree.hpp>

#include "support/mechanisms.hpp"

namespace pantin {
namespace {

/// Bodies 0 to n - 1, simulated, and joints between them (-1 = the world).
struct Graph {
  BodyStore bodies{};
  std::vector<BodyId> ids{};
  std::vector<JointDefinition> joints{};

  explicit Graph(int n) {
    for (int i = 0; i < n; ++i)
      ids.push_back(bodies.add(RigidBodySettings{.mass = test::lopsided_mass()}, 0));
  }
  void join(int a, int b, JointKind kind = JointKind::Pivot) {
    JointDefinition joint;
    joint.kind = kind;
    if (a >= 0) joint.a = ids[static_cast<std::size_t>(a)];
    joint.b = ids[static_cast<std::size_t>(b)];
    joints.push_back(std::move(joint));
  }
  [[nodiscard]] std::vector<const JointDefinition*> list() const {
    std::vector<const JointDefinition*> out;
    for (const JointDefinition& joint : joints) out.push_back(&joint);
    return out;
  }
  [[nodiscard]] std::vector<std::uint8_t> cut() const { return span_trees(bodies, list()).is_cut; }
};

using Cut = std::vector<std::uint8_t>;

TEST(SpanningTree, CutsNothingWhereThereAreNoLoops) {
  // A chain on the ground and a floating pair.
  Graph g{4};
  g.join(-1, 0), g.join(0, 1), g.join(2, 3);
  EXPECT_EQ(g.cut(), (Cut{0, 0, 0}));
  EXPECT_FALSE(span_trees(g.bodies, g.list()).has_loops());
}

TEST(SpanningTree, CutsTheJointWithTheFewestRows) {
  // A ring of pivots, a ball and a fixed joint: the ball's three rows are the cheapest.
  Graph g{3};
  g.join(-1, 0), g.join(0, 1, JointKind::Ball), g.join(1, 2, JointKind::Fixed), g.join(-1, 2);
  EXPECT_EQ(g.cut(), (Cut{0, 1, 0, 0}));
}

TEST(SpanningTree, CutsFarFromTheGround) {
  // Of equal joints in a ring of five bodies from the ground the one in the middle: trees two and three deep.
  Graph g{5};
  for (int i = 0; i < 5; ++i) g.join(i - 1, i);
  g.join(-1, 4);
  const Cut cut = g.cut();
  EXPECT_EQ(cut, (Cut{0, 0, 0, 1, 0, 0}));
}

TEST(SpanningTree, CutsAFloatingRing) {
  // No ground: the ring opens opposite to where it starts, and stays one tree with a free root.
  Graph g{4};
  g.join(0, 1), g.join(1, 2), g.join(2, 3), g.join(3, 0);
  const TreeLayout layout = lay_out(g.bodies, g.list());
  ASSERT_EQ(layout.trees.size(), 1u);
  EXPECT_EQ(layout.closures.size(), 1u);
  EXPECT_EQ(layout.links.size(), 4u);
  EXPECT_EQ(layout.rates, 6u + 3u);
}

TEST(SpanningTree, CountsTheWorldAndStaticBodiesAsOne) {
  // Two ways from one body to two bodies that stand still close a loop; separate bodies on them do not.
  Graph g{4};
  g.bodies.kinds[2] = g.bodies.kinds[3] = BodyKind::Static;
  g.join(2, 0), g.join(3, 0), g.join(3, 1);
  EXPECT_EQ(g.cut(), (Cut{0, 1, 0}));
}

TEST(SpanningTree, LaysTreesThatALoopJoinsOutAsOne) {
  // Two pendulums tied at their ends move together: one range of links, two roots, paths down to both.
  Graph g{2};
  g.join(-1, 0), g.join(-1, 1), g.join(0, 1, JointKind::Ball);
  const TreeLayout layout = lay_out(g.bodies, g.list());
  ASSERT_EQ(layout.trees.size(), 1u);
  ASSERT_EQ(layout.closures.size(), 1u);
  EXPECT_EQ(layout.closures[0].rows, 3u);
  EXPECT_EQ(layout.closures[0].path_end - layout.closures[0].path_begin, 2u);
  EXPECT_EQ(layout.closures[0].path_rates, 2u);
}

TEST(SpanningTree, KnowsTheRowsOfEveryKind) {
  // Six less the freedoms (Kutzbach).
  EXPECT_EQ(row_count(JointKind::Pivot), 5);
  EXPECT_EQ(row_count(JointKind::Slider), 5);
  EXPECT_EQ(row_count(JointKind::Ball), 3);
  EXPECT_EQ(row_count(JointKind::Fixed), 6);
  EXPECT_EQ(row_count(JointKind::Cylindrical), 4);
  EXPECT_EQ(row_count(JointKind::Universal), 4);
  EXPECT_EQ(row_count(JointKind::Planar), 3);
  EXPECT_EQ(row_count(JointKind::Screw), 5);
}

TEST(SpanningTree, CutsCoupledJointsLast) {
  // Of a ring with a ball, two pivots and a fixed joint the ball would be cut: with the pivots coupled it
  // still is; without a ball, it is the fixed joint, though it has the most rows. Where all are coupled, one
  // is cut.
  Graph g{3};
  g.join(-1, 0), g.join(0, 1, JointKind::Ball), g.join(1, 2, JointKind::Fixed), g.join(-1, 2);
  const auto cut = [](const Graph& graph, std::vector<JointCoupling> couplings) {
    return span_trees(graph.bodies, graph.list(), couplings).is_cut;
  };
  EXPECT_EQ(cut(g, {{.a = 0, .b = 3}}), (Cut{0, 1, 0, 0}));
  Graph h{3};
  h.join(-1, 0), h.join(0, 1), h.join(1, 2, JointKind::Fixed), h.join(-1, 2);
  EXPECT_EQ(cut(h, {{.a = 0, .b = 3}, {.a = 1, .b = 3}}), (Cut{0, 0, 1, 0}));
  Graph all{2};
  all.join(-1, 0), all.join(0, 1), all.join(-1, 1);
  const Cut one = cut(all, {{.a = 0, .b = 1}, {.a = 1, .b = 2}});
  EXPECT_EQ(std::count(one.begin(), one.end(), 1), 1);
}

TEST(SpanningTree, MakesOneMechanismOfWhatIsCoupled) {
  // A chain on the ground and a floating pair, coupled, are one tree with two roots; a third one is its own.
  Graph g{6};
  g.join(-1, 0), g.join(0, 1), g.join(2, 3), g.join(4, 5);
  const std::vector<JointCoupling> couplings{{.a = 1, .b = 2, .ratio = 2}};
  const TreeLayout layout = lay_out(g.bodies, g.list(), couplings);
  ASSERT_EQ(layout.trees.size(), 2u);
  EXPECT_EQ(layout.trees[0].links_end - layout.trees[0].links_begin, 4u);
  EXPECT_TRUE(layout.trees[0].has_closures());
  EXPECT_FALSE(layout.trees[1].has_closures());
  ASSERT_EQ(layout.closures.size(), 1u);
  EXPECT_EQ(layout.closures[0].path_end - layout.closures[0].path_begin, 4u) << "all links move by it";
  EXPECT_EQ(layout.closure_of_coupling, (std::vector<std::int32_t>{0}));
}

}  // namespace
}  // namespace pantin

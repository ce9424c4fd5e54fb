#include <pantin/physics/islands.hpp>

#include <gtest/gtest.h>

#include <pantin/physics/forces/central_attraction.hpp>
#include <pantin/physics/forces/damped_spring.hpp>
#include <pantin/physics/forces/force_function.hpp>
#include <pantin/physics/forces/linear_drag.hpp>
#include <pantin/physics/forces/particle_springs.hpp>
#include <pantin/physics/forces/torsion_spring.hpp>
#include <pantin/physics/forces/wind.hpp>
#include <pantin/physics/integrators/dormand_prince.hpp>

#include "support/mechanisms.hpp"

namespace pantin {
namespace {

using Bodies = std::vector<BodyId>;

/// Bodies that hang on pivots of their own, so that each is an island that goes by itself.
struct Row {
  explicit Row(int count) {
    physics.forces().add(Gravity{});
    physics.set_integrator(make_dormand_prince({.tolerance = 1e-8}));
    for (int i = 0; i < count; ++i) {
      const Vector3 p{1.0 * i, 0, 0};
      ids.push_back(physics.add({.X_WB = {p}, .mass = test::lopsided_mass()}));
      pivots.push_back(physics.add(test::joint_here<PivotSettings>(physics, {}, ids.back(), {p})));
    }
  }
  std::vector<Bodies> islands() {
    std::vector<Bodies> list;
    for (const IslandGroup& group : physics.islands()) list.push_back(group.bodies);
    return list;
  }
  PhysicsManager physics;
  Bodies ids;
  std::vector<JointId> pivots;
};

TEST(Islands, MergeAndSplitAsJointsAndLawsComeAndGo) {
  // What couples two bodies makes one island of theirs, and leaves two when it goes.
  Row row{3};
  const Bodies& b = row.ids;
  const std::vector<Bodies> apart{{b[0]}, {b[1]}, {b[2]}};
  EXPECT_EQ(row.islands(), apart);
  const ForceId spring = row.physics.forces().add(DampedSpring{.a = {b[2]}, .b = {b[0]}, .stiffness = 1});
  EXPECT_EQ(row.islands(), (std::vector<Bodies>{{b[0], b[2]}, {b[1]}}));
  const ForceId twist = row.physics.forces().add(TorsionSpring{.a = b[1], .b = b[2], .stiffness = 1});
  EXPECT_EQ(row.islands(), (std::vector<Bodies>{{b[0], b[1], b[2]}}));
  row.physics.forces().remove(spring);
  EXPECT_EQ(row.islands(), (std::vector<Bodies>{{b[0]}, {b[1], b[2]}}));
  row.physics.forces().remove(twist);
  EXPECT_EQ(row.islands(), apart);
  const JointId ball =
      row.physics.add(test::joint_here<BallSettings>(row.physics, b[0], b[1], {{0.5, 0, 0}}, "loop"));
  EXPECT_EQ(row.islands(), (std::vector<Bodies>{{b[0], b[1]}, {b[2]}}));
  row.physics.remove(ball);
  EXPECT_EQ(row.islands(), apart);
}

TEST(Islands, AreNotCoupledThroughWhatIsNotSimulated) {
  // A body that stands still feels nothing: springs to it do not make their other ends feel each other.
  Row row{3};
  const Bodies& b = row.ids;
  row.physics.forces().add(DampedSpring{.a = {b[0]}, .b = {b[1]}, .stiffness = 1});
  row.physics.forces().add(DampedSpring{.a = {b[1]}, .b = {b[2]}, .stiffness = 1});
  EXPECT_EQ(row.islands().size(), 1u);
  row.physics.make_static(b[1]);
  EXPECT_EQ(row.islands(), (std::vector<Bodies>{{b[0]}, {b[2]}}));
  row.physics.make_simulated(b[1]);
  EXPECT_EQ(row.islands().size(), 1u);
}

TEST(Islands, AreWhatLawsSayThatTheyCouple) {
  // Drag and wind act on each body by itself; a centre feels all that it pulls; of a function nothing is
  // known but what it says.
  struct Case {
    std::function<void(Row&)> add;
    std::size_t islands;
  };
  const ForceFunction function{.on_body = [](const BodiesAt&, std::size_t) { return Wrench{}; }};
  const auto with = [&](bool couples, BodyId body) {
    ForceFunction one = function;
    one.couples_bodies = couples;
    one.body = body;
    return one;
  };
  const Case cases[] = {
      {[](Row& r) { r.physics.forces().add(LinearDrag{.coefficient = 1}); }, 3},
      {[](Row& r) { r.physics.forces().add(LinearDrag{.body = r.ids[1], .coefficient = 1}); }, 3},
      {[](Row& r) {
         r.physics.forces().add(Wind{.mean = {1, 0, 0}, .linear_drag = 1});
       },
       3},
      {[](Row& r) {
         r.physics.forces().add(CentralAttraction{.centre = {.p_BQ = {0, 0, 5}}, .mu = 1});
       },
       3},
      {[](Row& r) { r.physics.forces().add(CentralAttraction{.centre = {r.ids[0]}, .mu = 1}); }, 1},
      {[](Row& r) {
         r.physics.make_static(r.physics.add({.X_WB = {{0, 0, 9}}, .mass = test::lopsided_mass()}));
         r.physics.forces().add(CentralAttraction{.centre = {r.physics.bodies().back()}, .mu = 1});
       },
       3},
      {[](Row& r) {
         r.physics.forces().add(CentralAttraction{.centre = {r.ids[0]}, .mu = 1, .body = r.ids[2]});
       },
       2},
      {[&](Row& r) { r.physics.forces().add(with(true, {})); }, 1},
      {[&](Row& r) { r.physics.forces().add(with(true, r.ids[0])); }, 1},
      {[&](Row& r) { r.physics.forces().add(with(false, {})); }, 3},
  };
  for (std::size_t i = 0; i < std::size(cases); ++i) {
    Row row{3};
    cases[i].add(row);
    EXPECT_EQ(row.islands().size(), cases[i].islands) << "case " << i;
    EXPECT_TRUE(row.physics.step(1e-3).ok()) << "case " << i;
  }
}

TEST(Islands, AreAllOneUnderALawThatDoesNotSay) {
  // The user's own law may look at any body: nothing is taken apart unless it says so.
  class Silent final : public ForceLaw {
    void add_wrenches(const BodiesAt&, std::span<Wrench>) const override {}
  };
  Row row{3};
  row.physics.forces().add_law(std::make_unique<Silent>());
  EXPECT_EQ(row.islands(), (std::vector<Bodies>{row.ids}));
}

TEST(Islands, AreJoinedByTheParticlesThatLawsCoupleThemWith) {
  // Springs from particles of one system to two bodies: all of them feel each other.
  Row row{3};
  ParticleManager& particles = row.physics.particles();
  const ParticleSystemId system = particles.add(ParticleSystemSettings{});
  ParticleSprings springs;
  for (const int i : {0, 2}) {
    springs.springs.push_back({.a = particles.add_particle(system, {.p_WP = {1.0 * i, 1, 0}}),
                               .anchor = {row.ids[static_cast<std::size_t>(i)]},
                               .stiffness = 1});
  }
  row.physics.forces().add(springs);
  const std::vector<IslandGroup> groups = row.physics.islands();
  ASSERT_EQ(groups.size(), 2u);
  EXPECT_EQ(groups[0].bodies, (Bodies{row.ids[0], row.ids[2]}));
  EXPECT_TRUE(groups[0].has_particles);
  EXPECT_FALSE(groups[1].has_particles);
}

TEST(Islands, GoTogetherWhereTheirStepsAreGivenOrTheyAreMany) {
  // One integrator in steps that are given costs least on all at once; so do many islands under one that
  // chooses. Free bodies that no law names go together at any number.
  Row few{3};
  EXPECT_EQ(few.physics.islands().size(), 3u);
  few.physics.set_integrator(make_integrator("rk4"));
  ASSERT_EQ(few.physics.islands().size(), 1u);
  EXPECT_EQ(few.physics.islands().front().bodies, few.ids);

  Row many{33};
  ASSERT_EQ(many.physics.islands().size(), 1u);
  EXPECT_NE(many.physics.islands().front().reason.find("more than 32"), std::string::npos);
  many.physics.remove(many.ids.back());
  EXPECT_EQ(many.physics.islands().size(), 32u);

  Row with_free{2};
  for (int i = 0; i < 40; ++i) {
    with_free.physics.add({.X_WB = {{0, 1.0 * i, 0}}, .mass = test::lopsided_mass()});
  }
  const std::vector<IslandGroup> groups = with_free.physics.islands();
  ASSERT_EQ(groups.size(), 3u);
  EXPECT_EQ(groups[2].bodies.size(), 40u);
  EXPECT_EQ(groups[2].reason, "free bodies that no law names");
}

TEST(Islands, TakeTheIntegratorThatWasSetLastForOneOfTheirBodies) {
  // Islands that merge may have been given different integrators: the last word counts, and the reason says
  // whose it was.
  Row row{3};
  PhysicsManager& physics = row.physics;
  physics.set_integrator(row.ids[0], make_integrator("radau"));
  physics.set_integrator(row.ids[2], make_integrator("verlet"));
  EXPECT_EQ(physics.islands()[0].integrator, "radau");
  EXPECT_EQ(physics.islands()[1].integrator, "dormand-prince");
  EXPECT_EQ(physics.islands()[2].integrator, "verlet");
  physics.forces().add(DampedSpring{.a = {row.ids[0]}, .b = {row.ids[2]}, .stiffness = 1});
  EXPECT_EQ(physics.islands()[0].integrator, "verlet");
  physics.set_integrator(row.ids[0], make_integrator("rk4"));
  EXPECT_EQ(physics.islands()[0].integrator, "rk4");
  EXPECT_EQ(physics.islands()[0].reason, "asked for by body ''");
  physics.set_integrator(row.ids[0], nullptr);
  EXPECT_EQ(physics.islands()[0].integrator, "verlet");
  physics.remove(row.ids[2]);
  EXPECT_EQ(physics.islands()[0].integrator, "dormand-prince");
}

}  // namespace
}  // namespace pantin

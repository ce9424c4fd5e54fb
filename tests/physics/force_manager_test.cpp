#include <pantin/physics/forces/force_manager.hpp>

#include <cmath>
#include <random>

#include <gtest/gtest.h>
#include <support/allocation_guard.hpp>
#include <support/contracts.hpp>
#include <support/hand_made_bodies.hpp>

#include <pantin/physics/forces/constant_load.hpp>
#include <pantin/physics/forces/damped_spring.hpp>
#include <pantin/physics/forces/gravity.hpp>
#include <pantin/physics/forces/linear_drag.hpp>

// A law of a user: a pull towards the origin that swells with time. Settings, problem_with, make_law, as the
// header says; in a namespace of its own, as a user's code is.
namespace tide {

struct Tide {
  double strength{1};  ///< [N/m]
  double omega{1};     ///< [rad/s]
};

std::optional<pantin::SettingsProblem> problem_with(const Tide& settings) {
  if (settings.strength >= 0) return std::nullopt;
  return pantin::SettingsProblem{pantin::ProblemCode::OutOfRange, "tide: strength is negative",
                                 "give another"};
}

class TideLaw final : public pantin::ForceLaw {
 public:
  explicit TideLaw(const Tide& settings) : settings_{settings} {}
  void add_wrenches(const pantin::BodiesAt& at, std::span<pantin::Wrench> wrenches) const override {
    const double k = settings_.strength * std::cos(settings_.omega * at.t);
    for (std::size_t i = 0; i < at.size(); ++i) wrenches[i].force -= k * at.kinematics[i].p_WBcm;
  }

 private:
  Tide settings_;
};

std::unique_ptr<pantin::ForceLaw> make_law(const Tide& settings) {
  return std::make_unique<TideLaw>(settings);
}

}  // namespace tide

namespace pantin {
namespace {

using test::near;

TEST(ForceManager, GathersTheSumOfAllLaws) {
  // The sum of what each law adds alone, on top of what the wrenches held; likewise the energy.
  std::mt19937_64 random{20};
  test::HandMadeBodies bodies;
  const BodyId a = bodies.add_random(random), b = bodies.add_random(random);
  const DampedSpring spring{.a = {a}, .b = {b}, .stiffness = 3, .damping = 1};
  ForceManager forces;
  forces.add(Gravity{});
  forces.add(spring);
  std::vector<Wrench> gathered(2, Wrench{{1, 1, 1}, {2, 2, 2}});
  forces.gather(bodies.at(), gathered);
  const std::vector<Wrench> pull = test::wrenches_of(*make_law(Gravity{}), bodies);
  const std::vector<Wrench> tension = test::wrenches_of(*make_law(spring), bodies);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_TRUE(
        near(gathered[i].force, Vector3{Vector3::Ones() + pull[i].force + tension[i].force}, 1e-14, 10));
    EXPECT_TRUE(near(gathered[i].torque, Vector3{Vector3{2, 2, 2} + tension[i].torque}, 1e-14, 10));
  }
  EXPECT_DOUBLE_EQ(forces.potential_energy(bodies.at()), make_law(Gravity{})->potential_energy(bodies.at()) +
                                                             make_law(spring)->potential_energy(bodies.at()));
}

TEST(ForceManager, TakesALawOfTheUserByItsSettingsOrAsAnObject) {
  // 2 cos(3 t) times the distance, twice: once found through the settings' namespace, once added as an
  // object.
  test::HandMadeBodies bodies;
  bodies.add({}, {.p_WBcm = {1, 2, 3}});
  ForceManager forces;
  forces.add(tide::Tide{.strength = 2, .omega = 3});
  forces.add_law(std::make_unique<tide::TideLaw>(tide::Tide{.strength = 2, .omega = 3}));
  std::vector<Wrench> wrenches(1);
  forces.gather(bodies.at(0.5), wrenches);
  EXPECT_TRUE(near(wrenches[0].force, -4 * std::cos(1.5) * Vector3{1, 2, 3}, 1e-15, 4));
}

TEST(ForceManager, RemovesALawAndKnowsItsIdNoMore) {
  // Ids are never used again: not even a law added in the place of the removed one answers to the old id.
  ForceManager forces;
  const ForceId first = forces.add(Gravity{}), second = forces.add(Gravity{.g_W = {1, 0, 0}});
  EXPECT_NE(first, second);
  EXPECT_TRUE(forces.contains(first));
  forces.remove(first);
  EXPECT_FALSE(forces.contains(first));
  EXPECT_TRUE(forces.contains(second));
  const ForceId third = forces.add(Gravity{});
  EXPECT_NE(third, first);
  EXPECT_FALSE(forces.contains(first));
  EXPECT_EQ(forces.size(), 2U);
  EXPECT_FALSE(forces.contains(ForceId{}));
  test::HandMadeBodies bodies;
  bodies.add({}, {});
  forces.remove(third);
  std::vector<Wrench> wrenches(1);
  forces.gather(bodies.at(), wrenches);
  EXPECT_EQ(wrenches[0].force, Vector3::UnitX());
}

TEST(ForceManager, RemovesTheLawsThatNameABody) {
  // Spring and load name it, the drag of another body and gravity do not.
  const BodyId gone{.index = 1, .generation = 1}, other{.index = 2, .generation = 1};
  ForceManager forces;
  const ForceId gravity = forces.add(Gravity{});
  forces.add(DampedSpring{.a = {other}, .b = {gone}});
  forces.add(ConstantLoad{.body = gone});
  const ForceId drag = forces.add(LinearDrag{.body = other});
  EXPECT_EQ(forces.remove_laws_of(gone), 2U);
  EXPECT_EQ(forces.size(), 2U);
  EXPECT_TRUE(forces.contains(gravity));
  EXPECT_TRUE(forces.contains(drag));
  EXPECT_EQ(forces.remove_laws_of(gone), 0U);
}

TEST(ForceManager, DependsOnVelocityWhereOneLawDoes) {
  // A disjunction over the laws, false for none.
  ForceManager forces;
  EXPECT_FALSE(forces.depends_on_velocity());
  forces.add(Gravity{});
  EXPECT_FALSE(forces.depends_on_velocity());
  const ForceId drag = forces.add(LinearDrag{.coefficient = 1});
  EXPECT_TRUE(forces.depends_on_velocity());
  forces.remove(drag);
  EXPECT_FALSE(forces.depends_on_velocity());
}

TEST(ForceManager, AllocatesNothingWhileItGathers) {
  // All built-in laws at once, wrenches and energies: counted from the first call on.
  std::mt19937_64 random{21};
  test::HandMadeBodies bodies;
  const BodyId a = bodies.add_random(random), b = bodies.add_random(random);
  ForceManager forces;
  forces.add(Gravity{});
  forces.add(ConstantLoad{.body = a, .force = {1, 2, 3}, .axes = LoadAxes::Body});
  forces.add(LinearDrag{.coefficient = 1});
  forces.add(DampedSpring{.a = {a}, .b = {b}, .stiffness = 1, .damping = 1});
  std::vector<Wrench> wrenches(2);
  const test::AllocationGuard guard;
  forces.gather(bodies.at(), wrenches);
  const double energy = forces.potential_energy(bodies.at());
  EXPECT_EQ(guard.count(), 0U);
  EXPECT_TRUE(std::isfinite(energy));
}

/// Runs `call` and returns the text of the contract that it broke; empty if none.
template <class Call>
std::string broken_contract(const Call& call) {
  const test::ThrowOnContract guard;
  try {
    call();
  } catch (const test::ContractError& error) {
    return error.what();
  }
  return {};
}

TEST(ForceManagerContract, RefusesSettingsWithAProblem) {
  // The text and remedy of problem_with, for built-in settings and those of a user alike.
  ForceManager forces;
  const BodyId body{.index = 1, .generation = 1};
  EXPECT_NE(broken_contract([&] {
              forces.add(DampedSpring{.a = {body}, .stiffness = -1});
            }).find("damped spring: stiffness is -1 N/m; it must be zero or more; give a stiffness"),
            std::string::npos);
  EXPECT_NE(
      broken_contract([&] { forces.add(tide::Tide{.strength = -1}); }).find("tide: strength is negative"),
      std::string::npos);
  EXPECT_EQ(forces.size(), 0U);
}

TEST(ForceManagerContract, RefusesANullLaw) {
  // There is nothing to own.
  ForceManager forces;
  EXPECT_NE(broken_contract([&] { forces.add_law(nullptr); }).find("the law is null"), std::string::npos);
}

TEST(ForceManagerContract, RefusesToRemoveADeadId) {
  // Null, and one that was removed.
  ForceManager forces;
  const ForceId id = forces.add(Gravity{});
  forces.remove(id);
  EXPECT_NE(broken_contract([&] { forces.remove(id); }).find("force 1 is null or was removed"),
            std::string::npos);
  EXPECT_NE(broken_contract([&] { forces.remove({}); }).find("force 0 is null or was removed"),
            std::string::npos);
}

TEST(ForceManagerContract, RefusesTheNullBody) {
  // The null body is the world, which stays.
  ForceManager forces;
  EXPECT_NE(broken_contract([&] { forces.remove_laws_of({}); }).find("the body is null"), std::string::npos);
}

TEST(ForceManagerContract, RefusesWrenchesOfAnotherNumber) {
  // One wrench a body; fewer would be written past their end.
  ForceManager forces;
  test::HandMadeBodies bodies;
  bodies.add({}, {});
  std::vector<Wrench> none;
  EXPECT_NE(broken_contract([&] { forces.gather(bodies.at(), none); }).find("0 wrenches for 1 bodies"),
            std::string::npos);
}

}  // namespace
}  // namespace pantin

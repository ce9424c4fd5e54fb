#include <pantin/physics/forces/wrench_derivatives.hpp>

#include <functional>
#include <memory>
#include <string>

#include <gtest/gtest.h>
#include <support/finite_differences.hpp>
#include <support/hand_made_bodies.hpp>

#include <pantin/physics/forces/buoyancy.hpp>
#include <pantin/physics/forces/central_attraction.hpp>
#include <pantin/physics/forces/constant_load.hpp>
#include <pantin/physics/forces/damped_spring.hpp>
#include <pantin/physics/forces/force_function.hpp>
#include <pantin/physics/forces/force_manager.hpp>
#include <pantin/physics/forces/gravity.hpp>
#include <pantin/physics/forces/linear_drag.hpp>
#include <pantin/physics/forces/magnetic_field.hpp>
#include <pantin/physics/forces/quadratic_drag.hpp>
#include <pantin/physics/forces/radial_field.hpp>
#include <pantin/physics/forces/torsion_spring.hpp>
#include <pantin/physics/forces/uniform_field.hpp>
#include <pantin/physics/forces/wind.hpp>

namespace pantin {
namespace {

using test::near;
using Wide = Eigen::MatrixXd;  ///< six rows and twelve columns a body

/// Three bodies in any state and a law that names the first two, or none.
struct Case {
  std::string name{};
  std::function<std::unique_ptr<ForceLaw>(BodyId a, BodyId b)> law{};
};

const Vector3 kPoint{0.3, -0.2, 0.5}, kOther{-0.4, 0.1, 0.2}, kAxis{0.6, 0, 0.8};

std::vector<Case> cases() {
  const Quaternion rest{Eigen::AngleAxisd{0.4, kAxis}};
  return {
      {"Gravity", [](BodyId, BodyId) { return make_law(Gravity{}); }},
      {"ConstantLoadInTheWorld",
       [](BodyId a, BodyId) {
         return make_law(ConstantLoad{.body = a, .force = {3, -1, 2}, .torque = {1, 0, 4}, .p_BQ = kPoint});
       }},
      {"ConstantLoadInTheBody",
       [](BodyId a, BodyId) {
         return make_law(ConstantLoad{
             .body = a, .force = {3, -1, 2}, .torque = {1, 0, 4}, .p_BQ = kPoint, .axes = LoadAxes::Body});
       }},
      {"LinearDrag",
       [](BodyId, BodyId) {
         return make_law(LinearDrag{.coefficient = 3, .angular_coefficient = 2, .medium_velocity = kPoint});
       }},
      {"LinearDragOfOne", [](BodyId, BodyId b) { return make_law(LinearDrag{.body = b, .coefficient = 3}); }},
      {"QuadraticDrag",
       [](BodyId, BodyId) {
         return make_law(
             QuadraticDrag{.coefficient = 3, .angular_coefficient = 2, .medium_velocity = kPoint});
       }},
      {"DampedSpring",
       [](BodyId a, BodyId b) {
         return make_law(DampedSpring{{a, kPoint}, {b, kOther}, 50, 3, 0.8});
       }},
      {"DampedSpringToTheWorld",
       [](BodyId a, BodyId) {
         return make_law(DampedSpring{{{}, kPoint}, {a, kOther}, 50, 3, 0.8});
       }},
      {"TorsionSpring",
       [rest](BodyId a, BodyId b) {
         return make_law(TorsionSpring{.a = a, .b = b, .q_AB = rest, .stiffness = 20, .damping = 3});
       }},
      {"TorsionSpringAboutAnAxis",
       [rest](BodyId a, BodyId b) {
         return make_law(
             TorsionSpring{.a = a, .b = b, .q_AB = rest, .axis_A = kAxis, .stiffness = 20, .damping = 3});
       }},
      {"TorsionSpringFromTheWorld",
       [](BodyId, BodyId b) {
         return make_law(TorsionSpring{.b = b, .axis_A = kAxis, .stiffness = 20, .damping = 3});
       }},
      {"TorsionSpringToTheWorld",
       [](BodyId a, BodyId) { return make_law(TorsionSpring{.a = a, .stiffness = 20, .damping = 3}); }},
      {"CentralAttraction",
       [](BodyId, BodyId) {
         return make_law(CentralAttraction{.centre = {{}, kPoint}, .mu = 7});
       }},
      {"CentralAttractionOfABody",
       [](BodyId a, BodyId) {
         return make_law(CentralAttraction{.centre = {a, kPoint}, .mu = 7, .softening = 0.3});
       }},
      {"MagneticField",
       [](BodyId, BodyId) {
         return make_law(MagneticField{.field_W = {1, 2, 3}, .charge = 0.7});
       }},
      {"Wind",
       [](BodyId, BodyId) {
         return make_law(Wind{.mean = {3, 0, 1}, .linear_drag = 0.5, .quadratic_drag = 2});
       }},
      {"UniformField",
       [](BodyId, BodyId) {
         return make_law(UniformField{.field_W = {1, 2, 3}});
       }},
      {"RadialField",
       [](BodyId, BodyId) {
         return make_law(RadialField{.centre = kPoint, .strength = -4, .exponent = 1.5, .softening = 0.2});
       }},
  };
}

/// Wrenches as one column.
Eigen::VectorXd stacked(const ForceLaw& law, const test::HandMadeBodies& bodies) {
  const std::vector<Wrench> wrenches = test::wrenches_of(law, bodies);
  Eigen::VectorXd out(6 * static_cast<Eigen::Index>(wrenches.size()));
  for (std::size_t i = 0; i < wrenches.size(); ++i)
    out.segment<6>(6 * static_cast<Eigen::Index>(i)) << wrenches[i].force, wrenches[i].torque;
  return out;
}

/// By what motions of bodies change: position, turn, velocity, spin.
Wide by_differences(const ForceLaw& law, const test::HandMadeBodies& bodies) {
  const auto n = static_cast<Eigen::Index>(bodies.bodies.size());
  Wide out(6 * n, 12 * n);
  for (Eigen::Index j = 0; j < 12 * n; ++j) {
    const Vector3 axis = Vector3::Unit(j % 3);
    out.col(j) = test::first_difference(
        [&](double x) {
          test::HandMadeBodies moved = bodies;
          BodyKinematics& body = moved.bodies[static_cast<std::size_t>(j / 12)];
          if (j % 12 / 3 == 0) body.p_WBcm += x * axis;
          if (j % 12 / 3 == 1) body.R_WB = Eigen::AngleAxisd{x, axis} * body.R_WB;
          if (j % 12 / 3 == 2) body.v_WBcm += x * axis;
          if (j % 12 / 3 == 3) body.w_WB += x * axis;
          return stacked(law, moved);
        },
        0, 1e-3);
  }
  return out;
}

Wide summed(const WrenchDerivatives& derivatives, std::size_t bodies) {
  const auto n = static_cast<Eigen::Index>(bodies);
  Wide out = Wide::Zero(6 * n, 12 * n);
  for (const WrenchDerivative& part : derivatives.parts()) {
    const Eigen::Index row = 6 * part.on, column = 12 * part.by;
    const ByMotion* rows[] = {&part.force, &part.torque};
    for (Eigen::Index r = 0; r < 2; ++r) {
      out.block<3, 3>(row + 3 * r, column) += rows[r]->position;
      out.block<3, 3>(row + 3 * r, column + 3) += rows[r]->turn;
      out.block<3, 3>(row + 3 * r, column + 6) += rows[r]->velocity;
      out.block<3, 3>(row + 3 * r, column + 9) += rows[r]->spin;
    }
  }
  return out;
}

class StatedDerivatives : public testing::TestWithParam<Case> {};

TEST_P(StatedDerivatives, AreThoseOfTheWrenches) {
  // Against central differences of sixth order of the law's own wrenches, along every motion of every body.
  std::mt19937_64 random{23};
  for (int round = 0; round < 20; ++round) {
    test::HandMadeBodies bodies;
    const BodyId a = bodies.add_random(random), b = bodies.add_random(random);
    bodies.add_random(random);
    const std::unique_ptr<ForceLaw> law = GetParam().law(a, b);
    WrenchDerivatives derivatives;
    ASSERT_TRUE(law->add_derivatives(bodies.at(), derivatives));
    Wide expected = by_differences(*law, bodies);
    const double size = std::max(1.0, expected.cwiseAbs().maxCoeff());
    EXPECT_LT((summed(derivatives, 3) - expected).cwiseAbs().maxCoeff(), 1e-8 * size) << round;
  }
}

INSTANTIATE_TEST_SUITE_P(Laws, StatedDerivatives, testing::ValuesIn(cases()),
                         [](const auto& test) { return test.param.name; });

TEST(WrenchDerivatives, AreZeroForBodiesThatAreNotSimulatedWhereALawActsOnAll) {
  // What is left out is what nobody asks for.
  std::mt19937_64 random{5};
  test::HandMadeBodies bodies;
  bodies.add_random(random, BodyKind::Static);
  bodies.add_random(random);
  WrenchDerivatives derivatives;
  ASSERT_TRUE(make_law(LinearDrag{.coefficient = 2})->add_derivatives(bodies.at(), derivatives));
  ASSERT_EQ(derivatives.parts().size(), 1u);
  EXPECT_EQ(derivatives.parts()[0].on, 1u);
}

TEST(WrenchDerivatives, OfASpringWithoutLengthAreItsStiffness) {
  // A spring of no rest length pulls by k d, also where d is zero.
  test::HandMadeBodies bodies;
  const BodyId a = bodies.add({}, {}), b = bodies.add({}, {});
  WrenchDerivatives derivatives;
  ASSERT_TRUE(
      make_law(DampedSpring{.a = {a}, .b = {b}, .stiffness = 7})->add_derivatives(bodies.at(), derivatives));
  const Wide found = summed(derivatives, 2);
  EXPECT_TRUE((found.block<3, 3>(0, 12).isApprox(7 * Matrix3::Identity())));
  EXPECT_TRUE((found.block<3, 3>(0, 0).isApprox(-7 * Matrix3::Identity())));
}

TEST(WrenchDerivatives, OfAFloatingBoxAreTheWeightOfWaterOnItsSection) {
  // Buoyancy states none: differences are taken. A box of 2 m x 3 m upright in water: sinking by dz adds
  // 1000 * 9.81 * 6 N a metre, and turning about x the waterplane's moment 2 * 3^3 / 12 less what the
  // centroid of the part below, 0.25 m below the centre of gravity, has to lose.
  test::HandMadeBodies bodies;
  const BodyId body = bodies.add({}, {});
  const Buoyancy buoyancy{.body = body, .shape = {.geometry = BoxShape{{2, 3, 1}}}};
  const std::unique_ptr<ForceLaw> law = make_law(buoyancy);
  WrenchDerivatives derivatives;
  ASSERT_FALSE(law->add_derivatives(bodies.at(), derivatives));
  ASSERT_TRUE(derivatives.add_differences(*law, bodies.at()));
  const Wide found = summed(derivatives, 1);
  EXPECT_NEAR(found(2, 2), -9810 * 6, 1e-3);
  EXPECT_NEAR(found(3, 3), -9810 * (2 * 27 / 12.0 - 3 * 0.25), 1e-2);
}

TEST(WrenchDerivatives, OfAUsersFunctionAreDifferences) {
  // A function that looks at each body by itself: -k p has the derivative -k. One that may look at others is
  // not differenced.
  std::mt19937_64 random{7};
  test::HandMadeBodies bodies;
  for (int i = 0; i < 3; ++i) bodies.add_random(random);
  ForceFunction pull{.on_body =
                         [](const BodiesAt& at, std::size_t i) {
                           return Wrench{-5 * at.kinematics[i].p_WBcm, -2 * at.kinematics[i].w_WB};
                         },
                     .couples_bodies = false};
  WrenchDerivatives derivatives;
  ASSERT_TRUE(derivatives.add_differences(*make_law(pull), bodies.at()));
  const Wide found = summed(derivatives, 3);
  Wide expected = Wide::Zero(18, 36);
  for (Eigen::Index i = 0; i < 3; ++i) {
    expected.block<3, 3>(6 * i, 12 * i) = -5 * Matrix3::Identity();
    expected.block<3, 3>(6 * i + 3, 12 * i + 9) = -2 * Matrix3::Identity();
  }
  EXPECT_LT((found - expected).cwiseAbs().maxCoeff(), 1e-8);
  pull.couples_bodies = true;
  ForceManager forces;
  forces.add(pull);
  EXPECT_FALSE(LawList{forces.laws()}.gather_derivatives(bodies.at(), derivatives));
}

}  // namespace
}  // namespace pantin

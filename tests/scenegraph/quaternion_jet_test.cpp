#include <pantin/scenegraph/quaternion_jet.hpp>

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <support/finite_differences.hpp>
#include <support/random_affine.hpp>

namespace pantin {
namespace {

using Quat = Numbers4<double>;

Quat about(const Vector3& axis, double angle) {
  const double s = std::sin(angle / 2);
  return {std::cos(angle / 2), s * axis.x(), s * axis.y(), s * axis.z()};
}

TEST(Power, TurnsByThatManyTimesTheAngle) {
  // Closed form for turns up to half a turn, tiny and large ones, by any power; q^0 = 1 exactly, q^1 = q.
  std::mt19937_64 random{97};
  for (const double angle : {0.0, 1e-300, 1e-9, 1e-3, 0.3, 1.4, 1.6, 2.5, 3.1, 3.14159265358979})
    for (const double k : {-2.0, 0.0, 0.5, 1.0, 3.7}) {
      const Vector3 axis = test::random_vector(random).normalized();
      const Quat q = power(about(axis, angle), k), expected = about(axis, k * angle);
      for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(q[i], expected[i], 4e-15) << angle << " " << k;
      if (k == 0) {
        EXPECT_EQ(q, (Quat{1, 0, 0, 0}));
      }
    }
}

TEST(Power, HasExactDerivatives) {
  // Turn and power both vary; against sixth order differences of the closed form's own values, across the
  // place where the series takes over and through the identity itself.
  std::mt19937_64 random{98};
  for (const double middle : {0.0, 0.02, 1.0, 1.55, 2.8})
    for (int n = 0; n < 20; ++n) {
      const Vector3 a = test::random_vector(random).normalized() * middle / 2,
                    b = test::random_vector(random) / 4;
      const auto turn = [&](double t) {  // exp of a + b t, as a quaternion with w >= 0
        const Vector3 h = a + b * t;
        return about(h.norm() > 0 ? Vector3{h.normalized()} : Vector3::UnitX(), 2 * h.norm());
      };
      const auto k = [](double t) { return 0.7 + 0.4 * t + 0.3 * t * t; };
      const auto curve = [&](double t) { return Eigen::Vector4d{power(turn(t), k(t)).data()}; };
      const auto quaternion = [&](double t) { return Eigen::Vector4d{turn(t).data()}; };
      const double h = 0.02;
      const Eigen::Vector4d q = quaternion(0), q1 = test::first_difference(quaternion, 0, h),
                            q2 = test::second_difference(quaternion, 0, h);
      Numbers4<Jet> jets;
      for (std::size_t i = 0; i < 4; ++i)
        jets[i] = {q[Eigen::Index(i)], q1[Eigen::Index(i)], q2[Eigen::Index(i)]};
      const Numbers4<Jet> out = power(jets, Jet{0.7, 0.4, 0.6});
      const Eigen::Vector4d first = test::first_difference(curve, 0, h),
                            second = test::second_difference(curve, 0, h);
      for (std::size_t i = 0; i < 4; ++i) {
        EXPECT_NEAR(out[i].first, first[Eigen::Index(i)], 1e-10) << middle;
        EXPECT_NEAR(out[i].second, second[Eigen::Index(i)], 1e-8) << middle;
      }
    }
}

TEST(Jet, FollowsTheRulesOfDifferentiation) {
  // (f g)'' and (f / g)'' and sqrt against closed forms of polynomials: f = 2 + 3 t + t^2, g = 5 - t + 2 t^2
  // at 0.
  const Jet f{2, 3, 2}, g{5, -1, 4};
  EXPECT_EQ((f * g).second, 2 * 5 + 2 * 3 * -1 + 2 * 4);
  EXPECT_DOUBLE_EQ((f / g * g).second, f.second);
  EXPECT_DOUBLE_EQ((f / g).first, (3 * 5 + 2 * 1) / 25.0);
  const Jet root = square_root(f);
  EXPECT_DOUBLE_EQ((root * root).first, 3);
  EXPECT_DOUBLE_EQ((root * root).second, 2);
}

}  // namespace
}  // namespace pantin

#pragma once
// Comparisons of vectors and matrices relative to a stated size.
#include <algorithm>
#include <random>

#include <gtest/gtest.h>

#include <pantin/physics/mass_properties.hpp>

namespace pantin::test {

/// Every entry within `tolerance` * `size`.
template <class A, class B>
::testing::AssertionResult near(const Eigen::MatrixBase<A>& actual, const Eigen::MatrixBase<B>& expected,
                                double tolerance, double size = 1) {
  const double difference = (actual - expected).cwiseAbs().maxCoeff();
  if (difference <= tolerance * size) return ::testing::AssertionSuccess();
  return ::testing::AssertionFailure() << "differ by " << difference << " > " << tolerance * size << ":\n"
                                       << actual << "\nexpected\n"
                                       << expected;
}

/// Mass and inertia relative to themselves, centre of gravity relative to the larger of itself and the body's
/// radius of gyration.
inline ::testing::AssertionResult near(const MassProperties& actual, const MassProperties& expected,
                                       double tolerance) {
  const double inertia = expected.I_BBcm_B.cwiseAbs().maxCoeff();
  const double length = std::sqrt(inertia / expected.mass);
  if (std::abs(actual.mass - expected.mass) > tolerance * expected.mass) {
    return ::testing::AssertionFailure() << "mass " << actual.mass << ", expected " << expected.mass;
  }
  if (const auto result = near(actual.p_BBcm, expected.p_BBcm, tolerance,
                               std::max(length, expected.p_BBcm.cwiseAbs().maxCoeff()));
      !result) {
    return ::testing::AssertionFailure() << "centre of gravity: " << result.message();
  }
  if (const auto result = near(actual.I_BBcm_B, expected.I_BBcm_B, tolerance, inertia); !result) {
    return ::testing::AssertionFailure() << "inertia: " << result.message();
  }
  return ::testing::AssertionSuccess();
}

inline Vector3 random_vector(std::mt19937_64& random, double size = 1) {
  std::uniform_real_distribution<double> number{-size, size};
  const double x = number(random), y = number(random), z = number(random);
  return {x, y, z};
}

inline Quaternion random_rotation(std::mt19937_64& random) {
  std::normal_distribution<double> number;
  const double w = number(random), x = number(random), y = number(random), z = number(random);
  return Quaternion{w, x, y, z}.normalized();
}

/// Mass properties of some solid body: a box of random size, turned and displaced.
inline MassProperties random_mass(std::mt19937_64& random) {
  const Vector3 size = random_vector(random).cwiseAbs() + Vector3::Constant(0.1);
  std::uniform_real_distribution<double> density{0.5, 5};
  const double rho = density(random);
  const Vector3 position = random_vector(random);
  return mass_of({BoxShape{size}, {position, random_rotation(random)}}, rho);
}

}  // namespace pantin::test

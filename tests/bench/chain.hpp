#pragma once
// The chains of the benchmarks, as numbers that every engine can build them from: rods on pivots about x and
// y in turn, hanging from the world, the first lifted by a right angle. Otherwise straight, the motion stays
// in a plane; bent, every second joint starts at 0.3 rad. And the free top that goes with them.
#include <cmath>

namespace pantin::bench {

constexpr double kGravity = 9.81;   ///< along -z [m/s^2]
constexpr double kRodLength = 0.2;  ///< [m], from pivot to pivot, along -z; the centre of gravity is half-way
constexpr double kRodWidth = 0.02;  ///< [m], of the square section

struct Chain {
  int links{1};
  bool bent{false};
  double tip_mass{1};  ///< of the last rod; the others have 1 [kg]
  double spin{0};      ///< rate of the last joint at the start [rad/s]
  double duration{1};  ///< [s]
  /// Of springs on all joints but the first, at rest at the start [N m/rad], infinite: joints are fixed; and
  /// of their dampers [N m s/rad].
  double stiffness{0}, damping{0};
};

inline bool turns_about_x(int link) { return link % 2 == 0; }
/// Of a joint at the start [rad].
inline double start_angle(const Chain& chain, int link) {
  return link == 0 ? std::acos(0.0) : chain.bent && !turns_about_x(link) ? 0.3 : 0;
}
inline double rod_mass(const Chain& chain, int link) { return link == chain.links - 1 ? chain.tip_mass : 1; }
/// About the centre of gravity, across and along the rod [kg m^2].
inline double inertia_across(double mass) {
  return mass * (kRodLength * kRodLength + kRodWidth * kRodWidth) / 12;
}
inline double inertia_along(double mass) { return mass * kRodWidth * kRodWidth / 6; }

/// A free body that spins about its axis of middle inertia, nearly.
struct Top {
  double inertia[3]{1, 2, 3};     ///< about the axes of the body [kg m^2]; 1 kg
  double rate[3]{0.01, 5, 0.01};  ///< at the start, about the same axes [rad/s]
  double duration{10};            ///< [s]
};

}  // namespace pantin::bench

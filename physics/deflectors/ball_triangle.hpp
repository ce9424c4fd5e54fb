#pragma once
// Where a ball on a straight way first touches a triangle: its face, else an edge, else a corner.
#include <optional>

#include <pantin/physics/pose.hpp>

namespace pantin {

struct BallContact {
  double t{0};                       ///< fraction of the way, 0 .. 1
  Vector3 normal{Vector3::UnitZ()};  ///< from the triangle to the ball's centre
  double depth{0};                   ///< overlap at the begin, where there is one [m]
};

struct BallWayInD {
  Vector3 from{Vector3::Zero()}, way{Vector3::Zero()};
  double radius{0};  ///< 0 = a point
};

/// Nothing where it does not come nearer, or not before the end of its way.
[[nodiscard]] std::optional<BallContact> first_touch(const BallWayInD& ball, const Vector3& a,
                                                     const Vector3& b, const Vector3& c);

}  // namespace pantin

#pragma once
// How the wrenches of force laws change with the motion of bodies: what implicit integrators ask laws for.
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <pantin/physics/bodies_at.hpp>

namespace pantin {

class ForceLaw;

[[nodiscard]] inline Matrix3 cross_matrix(const Vector3& x) {
  return (Matrix3{} << 0, -x.z(), x.y(), x.z(), 0, -x.x(), -x.y(), x.x(), 0).finished();
}

/// A force (or a torque) by the motion of one body, all in W: by its centre of gravity, by its turn (d R_WB =
/// cross_matrix(turn) R_WB about the centre of gravity), by the velocity of the centre of gravity, by the
/// angular velocity.
struct ByMotion {
  Matrix3 position{Matrix3::Zero()}, turn{Matrix3::Zero()}, velocity{Matrix3::Zero()}, spin{Matrix3::Zero()};
};

/// How the wrench on body `on`, about its centre of gravity, changes with the motion of body `by`.
struct WrenchDerivative {
  std::uint32_t on{0}, by{0};  ///< positions in BodiesAt
  ByMotion force{}, torque{};
};

/// The force on a point of a body, with how it changes with the distance d of another point from there, and
/// with the rate of d; the other way on the other point.
struct PairForce {
  Vector3 force_a{Vector3::Zero()};
  Matrix3 by_distance{Matrix3::Zero()}, by_rate{Matrix3::Zero()};
};

/// A sum of parts; keeps its room when it is cleared.
class WrenchDerivatives {
 public:
  void clear() { parts_.clear(); }
  /// A part to be filled, zero as yet.
  WrenchDerivative& add(std::size_t on, std::size_t by);
  /// Of a force between two points, at least one of them on a body; what belongs to bodies only.
  void add_pair(const BodiesAt& at, const Attachment& a, const Attachment& b, const PairForce& pair);
  /// The same with the centre of gravity of the body at position `a`.
  void add_pair(const BodiesAt& at, std::size_t a, const Attachment& b, const PairForce& pair);
  /// Of a law that does not state its own, by central differences of its wrenches. False, and nothing is
  /// added, where it couples all bodies.
  bool add_differences(const ForceLaw& law, const BodiesAt& at);
  [[nodiscard]] std::span<const WrenchDerivative> parts() const noexcept { return parts_; }

 private:
  /// With r the arm from the centre of gravity to a point Q: d p_Q = position - [r] turn, d v_Q = velocity -
  /// [r] spin - [w] [r] turn.
  struct Point {
    std::optional<std::size_t> body{};                     ///< nothing: it is fixed in the world
    Matrix3 arm{Matrix3::Zero()}, swing{Matrix3::Zero()};  ///< [r], [w] [r]
  };
  static Point point_of(const BodiesAt& at, const Attachment& attachment);
  void add_pair(const Point& a, const Point& b, const PairForce& pair);
  /// Fills parts, moving all their `by` together.
  void take_differences(const ForceLaw& law, const BodiesAt& at, std::span<WrenchDerivative> parts);

  std::vector<WrenchDerivative> parts_{};
  std::vector<BodyKinematics> moved_{};
  std::array<std::vector<Wrench>, 2> wrenches_{};
};

}  // namespace pantin

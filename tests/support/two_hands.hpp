#pragma once
// A joint of any kind that is cut to make a tree of a loop, between bodies that move freely.
#include <array>
#include <ostream>

#include <pantin/physics/constraints/cylindrical.hpp>
#include <pantin/physics/constraints/planar.hpp>
#include <pantin/physics/constraints/screw.hpp>
#include <pantin/physics/constraints/universal.hpp>
#include <pantin/physics/forces/damped_spring.hpp>

#include "support/mechanisms.hpp"

namespace pantin::test {

/// Two bodies, each on six joints of one freedom, so that it moves freely but costs more rows than what joins
/// them.
struct TwoHands {
  PhysicsManager physics{};
  BodyId a{}, b{};
  Pose X_WJ{{0.5, 0.1, 0.2}, Quaternion{Eigen::AngleAxisd{0.8, Vector3{1, -2, 0.5}.normalized()}}};

  /// With `armature` on the joints of the hands, so that one between them with a rotor is cut, too.
  explicit TwoHands(double armature = 0) {
    physics.forces().add(Gravity{.g_W = {0.5, 1, -2}});
    a = hand({0, 0, 0}, armature);
    b = hand({1, 0, 0}, armature);
    // Springs, for what falls freely needs no holding.
    physics.forces().add(
        DampedSpring{.a = {{}, {2, 1, 1}}, .b = {b, {0.2, 0.1, -0.3}}, .stiffness = 40, .rest_length = 0.2});
    physics.forces().add(DampedSpring{
        .a = {{}, {-1, 0.5, -1}}, .b = {a, {-0.1, 0.2, 0.15}}, .stiffness = 25, .rest_length = 0.3});
  }
  BodyId hand(const Vector3& at, double armature) {
    BodyId last{};
    for (int k = 0; k < 6; ++k) {
      const BodyId next = physics.add(RigidBodySettings{.X_WB = {at + Vector3{0.03 * k, 0.02, -0.05 * k}},
                                                        .mass = lopsided_mass(1 + 2 * at.x())});
      const Pose X{at + Vector3{0.1 - 0.15 * at.x(), -0.05 * k, 0.02 * k}, facing(Vector3::Unit(k % 3))};
      const auto tie = [&](auto settings) {
        settings.axis.armature = armature;
        physics.add(settings);
      };
      if (k < 3) tie(joint_here<SliderSettings>(physics, last, next, X));
      else tie(joint_here<PivotSettings>(physics, last, next, X));
      last = next;
    }
    return last;
  }
};

struct CutKind {
  const char* name;
  JointId (*add)(TwoHands&);
  void (*add_loaded)(TwoHands&);  ///< with damping and, where it has numbers, spring, rotor and motor
};
inline std::ostream& operator<<(std::ostream& out, const CutKind& kind) { return out << kind.name; }

template <class Settings>
Settings between(const TwoHands& t) {
  Settings s = joint_here<Settings>(t.physics, t.a, t.b, t.X_WJ, "between");
  if constexpr (requires { s.pitch; }) s.pitch = 0.07;
  return s;
}
template <class Settings>
JointId add_here(TwoHands& t) {
  return t.physics.add(between<Settings>(t));
}
template <class Settings>
void add_loaded_here(TwoHands& t) {
  Settings s = between<Settings>(t);
  const JointAxis first{.stiffness = 20, .rest = 0.3, .armature = 0.2}, second{.armature = 0.1};
  if constexpr (requires { s.damping; }) s.damping = 0.5;
  else s.angular_damping = 0.5;
  if constexpr (requires { s.axis; }) s.axis = first;
  if constexpr (requires { s.axes[1]; }) s.axes[0] = first, s.axes[1] = second;
  const JointId joint = t.physics.add(s);
  if constexpr (!std::is_same_v<Settings, BallSettings>) t.physics.set_motor(joint, {.effort = 2});
}
template <class Settings>
constexpr CutKind cut_kind(const char* name) {
  return {name, add_here<Settings>, add_loaded_here<Settings>};
}

inline constexpr std::array kCutKinds{
    cut_kind<PivotSettings>("Pivot"),         cut_kind<SliderSettings>("Slider"),
    cut_kind<ScrewSettings>("Screw"),         cut_kind<CylindricalSettings>("Cylindrical"),
    cut_kind<UniversalSettings>("Universal"), cut_kind<BallSettings>("Ball"),
    cut_kind<PlanarSettings>("Planar")};

}  // namespace pantin::test

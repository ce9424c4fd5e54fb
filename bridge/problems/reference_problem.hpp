#pragma once
// A reference problem as a plain value: bodies, joints and forces at t = 0, how long to run, and where
// everything then is according to a solution that can be trusted. It knows neither the file it came from nor
// the engine that runs it.
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include <pantin/physics/constraints/joint.hpp>
#include <pantin/physics/mass_properties.hpp>
#include <pantin/physics/pose.hpp>

namespace pantin::reference {

/// The name that stands for the world where a body is named.
inline constexpr const char* kWorld = "world";

/// A rigid body at t = 0.
struct Body {
  std::string name{};     ///< unique in the problem
  MassProperties mass{};  ///< mass > 0 [kg]; inertia about the centre of gravity, body axes [kg m^2]
  Pose X_WB{};            ///< of the body origin
  Vector3 v_WBcm{Vector3::Zero()};  ///< [m/s]
  Vector3 w_WB{Vector3::Zero()};    ///< [rad/s]
};

/// A point mass at t = 0.
struct Particle {
  std::string name{};
  double mass{1};                ///< > 0 [kg]
  Vector3 p_W{Vector3::Zero()};  ///< [m]
  Vector3 v_W{Vector3::Zero()};  ///< [m/s]
};

/// angle(t) = amplitude sin(omega t + phase) + rate t
struct SineLaw {
  double amplitude{0};  ///< [rad]
  double omega{0};      ///< [rad/s]
  double phase{0};      ///< [rad]
  double rate{0};       ///< [rad/s]
};

/// angle(t) = rate t + acceleration t^2 / 2
struct UniformAccelerationLaw {
  double rate{0};          ///< [rad/s]
  double acceleration{0};  ///< [rad/s^2]
};

using AngleLaw = std::variant<SineLaw, UniformAccelerationLaw>;

/// An angle with its exact derivatives.
struct AngleAt {
  double angle{0};         ///< [rad]
  double rate{0};          ///< [rad/s]
  double acceleration{0};  ///< [rad/s^2]
};
[[nodiscard]] AngleAt evaluate(const AngleLaw& law, double t);

/// An animated body: its origin stays at `p_WA` and it turns about `axis_W` by angle(t) - angle(0) from
/// `q_WB`.
struct KinematicBody {
  std::string name{};
  Vector3 p_WA{Vector3::Zero()};            ///< a point of the axis, and the body origin [m]
  Vector3 axis_W{Vector3::UnitZ()};         ///< unit
  Quaternion q_WB{Quaternion::Identity()};  ///< attitude at t = 0
  AngleLaw law{};
};

/// A joint by its place in the world at t = 0.
struct Joint {
  JointKind kind{JointKind::Pivot};  ///< Pivot, Slider, Ball or Fixed
  std::string name{};                ///< unique among joints
  std::string a{kWorld}, b{};        ///< names; `b` moves against `a`
  Vector3 p_WJ{Vector3::Zero()};     ///< anchor [m]
  Vector3 axis_W{Vector3::UnitZ()};  ///< unit; Pivot and Slider only
};

/// An end of a spring.
struct SpringEnd {
  std::string body{kWorld};
  Vector3 point{
      Vector3::Zero()};  ///< from the centre of gravity in body axes; from the world origin in W [m]
};

/// F = stiffness (l - rest_length) + damping dl/dt along the line between two points.
struct Spring {
  SpringEnd a{}, b{};
  double stiffness{0};    ///< >= 0 [N/m]
  double damping{0};      ///< >= 0 [N s/m]
  double rest_length{0};  ///< >= 0 [m]
};

struct ConstantTorque {
  std::string body{};
  Vector3 torque_W{Vector3::Zero()};  ///< [N m]
};

/// F = -c (v - u) or, quadratic, F = -c |v - u| (v - u).
struct Drag {
  bool quadratic{false};
  std::string body{};                        ///< a body or a particle
  double coefficient{0};                     ///< c >= 0 [N s/m], quadratic [N s^2/m^2]
  Vector3 medium_velocity{Vector3::Zero()};  ///< u [m/s]
};

/// a = -mu r / |r|^3 towards `center`.
struct CentralGravity {
  std::string body{};               ///< a body or a particle
  Vector3 center{Vector3::Zero()};  ///< [m]
  double mu{0};                     ///< [m^3/s^2]
};

using Force = std::variant<Spring, ConstantTorque, Drag, CentralGravity>;
/// The name of the force's type in the schema.
[[nodiscard]] std::string type_name(const Force& force);

struct Plane {
  Vector3 point{Vector3::Zero()};    ///< [m]
  Vector3 normal{Vector3::UnitZ()};  ///< unit, out of the ground
};
struct BoxOnPlane {
  std::string body{};
  Vector3 size{Vector3::Zero()};  ///< full edge lengths, > 0 [m]
  Plane plane{};
};
struct SphereOnPlane {
  std::string body{};
  double radius{0};  ///< > 0 [m]
  Plane plane{};
};
struct CapsulePair {
  std::string a{}, b{};
  double radius{0};         ///< > 0, of both [m]
  double half_length_a{0};  ///< > 0 [m]
  double half_length_b{0};  ///< > 0 [m]
  std::string axis{};       ///< as written, e.g. "body x"
};

struct Contact {
  std::variant<BoxOnPlane, SphereOnPlane, CapsulePair> pair{};
  double restitution{0};  ///< 0 to 1
  double friction{0};     ///< >= 0
};
/// The name of the contact's type in the schema.
[[nodiscard]] std::string type_name(const Contact& contact);

/// Where one body or particle is at a sample; what the file does not give is not there.
struct BodySample {
  std::string name{};
  std::optional<Vector3> p_WBcm{};   ///< [m]
  std::optional<Quaternion> q_WB{};  ///< unit
  std::optional<Vector3> v_WBcm{};   ///< [m/s]
  std::optional<Vector3> w_WB{};     ///< [rad/s]
  std::optional<Vector3> p_WB{};     ///< body origin, where it is not the centre of gravity [m]
};

struct SampleEnergy {
  double kinetic{0};                       ///< [J]
  double potential_gravity{0};             ///< zero at the world origin [J]
  double potential_elastic_or_central{0};  ///< [J]
  double total{0};                         ///< [J]
};

struct Sample {
  double t{0};  ///< >= 0, not decreasing over the samples; may lie beyond the duration [s]
  std::vector<BodySample> bodies{};  ///< may be empty: a problem may be given without its solution
  std::optional<SampleEnergy> energy{};
};

/// How far the samples can be trusted.
struct Accuracy {
  std::optional<double> absolute{};  ///< [m] and [rad]
  std::optional<double> angle{};     ///< [rad]
  std::vector<std::pair<double, double>>
      attitude_sensitivity{};  ///< at t [s]: attitude change [rad] per relative
                               ///< error 1 of the initial angular velocity
  std::string note{};
};

struct Problem {
  std::string file{};  ///< as given, for messages
  std::string name{}, title{};
  Vector3 gravity{Vector3::Zero()};  ///< [m/s^2]
  std::vector<Body> bodies{};
  std::vector<Particle> particles{};
  std::vector<KinematicBody> kinematic_bodies{};
  std::vector<Joint> joints{};
  std::vector<Force> forces{};
  std::vector<Contact> contacts{};
  double duration{0};  ///< > 0 [s]
  std::vector<Sample> samples{};
  Accuracy accuracy{};
  std::string error_metric{};  ///< in words
};

}  // namespace pantin::reference

namespace pantin {
using ReferenceProblem = reference::Problem;
}  // namespace pantin

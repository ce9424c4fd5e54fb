#pragma once
// A scene with physics and a bridge, and the small pieces that tests of the bridge put on it.
#include <cmath>
#include <cstring>
#include <random>
#include <string>
#include <vector>

#include <pantin/bridge/bridge.hpp>
#include <pantin/physics/forces/gravity.hpp>

namespace pantin::test {

struct Stage {
  Stage() = default;
  explicit Stage(double step) : bridge{scene, physics, {.step = step}} {}
  Scene scene{};
  PhysicsManager physics{};
  Bridge bridge{scene, physics};
};

inline Affine moved(const Vector3& p) { return Affine{Eigen::Translation3d{p}}; }
inline Affine turned(double angle, const Vector3& axis) {
  return Affine{Eigen::AngleAxisd{angle, axis.normalized()}};
}
inline Affine scaled(const Vector3& s) { return Affine{Eigen::Scaling(s)}; }

/// A solid box of this mass [kg] and edge lengths [m], its centre at `centre`.
inline MassProperties box_mass(double mass, const Vector3& size, const Vector3& centre = Vector3::Zero()) {
  MassProperties m = mass_of({BoxShape{size}, Pose{}}, mass / size.prod());
  m.p_BBcm = centre;
  return m;
}

/// A node that declares the mass of a box.
inline NodeId box(Stage& s, NodeId parent, const std::string& name, const Affine& M_PN, double mass = 1,
                  const Vector3& centre = Vector3::Zero()) {
  const NodeId id = s.scene.create(parent, name, M_PN);
  s.bridge.set_node_body(id, {.mass = box_mass(mass, {0.3, 0.2, 0.4}, centre)});
  return id;
}

inline Link pivot_link(const std::string& name, const Affine& M_PJ, const Vector3& axis, double value = 0) {
  return {.kind = LinkKind::Pivot, .name = name, .M_PJ = M_PJ, .axis = axis.normalized(), .value = value};
}
inline Link slider_link(const std::string& name, const Affine& M_PJ, const Vector3& axis, double value = 0) {
  return {.kind = LinkKind::Slider, .name = name, .M_PJ = M_PJ, .axis = axis.normalized(), .value = value};
}

/// Smooth cubic keys of one channel: values at 0, 1, 2 s with these tangents.
inline Track cubic_track(std::uint32_t target, Channel channel, int width,
                         const std::vector<std::vector<double>>& values,
                         const std::vector<std::vector<double>>& tangents) {
  Track track{
      .target = target, .channel = channel, .interpolation = Interpolation::CubicSpline, .width = width};
  for (std::size_t k = 0; k < values.size(); ++k) {
    track.times.push_back(static_cast<double>(k));
    for (const std::vector<double>* part : {&tangents[k], &values[k], &tangents[k]}) {
      track.values.insert(track.values.end(), part->begin(), part->end());
    }
  }
  return track;
}

/// A clip of two seconds that swings and moves its target along smooth curves.
inline Clip swinging_clip(std::uint32_t target = 0) {
  const double c = std::cos(0.4), s = std::sin(0.4);
  Clip clip{.name = "swing", .duration = 2};
  clip.tracks.push_back(cubic_track(target, Channel::Rotation, 4, {{1, 0, 0, 0}, {c, s, 0, 0}, {c, 0, s, 0}},
                                    {{0, 0.3, 0.2, 0.1}, {-0.1, 0.2, 0.5, 0.3}, {0, 0.1, 0, 0.2}}));
  clip.tracks.push_back(cubic_track(target, Channel::Translation, 3,
                                    {{0, 0, 0}, {1, 0.5, 0.2}, {0.3, 1, -0.5}},
                                    {{0.5, 1, 0}, {0, 1, -1}, {1, 0, 0.4}}));
  return clip;
}

/// Link values 0, `most`, 0 at 0, 1, 2 s, linear.
inline Track link_track(std::uint32_t target, double most) {
  Track track{
      .target = target, .channel = Channel::LinkValue, .interpolation = Interpolation::Linear, .width = 1};
  track.times = {0, 1, 2};
  track.values = {0, most, 0};
  return track;
}

/// A clip of one link value from `from` to `to` [rad] or [m] within `duration` s, linear.
inline Clip link_clip(double from, double to, double duration, std::uint32_t target = 0) {
  Track track{
      .target = target, .channel = Channel::LinkValue, .interpolation = Interpolation::Linear, .width = 1};
  track.times = {0, duration};
  track.values = {from, to};
  return {.name = "link", .duration = duration, .tracks = {track}};
}

inline std::vector<Affine> locals(const Scene& scene) {
  std::vector<Affine> out;
  for (const NodeId id : scene.order()) {
    if (scene.contains(id)) out.push_back(scene.local(id));
  }
  return out;
}

inline bool same_bits(const std::vector<Affine>& a, const std::vector<Affine>& b) {
  if (a.size() != b.size()) return false;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (std::memcmp(a[i].data(), b[i].data(), 16 * sizeof(double)) != 0) return false;
  }
  return true;
}

/// Greatest difference of entries relative to the norm of `b`.
inline double relative_difference(const Affine& a, const Affine& b) {
  return (a.affine() - b.affine()).norm() / b.affine().norm();
}

inline Affine affine_of(const Pose& X) {
  Affine M = Affine::Identity();
  M.linear() = X.rotation();
  M.translation() = X.p;
  return M;
}

/// World matrix that body and residual of a bound node give.
inline Affine by_body(const Stage& s, NodeId id) {
  return affine_of(s.physics.body(s.bridge.body_of(id)).X_WB()) * s.bridge.residual(id);
}

/// Total linear momentum of all simulated bodies, and angular momentum about the world origin.
struct Momentum {
  Vector3 linear{Vector3::Zero()}, angular{Vector3::Zero()};
};
inline Momentum momentum(const PhysicsManager& physics) {
  Momentum sum;
  for (const BodyId id : physics.bodies()) {
    const RigidBody body = physics.body(id);
    if (body.kind() != BodyKind::Simulated) continue;
    sum.linear += body.linear_momentum();
    sum.angular += body.angular_momentum() + body.p_WBcm().cross(body.linear_momentum());
  }
  return sum;
}

/// Whether one of the notes has this place and this text in its problem.
inline bool says(const std::vector<Diagnostic>& notes, const std::string& place, const std::string& problem) {
  for (const Diagnostic& note : notes) {
    if (note.place == place && note.problem.find(problem) != std::string::npos) return true;
  }
  return false;
}

inline std::string text_of(const std::vector<Diagnostic>& notes) {
  std::string out;
  for (const Diagnostic& note : notes) out += to_string(note) + "\n";
  return out;
}

}  // namespace pantin::test

#pragma once
// A problem of schema rigid-ref/1 with one of everything, for tests that spoil it.
#include <nlohmann/json.hpp>

namespace pantin::test {

/// A good problem: two bodies, a particle, a kinematic body, one of each joint and force, a contact, two
/// samples.
inline nlohmann::json good() {
  return nlohmann::json::parse(R"({
    "schema": "rigid-ref/1", "name": "good", "title": "A good one", "gravity": [0, 0, -9.81], "duration": 2,
    "bodies": [
      {"name": "rod", "mass": 2, "inertia_cog_body": [[0.2, 0, 0], [0, 0.3, 0], [0, 0, 0.4]],
       "cog_in_node": [0.5, 0, 0], "position_node": [1, 2, 3], "orientation_wxyz": [0, 0, 0, 1],
       "velocity_cog": [0, -1.5, 0], "angular_velocity_world": [0, 0, 3]},
      {"name": "bob", "mass": 1, "inertia_cog_body": [[0.1, 0, 0], [0, 0.1, 0], [0, 0, 0.1]],
       "position_cog": [5, 0, 0], "orientation_wxyz": [1, 0, 0, 0], "velocity_node": [0, 0, 0],
       "angular_velocity_body": [0, 0, 0]}],
    "particles": [{"name": "p", "mass": 0.5, "position": [0, 0, 1], "velocity": [1, 0, 0]}],
    "kinematic_bodies": [{"name": "arm", "anchor_world": [5, 0, 0], "axis_world": [0, 1, 0],
                          "law": {"type": "sine", "amplitude": 0.5, "omega": 2}}],
    "joints": [
      {"type": "pivot", "name": "hinge", "body_a": "world", "body_b": "rod", "anchor_world": [1, 2, 3],
       "axis_world": [0, 0, 1]},
      {"type": "pivot", "name": "wrist", "body_a": "arm", "body_b": "bob", "anchor_world": [5, 0, 0],
       "axis_world": [0, 1, 0]}],
    "forces": [
      {"type": "spring_damper_point_to_point", "a": {"body": "world", "point_world": [0, 0, 1]},
       "b": {"body": "rod", "point_body_cog": [0.1, 0, 0]}, "stiffness": 10, "damping": 1, "rest_length": 0.5},
      {"type": "torque_constant", "body": "rod", "torque_world": [0, 0, 1]},
      {"type": "linear_drag", "body": "bob", "coefficient": 0.2, "medium_velocity": [1, 0, 0]},
      {"type": "quadratic_drag", "particle": "p", "coefficient": 0.2},
      {"type": "central_gravity", "particle": "p", "center": [0, 0, 0], "mu": 4}],
    "contacts": [{"type": "sphere_plane", "body": "bob", "radius": 0.1, "plane_point": [0, 0, -9],
                  "plane_normal": [0, 0, 1], "restitution": 0.5, "friction": 0.1}],
    "samples": [
      {"t": 0},
      {"t": 1, "state": {"rod": {"position_cog": [1, 2, 3], "quaternion_wxyz": [1, 0, 0, 0],
                                 "velocity_cog": [0, 0, 0], "angular_velocity_world": [0, 0, 1]},
                         "p": {"position": [1, 1, 1], "velocity": [0, 0, 0]}},
       "energy": {"kinetic": 1, "potential_gravity": 2, "potential_elastic_or_central": 3, "total": 6}}],
    "accuracy": {"estimated_abs": 1e-12, "attitude_sensitivity": {"0.5": 3}, "note": "trust it"},
    "error_metric": "distance"})");
}

/// The same without what physics cannot hold.
inline nlohmann::json buildable() {
  nlohmann::json problem = good();
  problem["contacts"] = nlohmann::json::array();
  return problem;
}

}  // namespace pantin::test

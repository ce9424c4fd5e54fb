#include <gtest/gtest.h>

#include <pantin/bridge/problems/rigid_ref.hpp>

#include "good_problem.hpp"
#include "reference_run.hpp"

namespace pantin::test {
namespace {

using nlohmann::json;

/// A change that makes the good file bad, and what must be said about it.
struct BadFile {
  const char* name;
  void (*spoil)(json&);
  const char* says;
};

class RigidRefRefuses : public testing::TestWithParam<BadFile> {};

TEST_P(RigidRefRefuses, WithPlaceSubjectProblemAndRemedy) {
  // Each case spoils one thing of a good file; the one error names it, and there is no value.
  json problem = good();
  GetParam().spoil(problem);
  const Loaded<ReferenceProblem> read = parse_rigid_ref(problem.dump(), "f");
  EXPECT_FALSE(read.value.has_value());
  EXPECT_EQ(lines(read.notes), std::string{"f#"} + GetParam().says + '\n');
}

INSTANTIATE_TEST_SUITE_P(
    RigidRef, RigidRefRefuses,
    testing::Values(
        BadFile{"NotAnObject", [](json& p) { p = json::array(); },
                ": error: problem: is a list, not an object; write it as {...}"},
        BadFile{"OtherSchema", [](json& p) { p["schema"] = "rigid-ref/2"; },
                "/schema: error: problem: 'schema' is 'rigid-ref/2'; this reader reads rigid-ref/1"},
        BadFile{"MissingKey", [](json& p) { p["bodies"][0].erase("mass"); },
                "/bodies/0: error: body 'rod': has no 'mass'; add it"},
        BadFile{"MissingEither", [](json& p) { p["bodies"][0].erase("position_node"); },
                "/bodies/0/position_node: error: body 'rod': 'position_node' is missing, and so is "
                "'position_cog'; add "
                "one of them"},
        BadFile{"WrongType", [](json& p) { p["bodies"][0]["mass"] = "heavy"; },
                "/bodies/0/mass: error: body 'rod': 'mass' is a text, not a number; mend it"},
        BadFile{"ShortVector",
                [](json& p) {
                  p["gravity"] = {0, 1};
                },
                "/gravity: error: problem: 'gravity' is not a list of 3 numbers; mend it"},
        BadFile{
            "BeyondComputing",
            [](json& p) {
              p["gravity"] = {0, -1e151, 0};
            },
            "/gravity: error: problem: 'gravity' holds a number beyond 1e150, too great to be computed with; "
            "choose numbers of sensible size"},
        BadFile{"ShortMatrix", [](json& p) { p["bodies"][0]["inertia_cog_body"].erase(2); },
                "/bodies/0/inertia_cog_body: error: body 'rod': 'inertia_cog_body' is not a list of three "
                "rows; mend "
                "it"},
        BadFile{
            "QuaternionNotUnit",
            [](json& p) {
              p["bodies"][0]["orientation_wxyz"] = {1, 0, 0, 1e-3};
            },
            "/bodies/0/orientation_wxyz: error: body 'rod': 'orientation_wxyz' is not a unit quaternion: its "
            "length is 1.0000005; divide it by its length"},
        BadFile{
            "AxisNotUnit",
            [](json& p) {
              p["joints"][0]["axis_world"] = {0, 0, 2};
            },
            "/joints/0/axis_world: error: joint 'hinge': 'axis_world' is not a unit vector: its length is 2; "
            "divide it by its length"},
        BadFile{
            "AxisZero",
            [](json& p) {
              p["joints"][0]["axis_world"] = {0, 0, 0};
            },
            "/joints/0/axis_world: error: joint 'hinge': 'axis_world' is not a unit vector: its length is 0; "
            "divide it by its length"},
        BadFile{"Contradiction",
                [](json& p) {
                  p["bodies"][0]["position_cog"] = {0, 0, 0};
                },
                "/bodies/0/position_node: error: body 'rod': 'position_node' contradicts 'position_cog'; "
                "correct one "
                "or leave one out"},
        BadFile{"NegativeMass", [](json& p) { p["bodies"][0]["mass"] = -2; },
                "/bodies/0/mass: error: body 'rod': has a mass of -2.000000 kg; a mass is greater than zero"},
        BadFile{
            "MasslessParticle", [](json& p) { p["particles"][0]["mass"] = 0; },
            "/particles/0/mass: error: particle 'p': has a mass of 0.000000 kg; a mass is greater than zero"},
        BadFile{"UnknownBody", [](json& p) { p["joints"][0]["body_b"] = "rad"; },
                "/joints/0/body_b: error: joint 'hinge': names 'rad', which is not a body of this problem; "
                "check the "
                "spelling"},
        BadFile{"UnknownBodyOfForce", [](json& p) { p["forces"][1]["body"] = "rad"; },
                "/forces/1/body: error: force torque_constant: names 'rad', which is not a body of this "
                "problem; check "
                "the spelling"},
        BadFile{
            "UnknownBodyInSample", [](json& p) { p["samples"][1]["state"]["rad"] = json::object(); },
            "/samples/1/state: error: sample: holds 'rad', which is not a body of this problem; check the "
            "spelling"},
        BadFile{"DuplicateName",
                [](json& p) {
                  p["kinematic_bodies"][0]["name"] = "rod";
                  p["joints"].erase(1);
                },
                "/kinematic_bodies/0/name: error: kinematic body 'rod': bears a name that is used before; "
                "names are "
                "unique; rename one"},
        BadFile{"NamedWorld",
                [](json& p) {
                  p["particles"].push_back(
                      {{"name", "world"}, {"mass", 1}, {"position", {0, 0, 0}}, {"velocity", {0, 0, 0}}});
                },
                "/particles/1/name: error: particle 'world': bears the name of the world; name it otherwise"},
        BadFile{"EmptyName", [](json& p) { p["joints"][1]["name"] = ""; },
                "/joints/1/name: error: joint: has an empty name; name it"},
        BadFile{"UnknownJointType", [](json& p) { p["joints"][1]["type"] = "screw"; },
                "/joints/1/type: error: joint 'wrist': 'type' is 'screw', which the reader does not know; "
                "known are "
                "pivot, slider, ball and fixed"},
        BadFile{
            "UnknownForceType", [](json& p) { p["forces"][1]["type"] = "magnet"; },
            "/forces/1/type: error: force magnet: 'type' is 'magnet', which the reader does not know; known "
            "are "
            "spring_damper_point_to_point, torque_constant, linear_drag, quadratic_drag and central_gravity"},
        BadFile{"UnknownContactType", [](json& p) { p["contacts"][0]["type"] = "cone_plane"; },
                "/contacts/0/type: error: contact: 'type' is 'cone_plane', which the reader does not know; "
                "known are "
                "box_plane, sphere_plane and capsule_capsule"},
        BadFile{
            "UnknownLaw", [](json& p) { p["kinematic_bodies"][0]["law"]["type"] = "spline"; },
            "/kinematic_bodies/0/law/type: error: law of kinematic body 'arm': 'type' is 'spline', which the "
            "reader does not know; known are sine and uniform_acceleration"},
        BadFile{"NoLaw", [](json& p) { p["kinematic_bodies"][0].erase("law"); },
                "/kinematic_bodies/0/law: error: kinematic body 'arm': 'law' is missing: formulas in words "
                "are not "
                "read; give the law sine or uniform_acceleration"},
        BadFile{"JoinedWithItself", [](json& p) { p["joints"][0]["body_a"] = "rod"; },
                "/joints/0/body_b: error: joint 'hinge': joins 'rod' with itself; name two bodies"},
        BadFile{"JoinsNothingThatMoves", [](json& p) { p["joints"][0]["body_b"] = "arm"; },
                "/joints/0: error: joint 'hinge': joins 'world' and 'arm', neither of which it can move; "
                "leave it "
                "out"},
        BadFile{"SpringBetweenFixedEnds",
                [](json& p) {
                  p["forces"][0]["b"] = {{"body", "arm"}, {"point_body_cog", {0, 0, 0}}};
                },
                "/forces/0: error: force spring_damper_point_to_point: has no end on a body that moves "
                "freely; fasten "
                "one end to one"},
        BadFile{"SpringFromAParticleToItself",
                [](json& p) {
                  p["forces"][0]["a"] = {{"body", "p"}};
                  p["forces"][0]["b"] = {{"body", "p"}};
                },
                "/forces/0: error: force spring_damper_point_to_point: joins particle 'p' with itself; name "
                "two ends"},
        BadFile{"SpringBesideAParticle",
                [](json& p) {
                  p["forces"][0]["b"] = {{"body", "p"}, {"point_body_cog", {1, 0, 0}}};
                },
                "/forces/0/b: error: force spring_damper_point_to_point: is fastened beside particle 'p', "
                "which is a point; leave point_body_cog out"},
        BadFile{"SpringWithoutEnd", [](json& p) { p["forces"][0].erase("b"); },
                "/forces/0/b: error: force spring_damper_point_to_point: 'b' is missing; name a body, or the "
                "world and "
                "a point"},
        BadFile{"WorldPointOnABody",
                [](json& p) {
                  p["forces"][0]["b"]["point_world"] = {0, 0, 0};
                },
                "/forces/0/b/point_world: error: end 'b' of force spring_damper_point_to_point: "
                "'point_world' is given "
                "for a body, on which points move; use point_body_cog"},
        BadFile{"TorqueOnAnimated", [](json& p) { p["forces"][1]["body"] = "arm"; },
                "/forces/1/body: error: force torque_constant: acts on 'arm', which no force moves; name a "
                "body that "
                "moves freely"},
        BadFile{"TwoTargets", [](json& p) { p["forces"][4]["body"] = "rod"; },
                "/forces/4/particle: error: force central_gravity: 'particle' stands beside 'body'; leave "
                "one out"},
        BadFile{"NegativeStiffness", [](json& p) { p["forces"][0]["stiffness"] = -1; },
                "/forces/0/stiffness: error: force spring_damper_point_to_point: stiffness is -1.000000; it "
                "is zero or "
                "greater"},
        BadFile{
            "NegativeRadius", [](json& p) { p["contacts"][0]["radius"] = -1; },
            "/contacts/0/radius: error: contact sphere_plane: radius is -1.000000; it is greater than zero"},
        BadFile{"Restitution", [](json& p) { p["contacts"][0]["restitution"] = 2; },
                "/contacts/0/restitution: error: contact sphere_plane: has a restitution of 2.000000; it "
                "lies between "
                "0 and 1"},
        BadFile{
            "Friction", [](json& p) { p["contacts"][0]["friction"] = -1; },
            "/contacts/0/friction: error: contact sphere_plane: has a friction of -1.000000; it is zero or "
            "greater"},
        BadFile{"NoDuration", [](json& p) { p["duration"] = 0; },
                "/duration: error: duration: is 0.000000 s; it is greater than zero"},
        BadFile{"SamplesOutOfOrder", [](json& p) { p["samples"][0]["t"] = 1.5; },
                "/samples/1/t: error: sample: is at t = 1.000000 s, before the one it follows or the start; "
                "samples "
                "stand in the order of time from 0"},
        BadFile{"SensitivityTime", [](json& p) { p["accuracy"]["attitude_sensitivity"]["soon"] = 1; },
                "/accuracy/attitude_sensitivity/soon: error: attitude_sensitivity: 'soon' is not a time in "
                "seconds; "
                "write a number"}),
    [](const auto& test) { return std::string{test.param.name}; });

}  // namespace
}  // namespace pantin::test

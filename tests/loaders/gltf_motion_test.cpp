#include "support/gltf_files.hpp"

using namespace pantin;
using namespace pantin::test;

namespace {

Loaded<Model> load_motion(const std::string& motion) {
  return load_text(R"({"asset": {"version": "2.0"}, "scenes": [{"nodes": [0]}], "nodes": [{"name": "ball",
      "extensions": {"KHR_physics_rigid_bodies": {"motion": )" +
                   motion + "}}}]}");
}

TEST(GltfMotion, GivesMassCentreAndInertia) {
  // inertiaOrientation turns principal axes into node axes: half a right angle about z, I = R diag(1, 3, 3.5)
  // R^T has (1 + 3)/2 on the diagonal and (1 - 3)/2 beside it.
  const Model model = sound(load_motion(R"({"mass": 2.5, "centerOfMass": [0.1, 0.2, 0.3],
      "inertiaDiagonal": [1, 3, 3.5], "inertiaOrientation": [0, 0, 0.3826834323650898, 0.9238795325112867]})"));
  const MassProperties& mass = model.nodes[0].mass.value();
  EXPECT_EQ(mass.mass, 2.5);
  EXPECT_EQ(mass.p_BBcm, Vector3(0.1, 0.2, 0.3));
  Matrix3 expected;
  expected << 2, -1, 0, -1, 2, 0, 0, 0, 3.5;
  EXPECT_LT((mass.I_BBcm_B - expected).cwiseAbs().maxCoeff(),
            1e-15 * 8);  // a few roundings of numbers up to 3.5
  EXPECT_EQ(mass.I_BBcm_B, mass.I_BBcm_B.transpose());
}

TEST(GltfMotion, LeavesInertiaZeroWhereOnlyMassIsGiven) {
  // The draft lets the engine derive what is not given; the model stays as read and says so.
  const Loaded<Model> loaded = load_motion(R"({"mass": 4})");
  EXPECT_EQ(loaded.value->nodes[0].mass->mass, 4.0);
  EXPECT_EQ(loaded.value->nodes[0].mass->I_BBcm_B, Matrix3::Zero());
  EXPECT_EQ(
      ledger(loaded),
      "model.gltf#/nodes/0/extensions/KHR_physics_rigid_bodies/motion: note: node 0 'ball': it gives a mass "
      "without inertia: hand-over derives the inertia from the node's geometry; write inertiaDiagonal to set "
      "it\n");
}

TEST(GltfMotion, ReadsNothingFromNothing) {
  // Without a mass there is no mass; members at their defaults say nothing.
  const Loaded<Model> loaded =
      load_motion(R"({"isKinematic": false, "gravityFactor": 1, "linearVelocity": [0, 0, 0]})");
  EXPECT_FALSE(sound(loaded).nodes[0].mass);
}

TEST(GltfMotion, TellsOfEachPartThatIsNotRead) {
  // One warning a kind with its count; the node and its mass stay.
  const Loaded<Model> loaded = load_text(R"({"asset": {"version": "2.0"}, "scenes": [{"nodes": [0, 1]}],
      "extensionsUsed": ["KHR_physics_rigid_bodies", "KHR_implicit_shapes"],
      "extensions": {"KHR_physics_rigid_bodies": {"physicsJoints": [{}, {}]}, "KHR_implicit_shapes": {"shapes": [{}]}},
      "nodes": [{"extensions": {"KHR_physics_rigid_bodies": {"collider": {}, "motion": {"mass": 1,
          "inertiaDiagonal": [1, 1, 1], "isKinematic": true, "angularVelocity": [0, 1, 0]}}}},
        {"extensions": {"KHR_physics_rigid_bodies": {"collider": {}, "joint": {}, "extras": 1}}}]})");
  const std::string remedy = "not read yet%; set it up through the library or the command line\n";
  const auto line = [&](const std::string& place, const std::string& kind, const std::string& count) {
    std::string text = "model.gltf#" + place + ": warning: " + kind + ": " + remedy;
    return text.replace(text.find('%'), 1, count);
  };
  const std::string node = "/nodes/0/extensions/KHR_physics_rigid_bodies";
  const std::string other = "/nodes/1/extensions/KHR_physics_rigid_bodies";
  EXPECT_EQ(ledger(loaded),
            line(node + "/collider", "KHR_physics_rigid_bodies 'collider'", " (2 times, first here)") +
                line(node + "/motion/angularVelocity", "KHR_physics_rigid_bodies 'angularVelocity'", "") +
                line(node + "/motion/isKinematic", "KHR_physics_rigid_bodies 'isKinematic'", "") +
                "model.gltf#" + other + "/extras: note: extras: not read: data of applications\n" +
                line(other + "/joint", "KHR_physics_rigid_bodies 'joint'", "") +
                line("/extensions/KHR_physics_rigid_bodies/physicsJoints",
                     "KHR_physics_rigid_bodies 'physicsJoints'", " (2 times, first here)") +
                line("/extensions/KHR_implicit_shapes/shapes", "KHR_implicit_shapes 'shapes'", ""));
  EXPECT_EQ(loaded.value->nodes[0].mass->mass, 1.0);
}

TEST(GltfMotion, DoesNotTakeInfinityForNothing) {
  // The draft writes infinity as 0; a body of mass 0 would be the opposite.
  const Loaded<Model> mass = load_motion(R"({"mass": 0})");
  EXPECT_FALSE(mass.value->nodes[0].mass);
  EXPECT_EQ(mass.notes.at(0).problem, "a mass of 0 means infinite, which is not read yet: no mass is kept");
  const Loaded<Model> inertia = load_motion(R"({"mass": 1, "inertiaDiagonal": [1, 0, 1]})");
  EXPECT_EQ(inertia.value->nodes[0].mass->I_BBcm_B, Matrix3::Zero());
  EXPECT_EQ(inertia.notes.at(0).problem,
            "a moment of inertia of 0 means infinite, which is not read yet: the inertia is kept as zero");
  const Loaded<Model> none = load_motion(R"({"inertiaDiagonal": [1, 1, 1]})");
  EXPECT_EQ(none.notes.at(0).problem, "it gives a centre of gravity or inertia but no mass: neither is kept");
}

TEST(GltfMotion, KeepsUnphysicalInertiaWithAWarning) {
  // 1 + 1 < 3: no body has it. It is kept as read; whether it can move is judged at hand-over.
  const Loaded<Model> loaded = load_motion(R"({"mass": 1, "inertiaDiagonal": [1, 1, 3]})");
  ASSERT_TRUE(loaded.value);
  EXPECT_EQ(loaded.value->nodes[0].mass->I_BBcm_B, Matrix3(Vector3(1, 1, 3).asDiagonal()));
  ASSERT_EQ(loaded.notes.size(), 1U);
  EXPECT_EQ(loaded.notes[0].severity, Severity::Warning);
  EXPECT_TRUE(loaded.notes[0].problem.ends_with(": kept as read")) << loaded.notes[0].problem;
}

}  // namespace

#include <cmath>
#include <numbers>

#include "support/gltf_files.hpp"

using namespace pantin;
using namespace pantin::test;

namespace {

/// One animation of node 0 (of two) by samplers; accessors are given before.
std::string with_animation(const std::string& animation, const std::string& nodes = "{}, {}") {
  return "\"nodes\": [" + nodes + "], \"scenes\": [{\"nodes\": [0, 1]}], \"animations\": [" + animation + "]";
}

std::string one_channel(const std::string& path, const std::string& interpolation) {
  return R"({"channels": [{"sampler": 0, "target": {"node": 1, "path": ")" + path +
         R"("}}], "samplers": [{"input": 0, "output": 1, "interpolation": ")" + interpolation + R"("}]})";
}

const Track& only_track(const Model& model) { return model.clips.at(0).tracks.at(0); }

TEST(GltfAnimations, ReadStepLinearAndCubicTranslations) {
  // Keys at 0.5 s and 2.5 s. Halfway, STEP still holds the first key, LINEAR is their mean; the cubic Hermite
  // curve with values 0, 8, tangents b = 3 and a = 1, interval d = 2 gives 0.5 (0 + 8) + d (b - a) / 8 = 4.5
  // and the velocity 1.5 (8 - 0) / d - (b + a) / 4 = 5 (glTF 2.0, appendix C.5).
  const std::vector<float> keys{0.5F, 2.5F};
  for (const std::string interpolation : {"STEP", "LINEAR", "CUBICSPLINE"}) {
    GltfText text;
    text.floats(keys, "SCALAR");
    const bool cubic = interpolation == "CUBICSPLINE";
    text.floats(cubic ? std::vector<float>{9, 9, 9, 0, 1, 2, 3, 0, 0, 1, 0, 0, 8, 1, 2, 9, 9, 9}
                      : std::vector<float>{0, 1, 2, 8, 1, 2},
                "VEC3");
    const Model model =
        sound(load_text(text.embedded(with_animation(one_channel("translation", interpolation)))));
    const Track& track = only_track(model);
    EXPECT_EQ(track.target, 1U);
    EXPECT_EQ(track.channel, Channel::Translation);
    EXPECT_EQ(model.clips[0].duration, 2.5);
    const TrackSample middle = sample(track, 1.5);
    const double expected = cubic ? 4.5 : interpolation == "LINEAR" ? 4.0 : 0.0;
    const double speed = cubic ? 5.0 : interpolation == "LINEAR" ? 4.0 : 0.0;
    EXPECT_DOUBLE_EQ(middle.value[0], expected) << interpolation;
    EXPECT_DOUBLE_EQ(middle.first[0], speed) << interpolation;
    EXPECT_DOUBLE_EQ(middle.value[2], 2.0) << interpolation;
  }
}

TEST(GltfAnimations, InterpolateLinearlyWhereNothingIsSaid) {
  // glTF 2.0, 5.9: the default interpolation is LINEAR.
  GltfText text;
  text.floats({0, 1}, "SCALAR");
  text.floats({1, 1, 1, 3, 1, 1}, "VEC3");
  const Model model = sound(load_text(text.embedded(with_animation(
      R"({"channels": [{"sampler": 0, "target": {"node": 0, "path": "scale"}}], "samplers": [{"input": 0, "output": 1}]})"))));
  EXPECT_EQ(only_track(model).interpolation, Interpolation::Linear);
  EXPECT_EQ(only_track(model).channel, Channel::Scale);
  EXPECT_DOUBLE_EQ(sample(only_track(model), 0.25).value[0], 1.5);
}

TEST(GltfAnimations, ReadTimesAsTheFloatsTheyAre) {
  // 0.1f is 0.100000001490116...: the double that equals the float, which is not the double 0.1.
  GltfText text;
  text.floats({0.1F, 0.7F}, "SCALAR");
  text.floats({0, 0, 0, 1, 1, 1}, "VEC3");
  const Model model = sound(load_text(text.embedded(with_animation(one_channel("translation", "LINEAR")))));
  EXPECT_EQ(only_track(model).times, (std::vector<double>{0.1F, 0.7F}));
  EXPECT_NE(only_track(model).times[0], 0.1);
}

TEST(GltfAnimations, TurnQuaternionsToOurOrder) {
  // A quarter turn about z: [0, 0, s, s] in the file, (s, 0, 0, s) here. Halfway of a slerp from identity is
  // an eighth.
  GltfText text;
  const float s = static_cast<float>(std::sqrt(0.5));
  text.floats({0, 1}, "SCALAR");
  text.floats({0, 0, 0, 1, 0, 0, s, s}, "VEC4");
  const Model model = sound(load_text(text.embedded(with_animation(one_channel("rotation", "LINEAR")))));
  const Track& track = only_track(model);
  ASSERT_EQ(track.values.size(), 8U);
  EXPECT_EQ(track.values[0], 1.0);
  EXPECT_NEAR(track.values[4], std::sqrt(0.5), 1e-15);  // made unit in double, so not the rounded float
  EXPECT_NEAR(track.values[7], std::sqrt(0.5), 1e-15);
  EXPECT_NEAR(sample(track, 0.5).value[3], std::sin(std::numbers::pi / 8), 1e-15);
}

TEST(GltfAnimations, KeepSplineRotationsAsTheyAre) {
  // Tangents belong to the values as written, so these are reordered but not normalised. Constant value, zero
  // tangents: the curve stands still at the unit quaternion.
  GltfText text;
  text.floats({0, 1}, "SCALAR");
  text.floats({1, 2, 3, 4, 0, 0.6F, 0, 0.8F, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0.6F, 0, 0.8F, 5, 6, 7, 8}, "VEC4");
  const Model model = sound(load_text(text.embedded(with_animation(one_channel("rotation", "CUBICSPLINE")))));
  const Track& track = only_track(model);
  EXPECT_EQ((std::vector<double>{track.values.begin(), track.values.begin() + 8}),
            (std::vector<double>{4, 1, 2, 3, 0.8F, 0, 0.6F, 0}));
  EXPECT_EQ(track.values.back(), 7.0);
  EXPECT_NEAR(sample(track, 0.5).value[0], 0.8, 1e-7);  // 0.8f and 0.6f are not quite unit
}

TEST(GltfAnimations, ReadNormalisedIntegerRotations) {
  // glTF 2.0, 3.6.2.2: f = max(c / 127, -1), c / 255, max(c / 32767, -1), c / 65535. A half turn about y is
  // [0, 1, 0, 0], exact in all of them; (c, 0, 0, c) is a quarter turn about x once made unit.
  const auto load = [](const std::string& bytes, int type) {
    GltfText text;
    text.floats({0, 1}, "SCALAR");
    text.accessor(bytes, type, "VEC4", 2, ", \"normalized\": true");
    return sound(load_text(text.embedded(with_animation(one_channel("rotation", "STEP")))));
  };
  const std::vector<Model> models{
      load(packed<std::int8_t>({0, 127, 0, 0, 90, 0, 0, 90}), 5120),
      load(packed<std::uint8_t>({0, 255, 0, 0, 180, 0, 0, 180}), 5121),
      load(packed<std::int16_t>({0, 32767, 0, 0, 23170, 0, 0, 23170}), 5122),
      load(packed<std::uint16_t>({0, 65535, 0, 0, 46341, 0, 0, 46341}), 5123),
  };
  for (const Model& model : models) {
    const std::vector<double>& values = only_track(model).values;
    EXPECT_EQ((std::vector<double>{values.begin(), values.begin() + 4}), (std::vector<double>{0, 0, 1, 0}));
    EXPECT_NEAR(values[4], std::sqrt(0.5), 1e-15);
    EXPECT_NEAR(values[5], std::sqrt(0.5), 1e-15);
  }
}

TEST(GltfAnimations, NormaliseRotationsAloud) {
  // Twice too long: the rotation is clear, the length is not.
  GltfText text;
  text.floats({0, 1}, "SCALAR");
  text.floats({0, 0, 0, 2, 0, 2, 0, 0}, "VEC4");
  const Loaded<Model> loaded = load_text(text.embedded(with_animation(one_channel("rotation", "LINEAR"))));
  EXPECT_EQ(ledger(loaded),
            "model.gltf#/accessors/1: warning: accessor 1: a quaternion is not of unit length: normalised (2 "
            "times, "
            "first here); write unit quaternions x, y, z, w\n");
  EXPECT_EQ(only_track(loaded.value.value()).values, (std::vector<double>{1, 0, 0, 0, 0, 0, 1, 0}));
}

TEST(GltfAnimations, AreNamedAsGivenOrCounted) {
  // clip0 is taken by a given name, so the unnamed ones are clip1 and clip2; the duration is the last key of
  // any track.
  GltfText text;
  text.floats({0, 3}, "SCALAR");
  text.floats({0, 0, 0, 1, 1, 1}, "VEC3");
  const std::string body = one_channel("translation", "LINEAR").substr(1);
  const Model model = sound(load_text(
      text.embedded(with_animation("{" + body + ", {\"name\": \"clip0\", " + body + ", {\"name\": \"\", " +
                                   body + ", {\"name\": \"walk\", " + body))));
  ASSERT_EQ(model.clips.size(), 4U);
  EXPECT_EQ(
      model.clips[0].name + ' ' + model.clips[1].name + ' ' + model.clips[2].name + ' ' + model.clips[3].name,
      "clip1 clip0 clip2 walk");
  EXPECT_EQ(model.clips[3].duration, 3.0);
}

TEST(GltfAnimations, SayWhatTheyDoNotPlay) {
  // Weights and pointers are no motion of nodes; a channel may have no node, or one outside the scene; an
  // animation of which nothing is left is dropped.
  GltfText text;
  text.floats({0, 1}, "SCALAR");
  text.floats({0, 0, 0, 1, 1, 1}, "VEC3");
  const Loaded<Model> loaded = load_text(text.embedded(
      R"("nodes": [{}, {}], "scenes": [{"nodes": [0]}], "animations": [{"name": "face", "samplers": [{"input": 0, "output": 1}],
      "channels": [{"sampler": 0, "target": {"node": 0, "path": "weights"}},
                   {"sampler": 0, "target": {"path": "pointer", "extensions": {"KHR_animation_pointer": {"pointer": "/x"}}}},
                   {"sampler": 0, "target": {"path": "scale"}},
                   {"sampler": 0, "target": {"node": 1, "path": "scale"}}]}])"));
  ASSERT_TRUE(loaded.value);
  EXPECT_TRUE(loaded.value->clips.empty());
  EXPECT_EQ(ledger(loaded),
            "model.gltf#/nodes/1: note: nodes: not in the scene: not loaded; add them to the scene\n"
            "model.gltf#/animations/0/channels/0/target/path: warning: animated 'weights': is not a motion "
            "of nodes: dropped\n"
            "model.gltf#/animations/0/channels/1/target/path: warning: animated 'pointer': is not a motion "
            "of nodes: dropped\n"
            "model.gltf#/animations/0/channels/2/target: note: animation 0 'face': a channel without a "
            "target node is not played\n"
            "model.gltf#/animations/0/channels/3: note: animation 0 'face': a channel whose target node is "
            "not in the scene is "
            "not played\n"
            "model.gltf#/animations/0: warning: animation 0 'face': the animation moves no node of the "
            "scene: dropped\n"
            "model.gltf#/animations/0/channels/1/target/extensions/KHR_animation_pointer: warning: extension "
            "'KHR_animation_pointer': not known to Pantin: what it says is dropped; express it in core glTF "
            "2.0 if it matters\n"
            "model.gltf: note: file: not needed for physics and dropped: 2 of 'accessors' unused, 2 of "
            "'bufferViews' unused, 1 of 'buffers' unused\n");
}

TEST(GltfAnimations, KeepTheMirrorOfATurnedNode) {
  // M = R(t) S with S = diag(1, -1, 1) cannot be told from another R and S by looking at M alone, so the clip
  // itself carries the scale. The other node is not mirrored: nothing is added for it.
  GltfText text;
  text.floats({0, 1}, "SCALAR");
  text.floats({0, 0, 0, 1, 0, 0, 1, 0}, "VEC4");
  const Loaded<Model> loaded = load_text(text.embedded(with_animation(
      R"({"channels": [{"sampler": 0, "target": {"node": 0, "path": "rotation"}},
                       {"sampler": 0, "target": {"node": 1, "path": "rotation"}}], "samplers": [{"input": 0, "output": 1}]})",
      R"({"scale": [1, -1, 1]}, {"scale": [2, 1, 1]})")));
  ASSERT_EQ(loaded.value->clips.at(0).tracks.size(), 3U);
  const Track& added = loaded.value->clips[0].tracks[2];
  EXPECT_EQ(added.target, 0U);
  EXPECT_EQ(added.channel, Channel::Scale);
  EXPECT_EQ(problem_with(added), "");
  EXPECT_EQ(sample(added, 0.5).value[1], -1.0);
  EXPECT_EQ(loaded.value->clips[0].duration, 1.0);
  EXPECT_EQ(
      ledger(loaded),
      "model.gltf#/animations/0: note: animation 0: a node with a negative or zero scale has its constant "
      "rotation or scale added to the clip\n");
}

TEST(GltfAnimations, KeepTheRotationOfANodeScaledFromZero) {
  // A node that grows from nothing keeps its rotation: at scale 0 its matrix does not hold it any more.
  GltfText text;
  text.floats({0, 1}, "SCALAR");
  text.floats({0, 0, 0, 1, 1, 1}, "VEC3");
  const Loaded<Model> loaded = load_text(text.embedded(with_animation(
      one_channel("scale", "LINEAR"), R"({}, {"scale": [0, 0, 0], "rotation": [0, 1, 0, 0]})")));
  ASSERT_EQ(loaded.value->clips.at(0).tracks.size(), 2U);
  EXPECT_EQ(loaded.value->clips[0].tracks[1].channel, Channel::Rotation);
  EXPECT_EQ(loaded.value->clips[0].tracks[1].values, (std::vector<double>{0, 0, 1, 0}));
}

}  // namespace

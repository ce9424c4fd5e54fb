#include "gltf_animations.hpp"

#include <algorithm>
#include <set>

namespace pantin::gltf {
namespace {

/// A unit quaternion in bytes is off by up to half a step of 1/127 in each number.
constexpr double kByteUnitTolerance = 0.02;

Interpolation interpolation_in(Report& report, const JsonValue& sampler) {
  const std::optional<JsonValue> value = member(report, sampler, "interpolation", JsonKind::Text);
  if (!value || value->text() == "LINEAR") return Interpolation::Linear;
  if (value->text() == "STEP") return Interpolation::Step;
  if (value->text() == "CUBICSPLINE") return Interpolation::CubicSpline;
  report.refuse(*value, "there is no interpolation '" + shortened(value->text()) + "'",
                "write LINEAR, STEP or CUBICSPLINE");
}

class AnimationReader {
 public:
  AnimationReader(const Document& document, const SceneNodes& nodes, Accessors& accessors)
      : document_{document}, report_{document.report()}, nodes_{nodes}, accessors_{accessors} {}

  Clip read(const JsonValue& animation) {
    Clip clip{.name = std::string{text_or_empty(report_, animation, "name")}};
    const JsonValue channels = expect(report_, require(report_, animation, "channels"), JsonKind::Array);
    const JsonValue samplers = expect(report_, require(report_, animation, "samplers"), JsonKind::Array);
    animated_.clear();
    for (std::size_t i = 0; i < channels.size(); ++i)
      report_.try_part([&] {
        if (std::optional<Track> track = read_channel(channels.at(i), samplers))
          clip.tracks.push_back(std::move(*track));
      });
    for (const Track& track : clip.tracks) clip.duration = std::max(clip.duration, track.times.back());
    add_constants(animation, clip);
    return clip;
  }

 private:
  std::optional<Track> read_channel(const JsonValue& channel, const JsonValue& samplers) {
    const JsonValue target = expect(report_, require(report_, channel, "target"), JsonKind::Object);
    const JsonValue path = require(report_, target, "path");
    const std::optional<Channel> kind = channel_in(path);
    if (!kind) {
      report_.marks().drop(channel, "is not a motion of nodes");
      return std::nullopt;
    }
    const std::optional<JsonValue> node_value = target.find("node");
    if (!node_value) {
      report_.drop(Severity::Note, target, "a channel without a target node is not played", "");
      return std::nullopt;
    }
    const std::size_t node = document_.index(*node_value, Collection::Nodes);
    if (!animated_.insert({node, *kind}).second)
      report_.refuse(
          channel,
          "the " + std::string{path.text()} + " of node " + std::to_string(node) + " is animated twice",
          "keep one of the channels");
    if (nodes_.transforms[node].by_matrix)
      report_.refuse(
          *node_value,
          "animates " + subject_of(document_.item(Collection::Nodes, node)) + ", which is given by a matrix",
          "give the node by translation, rotation and scale");
    const JsonValue number = require(report_, channel, "sampler");
    const std::uint64_t index = to_size(report_, number);
    if (index >= samplers.size())
      report_.refuse(
          number,
          "refers to sampler " + std::to_string(index) + ", but there are " + std::to_string(samplers.size()),
          "write an index below that");
    const std::int32_t position = nodes_.hierarchy.positions[node];
    if (position < 0) {
      report_.drop(Severity::Note, channel, "a channel whose target node is not in the scene is not played",
                   "");
      return std::nullopt;
    }
    Track track = read_sampler(samplers.at(static_cast<std::size_t>(index)), *kind);
    track.target = static_cast<std::uint32_t>(position);
    if (const std::string problem = problem_with(track); !problem.empty())
      report_.refuse(channel, problem, "export the animation again");
    return track;
  }

  std::optional<Channel> channel_in(const JsonValue& path) {
    const std::string_view text = expect(report_, path, JsonKind::Text).text();
    if (text == "translation") return Channel::Translation;
    if (text == "rotation") return Channel::Rotation;
    if (text == "scale") return Channel::Scale;
    report_.drop(Severity::Warning, "animated '" + shortened(text) + "'", path,
                 "is not a motion of nodes: dropped", "");
    return std::nullopt;
  }

  Track read_sampler(const JsonValue& sampler, Channel channel) {
    expect(report_, sampler, JsonKind::Object);
    const bool rotates = channel == Channel::Rotation;
    Track track{
        .channel = channel, .interpolation = interpolation_in(report_, sampler), .width = rotates ? 4 : 3};
    track.times = accessors_.read(accessor_of(sampler, "input"), AccessorUse::Time).numbers;
    const JsonValue accessor = accessor_of(sampler, "output");
    AccessorData data = accessors_.read(accessor, rotates ? AccessorUse::Rotation : AccessorUse::Vector);
    if (rotates) to_our_quaternions(accessor, data, track.interpolation == Interpolation::CubicSpline);
    track.values = std::move(data.numbers);
    return track;
  }

  JsonValue accessor_of(const JsonValue& sampler, std::string_view key) const {
    return document_.item(Collection::Accessors,
                          document_.index(require(report_, sampler, key), Collection::Accessors));
  }

  /// From x, y, z, w to w, x, y, z. Values that are interpolated on the sphere are made unit; those of
  /// splines are not, because their tangents belong to them as they are.
  void to_our_quaternions(const JsonValue& accessor, AccessorData& data, bool is_spline) {
    const bool in_bytes =
        data.component == ComponentType::Byte || data.component == ComponentType::UnsignedByte;
    for (std::size_t i = 0; i < data.count; ++i) {
      double* q = data.numbers.data() + 4 * i;
      const bool is_tangent = is_spline && i % 3 != 1;
      if (!is_tangent) {
        const Quaternion unit = unit_quaternion(report_, accessor, {q[0], q[1], q[2], q[3]},
                                                in_bytes ? kByteUnitTolerance : kUnitTolerance);
        if (!is_spline) std::ranges::copy(unit.coeffs(), q);
      }
      std::rotate(q, q + 3, q + 4);
    }
  }

  /// A player takes what a clip leaves out of a node from the node's matrix. Where the scale is negative or
  /// zero, rotation and scale cannot be told apart there, so a clip that animates one of them gets the other
  /// as a constant.
  void add_constants(const JsonValue& animation, Clip& clip) const {
    for (const auto& [node, kind] : animated_) {
      const NodeTransform& transform = nodes_.transforms[node];
      const Channel other = kind == Channel::Rotation ? Channel::Scale : Channel::Rotation;
      const std::int32_t position = nodes_.hierarchy.positions[node];
      const bool is_clear = (transform.scale.array() > 0).all() || kind == Channel::Translation;
      if (is_clear || position < 0 || animated_.contains({node, other})) continue;
      const Quaternion& q = transform.rotation;
      const Vector3& s = transform.scale;
      Track track{.target = static_cast<std::uint32_t>(position),
                  .channel = other,
                  .interpolation = Interpolation::Step,
                  .width = other == Channel::Rotation ? 4 : 3,
                  .times = {0.0}};
      track.values = other == Channel::Rotation ? std::vector{q.w(), q.x(), q.y(), q.z()}
                                                : std::vector{s.x(), s.y(), s.z()};
      clip.tracks.push_back(std::move(track));
      report_.tally(
          Severity::Note, animation,
          "a node with a negative or zero scale has its constant rotation or scale added to the clip", "");
    }
  }

  const Document& document_;
  Report& report_;
  const SceneNodes& nodes_;
  Accessors& accessors_;
  std::set<std::pair<std::size_t, Channel>> animated_;  // in the animation being read
};

/// Clips without a name are called clip0, clip1, ..., skipping names that are taken.
void name_clips(std::vector<Clip>& clips) {
  std::set<std::string> taken;
  for (const Clip& clip : clips) taken.insert(clip.name);
  std::size_t next = 0;
  for (Clip& clip : clips) {
    if (!clip.name.empty()) continue;
    do {
      clip.name = "clip" + std::to_string(next++);
    } while (taken.contains(clip.name));
  }
}

}  // namespace

void read_animations(const Document& document, const SceneNodes& nodes, Accessors& accessors, Model& model) {
  Report& report = document.report();
  AnimationReader reader{document, nodes, accessors};
  for (std::size_t i = 0; i < document.count(Collection::Animations); ++i) {
    const JsonValue animation = document.item(Collection::Animations, i);
    report.try_part([&] {
      const std::size_t errors = report.error_count();
      Clip clip = reader.read(animation);
      if (!clip.tracks.empty()) model.clips.push_back(std::move(clip));
      else if (report.error_count() == errors)
        report.drop(Severity::Warning, animation, "the animation moves no node of the scene: dropped", "");
    });
  }
  name_clips(model.clips);
  report.stop_at_errors();
}

}  // namespace pantin::gltf

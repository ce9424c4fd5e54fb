#include <pantin/bridge/loaders/assimp_animation.hpp>

#include <assimp/anim.h>
#include <assimp/scene.h>

#include <algorithm>
#include <cmath>
#include <unordered_map>

namespace pantin::assimp_loader {
namespace {

/// Nodes that bear a name: the first, and how many.
struct Named {
  std::uint32_t first{0};
  int count{0};
};
using Names = std::unordered_map<std::string, Named>;

Names names_of(const Model& model) {
  Names names;
  for (std::size_t i = 0; i < model.nodes.size(); ++i) {
    Named& named = names[model.nodes[i].name];
    if (named.count++ == 0) named.first = static_cast<std::uint32_t>(i);
  }
  return names;
}

void put(std::vector<double>& out, const aiVector3D& v) {
  for (const ai_real x : {v.x, v.y, v.z}) out.push_back(static_cast<double>(x));
}

/// Unit length is restored in double precision; a quaternion without direction stays as it is and is refused
/// below.
void put(std::vector<double>& out, const aiQuaternion& q) {
  const Eigen::Vector4d raw{static_cast<double>(q.w), static_cast<double>(q.x), static_cast<double>(q.y),
                            static_cast<double>(q.z)};
  const Eigen::Vector4d unit = raw.norm() > 0 ? Eigen::Vector4d{raw.normalized()} : raw;
  out.insert(out.end(), unit.data(), unit.data() + 4);
}

/// One clip being made.
struct Context {
  const std::string& place;
  double seconds_per_tick;
  double unit_m;
  Clip& clip;
  std::vector<Diagnostic>& notes;
  std::size_t lost_keys{0};
};

/// Keys of one property of one node. Keys that do not come later than the one before are left out and
/// counted.
template <class Key>
void add_track(Context& c, std::uint32_t target, const std::string& node, Channel channel, const Key* keys,
               unsigned count) {
  if (count == 0) return;
  Track track{.target = target,
              .channel = channel,
              .interpolation = Interpolation::Linear,
              .width = channel == Channel::Rotation ? 4 : 3};
  for (unsigned i = 0; i < count; ++i) {
    const double time = keys[i].mTime * c.seconds_per_tick;
    if (!track.times.empty() && !(time > track.times.back())) {
      ++c.lost_keys;
      continue;
    }
    track.times.push_back(time);
    put(track.values, keys[i].mValue);
  }
  if (channel == Channel::Translation) {
    for (double& value : track.values) value *= c.unit_m;
  }
  if (const std::string problem = problem_with(track); !problem.empty()) {
    c.notes.push_back({Severity::Warning, c.place, "animation '" + c.clip.name + "', node '" + node + '\'',
                       problem + "; track dropped", ""});
    return;
  }
  c.clip.duration = std::max(c.clip.duration, track.times.back());
  c.clip.tracks.push_back(std::move(track));
}

void add_channel(Context& c, const aiNodeAnim& channel, const Names& names) {
  const std::string node{channel.mNodeName.data, channel.mNodeName.length};
  const std::string subject = "animation '" + c.clip.name + '\'';
  const auto found = names.find(node);
  if (found == names.end()) {
    c.notes.push_back({Severity::Warning, c.place, subject,
                       "moves node '" + node + "', which does not exist; dropped",
                       "check the names in the file"});
    return;
  }
  if (found->second.count > 1) {
    c.notes.push_back({Severity::Warning, c.place, subject,
                       "moves node '" + node + "', a name that " + std::to_string(found->second.count) +
                           " nodes bear; the first is moved",
                       "give nodes different names"});
  }
  const std::uint32_t target = found->second.first;
  add_track(c, target, node, Channel::Translation, channel.mPositionKeys, channel.mNumPositionKeys);
  add_track(c, target, node, Channel::Rotation, channel.mRotationKeys, channel.mNumRotationKeys);
  add_track(c, target, node, Channel::Scale, channel.mScalingKeys, channel.mNumScalingKeys);
}

}  // namespace

void add_clips(const aiScene& scene, const std::string& place, Model& model, std::vector<Diagnostic>& notes) {
  const Names names = names_of(model);
  for (unsigned i = 0; i < scene.mNumAnimations; ++i) {
    const aiAnimation& animation = *scene.mAnimations[i];
    Clip clip{.name{animation.mName.data, animation.mName.length}};
    if (clip.name.empty()) clip.name = "animation " + std::to_string(i);
    const double ticks = animation.mTicksPerSecond;
    const bool stated = std::isfinite(ticks) && ticks > 0;
    Context c{place, 1 / (stated ? ticks : 25.0), model.unit_m, clip, notes};
    const std::string subject = "animation '" + clip.name + '\'';
    if (!stated) {
      notes.push_back(
          {Severity::Note, place, subject, "does not say its rate: 25 ticks per second are taken", ""});
    }
    for (unsigned k = 0; k < animation.mNumChannels; ++k) add_channel(c, *animation.mChannels[k], names);
    if (c.lost_keys > 0) {
      notes.push_back({Severity::Warning, place, subject,
                       std::to_string(c.lost_keys) + " keys are not later than the one before; dropped", ""});
    }
    if (animation.mNumMeshChannels + animation.mNumMorphMeshChannels > 0) {
      notes.push_back(
          {Severity::Warning, place, subject, "changes the form of meshes, which is not kept; dropped", ""});
    }
    if (clip.tracks.empty()) {
      notes.push_back({Severity::Warning, place, subject, "moves no node; dropped", ""});
    } else {
      model.clips.push_back(std::move(clip));
    }
  }
}

}  // namespace pantin::assimp_loader

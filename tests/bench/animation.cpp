// What playing costs: 1,000 characters of 60 nodes, each with translation, rotation and scale tracks of 31
// keys a second, at different times of one clip of two seconds, advanced by 1/60 s a frame, beside a kernel
// in the manner of ozz-animation (animation_peer.hpp). Interleaved in one run, minimum of several repeats,
// ratios. Pantin: double precision, slerp, local matrices written into the scene. Peer: single precision (and
// double), nlerp, local matrices written into an array.
#include <cstdio>
#include <limits>
#include <random>

#include <pantin/scenegraph/player.hpp>

#include "animation_peer.hpp"
#include "bench/cpu_time.hpp"

namespace pantin::bench {
namespace {

constexpr std::size_t kCharacters = 1000, kNodes = 60;
constexpr double kFrame = 1.0 / 60, kDuration = 2;
constexpr int kRepeats = 40;

using bench::cpu_seconds;

/// The least time of several.
class Least {
 public:
  template <class Work>
  void measure(const Work& work) {
    const double start = cpu_seconds();
    work();
    least_ = std::min(least_, cpu_seconds() - start);
  }
  [[nodiscard]] double ns_a_node() const { return 1e9 * least_ / double(kCharacters * kNodes); }

 private:
  double least_{std::numeric_limits<double>::infinity()};
};

/// Keys at uneven times, as an optimiser leaves them; rotations turn by some 0.1 rad from key to key.
Track make_track(std::uint32_t target, Channel channel, std::mt19937_64& random) {
  std::uniform_real_distribution<double> uniform{-1, 1};
  Track track{.target = target, .channel = channel, .width = channel == Channel::Rotation ? 4 : 3};
  const int keys = static_cast<int>(31 * kDuration);
  Quaternion q = Quaternion::Identity();
  Vector3 p{uniform(random), uniform(random), uniform(random)};
  for (int k = 0; k <= keys; ++k) {
    const double jitter = k == 0 || k == keys ? 0 : 0.3 * uniform(random);
    track.times.push_back(kDuration * (k + jitter) / keys);
    const Vector3 step{uniform(random), uniform(random), uniform(random)};
    q = (q * Quaternion{1, 0.05 * step.x(), 0.05 * step.y(), 0.05 * step.z()}).normalized();
    p += 0.1 * step;
    if (channel == Channel::Rotation) track.values.insert(track.values.end(), {q.w(), q.x(), q.y(), q.z()});
    else if (channel == Channel::Translation) track.values.insert(track.values.end(), {p.x(), p.y(), p.z()});
    else
      for (int j = 0; j < 3; ++j) track.values.push_back(1 + 0.1 * step[j]);
  }
  return track;
}

Clip make_clip() {
  std::mt19937_64 random{1};
  Clip clip{.name = "walk", .duration = kDuration};
  for (std::uint32_t n = 0; n < kNodes; ++n)
    for (const Channel channel : {Channel::Translation, Channel::Rotation, Channel::Scale})
      clip.tracks.push_back(make_track(n, channel, random));
  return clip;
}

template <class Real>
PeerClip<Real> peer_clip(const Clip& clip) {
  PeerClip<Real> out{.duration = static_cast<Real>(kDuration), .tracks = kNodes};
  for (const Track& track : clip.tracks) {
    std::vector<PeerKey<Real>>& channel = out.channels[static_cast<std::size_t>(track.channel)];
    const std::size_t width = static_cast<std::size_t>(track.width);
    for (std::size_t k = 0; k < track.times.size(); ++k) {
      PeerKey<Real> key{.time = static_cast<Real>(track.times[k]), .track = track.target};
      key.needed = k == 0 ? -2 : k == 1 ? -1 : static_cast<Real>(track.times[k - 1]);
      for (std::size_t j = 0; j < width; ++j) key.value[j] = static_cast<Real>(track.values[width * k + j]);
      channel.push_back(key);
    }
  }
  for (std::vector<PeerKey<Real>>& channel : out.channels)
    std::stable_sort(channel.begin(), channel.end(), [](const PeerKey<Real>& a, const PeerKey<Real>& b) {
      return a.needed != b.needed ? a.needed < b.needed : a.track < b.track;
    });
  return out;
}

/// Where character i is in its clip.
double phase(std::size_t i) { return kDuration * double(i) / kCharacters; }

template <class Real>
struct Peer {
  explicit Peer(const Clip& given)
      : clip{peer_clip<Real>(given)}, contexts(kCharacters, PeerContext<Real>{clip}) {}

  void sample(double now) {
    for (std::size_t i = 0; i < kCharacters; ++i)
      contexts[i].sample(static_cast<Real>(std::fmod(phase(i) + now, kDuration)), poses[i]);
  }
  void compose() {
    for (std::size_t i = 0; i < kCharacters; ++i)
      for (std::size_t g = 0; g < kNodes / 4; ++g)
        to_matrices(poses[i][g], matrices.data() + 12 * (kNodes * i + 4 * g));
  }

  PeerClip<Real> clip;
  std::vector<PeerContext<Real>> contexts;
  std::vector<std::vector<PeerPose<Real>>> poses{kCharacters, std::vector<PeerPose<Real>>(kNodes / 4)};
  std::vector<Real> matrices = std::vector<Real>(12 * kNodes * kCharacters);
  Least sampling{}, composing{};

  void frame(double now) {
    sampling.measure([&] { sample(now); });
    composing.measure([&] { compose(); });
  }
};

struct Ours {
  explicit Ours(const Clip& given) {
    const SharedClip shared{given};
    for (std::size_t i = 0; i < kCharacters; ++i) {
      std::vector<NodeId> nodes{scene.create(scene.root(), "hips")};
      while (nodes.size() < kNodes) nodes.push_back(scene.create(nodes[nodes.size() / 2], "bone"));
      players.emplace_back(scene, shared, nodes, PlayerSettings{.begin = -phase(i)});
      ids.insert(ids.end(), nodes.begin(), nodes.end());
    }
  }
  void frame(double now) {
    applying.measure([&] {
      for (Player& player : players) {
        player.advance_to(now);
        player.apply(scene);
      }
    });
    deriving.measure([&] {
      for (std::size_t k = 0; k < ids.size(); ++k)
        sum += players[k / kNodes].motion(ids[k], now).second(0, 0);
    });
  }

  Scene scene{};
  std::vector<Player> players{};
  std::vector<NodeId> ids{};
  Least applying{}, deriving{};
  double sum{0};
};

template <class Real>
double difference(const Ours& ours, const Peer<Real>& peer) {
  double most = 0;
  for (std::size_t k = 0; k < ours.ids.size(); ++k) {
    const Affine M = ours.scene.local(ours.ids[k]);
    for (std::size_t i = 0; i < 12; ++i)
      most = std::max(
          most, std::abs(M(Eigen::Index(i / 4), Eigen::Index(i % 4)) - double(peer.matrices[12 * k + i])));
  }
  return most;
}

void run() {
  const Clip clip = make_clip();
  Ours ours{clip};
  Peer<float> single{clip};
  Peer<double> twice{clip};
  double now = 0;
  for (int repeat = 0; repeat < kRepeats; ++repeat, now += kFrame) {
    ours.frame(now);
    single.frame(now);
    twice.frame(now);
  }
  const double mine = ours.applying.ns_a_node();
  std::printf("1,000 characters x 60 nodes, ns a node and frame, minimum of %d frames:\n", kRepeats);
  std::printf("  Pantin, double, advance and write local matrices   %6.1f\n", mine);
  std::printf("  Pantin, the same with first and second derivative  %6.1f\n", ours.deriving.ns_a_node());
  const auto line = [&](const char* name, const auto& peer) {
    const double all = peer.sampling.ns_a_node() + peer.composing.ns_a_node();
    std::printf(
        "  SoA peer, %s: sampling %.1f, with local matrices %.1f; Pantin / peer %.2f; matrices differ by "
        "%.1e\n",
        name, peer.sampling.ns_a_node(), all, mine / all, difference(ours, peer));
  };
  line("float ", single);
  line("double", twice);
}

}  // namespace
}  // namespace pantin::bench

int main() { pantin::bench::run(); }

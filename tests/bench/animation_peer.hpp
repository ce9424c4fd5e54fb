#pragma once
// The peer of pantin_bench_animation: sampling in the manner of ozz-animation, written anew from its
// published description (guillaumeblanc.github.io/ozz-animation, "Animation runtime"), not its sources. What
// is kept of it:
//   - the keys of all tracks of a channel in one array, sorted by the time at which a sampler going forwards
//   needs
//     them, so that it walks the array from one end to the other;
//   - a context per character: a cursor into that array, for each track its two keys, a mark for each group
//   of
//     four tracks whose keys have changed, and those keys unpacked as structures of four;
//   - interpolation of four tracks at once, in single precision: lerp, and for rotations nlerp with an
//   estimated
//     reciprocal square root; out come structures of four transforms.
// What is not: keys are not compressed to 16 bits a number, which makes unpacking cheaper here than there and
// the clip larger. `Real` may be double too, with a true square root.
#include <xmmintrin.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <type_traits>
#include <vector>

namespace pantin::bench {

template <class Real>
struct Four {
  typedef Real Lanes __attribute__((vector_size(4 * sizeof(Real))));
};
template <class Real>
using Lanes = typename Four<Real>::Lanes;

/// One key: what it is for, and when it is needed.
template <class Real>
struct PeerKey {
  Real time{0};
  Real needed{0};  ///< time of the key before it on its track
  std::uint32_t track{0};
  std::array<Real, 4> value{};
};

template <class Real>
struct PeerClip {
  Real duration{1};
  std::size_t tracks{0};  ///< a multiple of four
  /// All keys of translations, rotations and scales; the first two keys of each track come first.
  std::array<std::vector<PeerKey<Real>>, 3> channels{};
};

/// Four transforms: numbers 0..2 translation, 3..6 rotation (w, x, y, z), 7..9 scale.
template <class Real>
using PeerPose = std::array<Lanes<Real>, 10>;

template <class Real>
class PeerContext {
 public:
  explicit PeerContext(const PeerClip<Real>& clip) : clip_{&clip} {
    for (State& state : states_) {
      state.keys.resize(clip.tracks);
      state.outdated.resize(clip.tracks / 4);
      state.groups.resize(clip.tracks / 4);
    }
    restart();
  }

  void sample(Real time, std::vector<PeerPose<Real>>& out) {
    if (time < time_) restart();
    time_ = time;
    std::size_t first = 0;
    for (std::size_t c = 0; c < 3; ++c) {
      advance(c);
      if (c == 1) rotations(out);
      else numbers(c, first, out);
      first += c == 0 ? 3 : 4;
    }
  }

 private:
  /// Two keys of four tracks.
  struct Group {
    Lanes<Real> begin, inverse_span;
    std::array<Lanes<Real>, 4> left, right;
  };
  struct State {
    std::size_t cursor{0};
    std::vector<std::array<std::uint32_t, 2>> keys{};
    std::vector<std::uint8_t> outdated{};
    std::vector<Group> groups{};
  };

  void restart() {
    for (State& state : states_) {
      state.cursor = 2 * clip_->tracks;
      for (std::size_t t = 0; t < clip_->tracks; ++t)
        state.keys[t] = {static_cast<std::uint32_t>(t), static_cast<std::uint32_t>(clip_->tracks + t)};
      std::fill(state.outdated.begin(), state.outdated.end(), std::uint8_t{1});
    }
    time_ = 0;
  }

  void advance(std::size_t c) {
    State& state = states_[c];
    const std::vector<PeerKey<Real>>& keys = clip_->channels[c];
    while (state.cursor < keys.size() && keys[state.cursor].needed <= time_) {
      const std::uint32_t track = keys[state.cursor].track;
      state.keys[track] = {state.keys[track][1], static_cast<std::uint32_t>(state.cursor)};
      state.outdated[track / 4] = 1;
      ++state.cursor;
    }
    for (std::size_t g = 0; g < state.groups.size(); ++g) {
      if (state.outdated[g] == 0) continue;
      state.outdated[g] = 0;
      unpack(c, g);
    }
  }

  void unpack(std::size_t c, std::size_t g) {
    State& state = states_[c];
    Group& group = state.groups[g];
    for (std::size_t lane = 0; lane < 4; ++lane) {
      const PeerKey<Real>& left = clip_->channels[c][state.keys[4 * g + lane][0]];
      const PeerKey<Real>& right = clip_->channels[c][state.keys[4 * g + lane][1]];
      group.begin[lane] = left.time;
      group.inverse_span[lane] = 1 / (right.time - left.time);
      for (std::size_t j = 0; j < 4; ++j) {
        group.left[j][lane] = left.value[j];
        group.right[j][lane] = right.value[j];
      }
    }
  }

  void numbers(std::size_t c, std::size_t first, std::vector<PeerPose<Real>>& out) const {
    for (std::size_t g = 0; g < out.size(); ++g) {
      const Group& group = states_[c].groups[g];
      const Lanes<Real> u = (time_ - group.begin) * group.inverse_span;
      for (std::size_t j = 0; j < 3; ++j)
        out[g][first + j] = group.left[j] + u * (group.right[j] - group.left[j]);
    }
  }

  void rotations(std::vector<PeerPose<Real>>& out) const {
    for (std::size_t g = 0; g < out.size(); ++g) {
      const Group& group = states_[1].groups[g];
      const Lanes<Real> u = (time_ - group.begin) * group.inverse_span;
      std::array<Lanes<Real>, 4> q;
      for (std::size_t j = 0; j < 4; ++j) q[j] = group.left[j] + u * (group.right[j] - group.left[j]);
      const Lanes<Real> square = q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3];
      Lanes<Real> inverse;
      if constexpr (std::is_same_v<Real, float>) {
        inverse = _mm_rsqrt_ps(square);
        inverse = inverse * (1.5f - 0.5f * square * inverse * inverse);
      } else {
        for (std::size_t lane = 0; lane < 4; ++lane) inverse[lane] = 1 / std::sqrt(square[lane]);
      }
      for (std::size_t j = 0; j < 4; ++j) out[g][3 + j] = q[j] * inverse;
    }
  }

  const PeerClip<Real>* clip_;
  std::array<State, 3> states_{};
  Real time_{0};
};

/// Four local matrices by rows, 3x4, from four transforms.
template <class Real>
void to_matrices(const PeerPose<Real>& pose, Real* out) {
  const Lanes<Real>&w = pose[3], &x = pose[4], &y = pose[5], &z = pose[6];
  const Lanes<Real> xx = x * x, yy = y * y, zz = z * z, wx = w * x, wy = w * y, wz = w * z, xy = x * y,
                    xz = x * z, yz = y * z;
  const Lanes<Real> rows[12] = {
      (1 - 2 * (yy + zz)) * pose[7], 2 * (xy - wz) * pose[8],       2 * (xz + wy) * pose[9],       pose[0],
      2 * (xy + wz) * pose[7],       (1 - 2 * (xx + zz)) * pose[8], 2 * (yz - wx) * pose[9],       pose[1],
      2 * (xz - wy) * pose[7],       2 * (yz + wx) * pose[8],       (1 - 2 * (xx + yy)) * pose[9], pose[2]};
  for (std::size_t lane = 0; lane < 4; ++lane)
    for (std::size_t i = 0; i < 12; ++i) out[12 * lane + i] = rows[i][lane];
}

}  // namespace pantin::bench

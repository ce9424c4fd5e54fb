#pragma once
// Private to scenegraph. Blends values of one channel, by the formulas of player.hpp.
#include <cstdint>
#include <span>

#include <pantin/scenegraph/quaternion_jet.hpp>
#include <pantin/scenegraph/track_parts.hpp>

namespace pantin {

/// The value of a channel: its first numbers count.
template <class S>
using ChannelValue = std::array<S, 7>;

/// Which sides of their switches (shorter way round, sum of weights above 1) the blends of a node are on. The
/// blend is smooth while this stays the same.
class Switches {
 public:
  void note(bool is_on) noexcept { bits_ = (bits_ << 1 | bits_ >> 63) ^ std::uint64_t{is_on}; }
  friend bool operator==(const Switches&, const Switches&) = default;

 private:
  std::uint64_t bits_{0};
};

/// At which side of a time something is blended, and where switches are noted (nullptr: nowhere).
struct BlendSide {
  bool is_before{false};
  Switches* switches{nullptr};

  template <class S>
  [[nodiscard]] bool is_on(const S& x) const {
    const bool on = is_positive(x, is_before);
    if (switches != nullptr) switches->note(on);
    return on;
  }
};

template <class S>
Numbers4<S> rotation_of(const ChannelValue<S>& x, const TrackPart& part) {
  const std::size_t i = static_cast<std::size_t>(part.first);
  return {x[i], x[i + 1], x[i + 2], x[i + 3]};
}

template <class S>
void set_rotation(ChannelValue<S>& x, const TrackPart& part, const Numbers4<S>& q) {
  for (std::size_t j = 0; j < 4; ++j) x[static_cast<std::size_t>(part.first) + j] = q[j];
}

/// The Override plays of one layer on one channel of one node.
template <class S>
class PoseMixer {
 public:
  PoseMixer(std::span<const TrackPart> parts, const BlendSide& side) : parts_{parts}, side_{side} {}

  void add(const ChannelValue<S>& x, const S& weight) {
    if (is_exactly(weight, 0)) return;
    if (count_ == 0) {
      first_ = x;
      total_ = weight;
      count_ = 1;
      return;
    }
    if (count_ == 1) sum_ = ChannelValue<S>{}, add_weighted(first_, total_);
    add_weighted(x, weight);
    total_ = total_ + weight;
    ++count_;
  }

  /// Lays what was added over `below`.
  void finish(ChannelValue<S>& below) {
    if (count_ == 0) return;
    if (count_ == 1 && is_exactly(total_, 1)) {
      below = first_;
      return;
    }
    if (count_ == 1) sum_ = ChannelValue<S>{}, add_weighted(first_, total_);
    const bool covers = side_.is_on(total_ - S{1});
    if (!covers) add_weighted(below, S{1} - total_);
    for (const TrackPart& part : parts_) {
      if (part.is_rotation) {
        const Numbers4<S> p = rotation_of(sum_, part);
        // Opposite quaternions may cancel: there is no mean of them, and the first one is as good as any.
        const bool cancels = value_of(dot(p, p)) < 1e-18;
        set_rotation(below, part, cancels ? at_rest(rotation_of(first_, part)) : unit(p));
        continue;
      }
      for (std::size_t i = begin(part); i < end(part); ++i) below[i] = covers ? sum_[i] / total_ : sum_[i];
    }
  }

 private:
  static std::size_t begin(const TrackPart& part) { return static_cast<std::size_t>(part.first); }
  static std::size_t end(const TrackPart& part) { return static_cast<std::size_t>(part.first + part.count); }
  static Numbers4<S> at_rest(const Numbers4<S>& q) {
    return {value_of(q[0]), value_of(q[1]), value_of(q[2]), value_of(q[3])};
  }

  void add_weighted(const ChannelValue<S>& x, const S& weight) {
    for (const TrackPart& part : parts_) {
      S signed_weight = weight;
      if (part.is_rotation && !side_.is_on(dot(rotation_of(first_, part), rotation_of(x, part))))
        signed_weight = -weight;
      for (std::size_t i = begin(part); i < end(part); ++i) sum_[i] = sum_[i] + signed_weight * x[i];
    }
  }

  std::span<const TrackPart> parts_;
  BlendSide side_;
  ChannelValue<S> first_{}, sum_{};
  S total_{};
  int count_{0};
};

enum class AddedAs { Difference, Ratio };

/// Lays an Additive play over `below`: the difference of x from `reference`, by weight.
template <class S>
void add_on_top(std::span<const TrackPart> parts, AddedAs added, const ChannelValue<S>& x,
                const ChannelValue<double>& reference, const S& weight, const BlendSide& side,
                ChannelValue<S>& below) {
  for (const TrackPart& part : parts) {
    if (part.is_rotation) {
      const Numbers4<double> r = rotation_of(reference, part);
      Numbers4<S> turn = product(conjugate(Numbers4<S>{r[0], r[1], r[2], r[3]}), rotation_of(x, part));
      if (!side.is_on(turn[0])) turn = {-turn[0], -turn[1], -turn[2], -turn[3]};
      set_rotation(below, part, product(rotation_of(below, part), power(turn, weight)));
      continue;
    }
    const std::size_t begin = static_cast<std::size_t>(part.first);
    for (std::size_t i = begin; i < begin + static_cast<std::size_t>(part.count); ++i) {
      if (added == AddedAs::Ratio) below[i] = below[i] * (S{1} + weight * (x[i] / S{reference[i]} - S{1}));
      else below[i] = below[i] + weight * (x[i] - S{reference[i]});
    }
  }
}

}  // namespace pantin

#pragma once
// Private to scenegraph. Local matrices with their time derivatives from samples of tracks.
#include <pantin/scenegraph/player.hpp>
#include <pantin/scenegraph/trs.hpp>

namespace pantin {

/// Samples of the channels of one node; a null one rests.
struct TrsSamples {
  const TrackSample* translation{nullptr};
  const TrackSample* rotation{nullptr};
  const TrackSample* scale{nullptr};
};

/// M = T R S with derivatives through the product; `rest` stands for the channels without sample.
[[nodiscard]] LocalMotion trs_motion(const Trs& rest, const TrsSamples& samples);

/// M = M_PJ T(value) M_JN with derivatives; the sample has as many numbers as the link's value.
[[nodiscard]] LocalMotion link_motion(const Link& link, const TrackSample& sample);

}  // namespace pantin

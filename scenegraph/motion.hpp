#pragma once
// Private to scenegraph. Local matrices with their time derivatives from the values of channels.
#include <pantin/scenegraph/player.hpp>
#include <pantin/scenegraph/pose_mixer.hpp>

namespace pantin {

/// Values of all channels of a node, by Channel.
template <class S>
using NodePose = std::array<ChannelValue<S>, 4>;

template <class S>
[[nodiscard]] ChannelValue<S>& at(NodePose<S>& pose, Channel channel) {
  return pose[static_cast<std::size_t>(channel)];
}
template <class S>
[[nodiscard]] const ChannelValue<S>& at(const NodePose<S>& pose, Channel channel) {
  return pose[static_cast<std::size_t>(channel)];
}

/// M = T R S with derivatives through the product.
[[nodiscard]] LocalMotion trs_motion(const NodePose<Jet>& pose);
/// The same matrix to the last bit, without derivatives.
[[nodiscard]] Eigen::Matrix<double, 3, 4> trs_matrix(const NodePose<double>& pose);

/// M = M_PJ T(value) M_JN with derivatives; the value has as many numbers as the link's.
[[nodiscard]] LocalMotion link_motion(const Link& link, const ChannelValue<Jet>& value);
[[nodiscard]] LinkValue link_value(const Link& link, const ChannelValue<double>& value);

/// A * M * B for a motion M between constant matrices.
[[nodiscard]] LocalMotion between(const Affine& A, const LocalMotion& M, const Affine& B);

}  // namespace pantin

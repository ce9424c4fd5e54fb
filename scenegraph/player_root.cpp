// Root motion: M_PC(t) = M_PC(t0) K inverse(D(t0)) D(t) inverse(K); of several plays, the weighted mean of
// their displacements inverse(D(t0)) D(t), each with its weight at the middle of t0 and t.
#include <cmath>

#include <pantin/scenegraph/expects.hpp>
#include <pantin/scenegraph/player_impl.hpp>

namespace pantin {
namespace {

/// inverse(D(from)) D(to), differentiated with respect to `to`.
Rigid<Jet> displacement(const Play& play, double from, double to, KeySide side) {
  const Rigid<double> back = play.root->motion<double>(play.clock.read(from, KeySide::After)).inverse();
  Rigid<Jet> start;
  for (std::size_t i = 0; i < 3; ++i) start.p[i] = back.p[i];
  for (std::size_t i = 0; i < 4; ++i) start.q[i] = back.q[i];
  return start * play.root->motion<Jet>(play.clock.read(to, side));
}

LocalMotion motion_of(const Rigid<Jet>& X) {
  NodePose<Jet> pose;
  for (std::size_t i = 0; i < 3; ++i) {
    at(pose, Channel::Translation)[i] = X.p[i];
    at(pose, Channel::Scale)[i] = 1;
  }
  for (std::size_t i = 0; i < 4; ++i) at(pose, Channel::Rotation)[i] = X.q[i];
  return trs_motion(pose);
}

/// Weight at the middle of an advance, differentiated with respect to its end.
Jet middle_weight(const Play& play, double from, double to, KeySide side) {
  const CurveSample w = sample(play.settings.weight, from + (to - from) / 2, side);
  return {w.value, w.first / 2, w.second / 4};
}

bool is_exact(const Carrier& carrier) {
  if (carrier.plays.size() != 1) return false;
  const Curve& weight = carrier.plays.front()->settings.weight;
  return weight.is_constant() && sample(weight, 0).value == 1;
}

/// The weighted mean of the displacements.
LocalMotion mean_displacement(const Carrier& carrier, double to, KeySide side) {
  static constexpr TrackPart kPose[] = {{0, 3, false}, {3, 4, true}};
  PoseMixer<Jet> mixer{kPose, {.is_before = side == KeySide::Before}};
  ChannelValue<Jet> mean{0, 0, 0, 1, 0, 0, 0};
  for (const Play* play : carrier.plays) {
    const Rigid<Jet> X = displacement(*play, carrier.anchor, to, side);
    mixer.add({X.p[0], X.p[1], X.p[2], X.q[0], X.q[1], X.q[2], X.q[3]},
              middle_weight(*play, carrier.anchor, to, side));
  }
  mixer.finish(mean);
  return motion_of({{mean[0], mean[1], mean[2]}, {mean[3], mean[4], mean[5], mean[6]}});
}

}  // namespace

LocalMotion Player::Impl::motion(const Carrier& carrier, double play_time, KeySide side) const {
  const RootExtraction& root = *carrier.plays.front()->root;
  const LocalMotion X = is_exact(carrier)
                            ? motion_of(displacement(*carrier.plays.front(), carrier.anchor, play_time, side))
                            : mean_displacement(carrier, play_time, side);
  return between(carrier.M_anchor * root.K, X, root.K_inverse);
}

// A carrier that one play moves stays anchored where that began, so that nothing is rounded at each advance.
void Player::Impl::move_carriers(double to) {
  for (Carrier& carrier : carriers) {
    if (is_exact(carrier)) continue;
    carrier.M_anchor.affine() = motion(carrier, to, KeySide::After).value;
    carrier.anchor = to;
  }
}

Affine Player::root_displacement(PlayId id, double from, double to) const {
  const Play& play = impl_->at(id);
  PANTIN_EXPECTS(play.root.has_value(), "play " + std::to_string(id.number) + " has no root motion; give " +
                                            "PlayerSettings a root whose source it animates");
  PANTIN_EXPECTS(std::isfinite(from) && std::isfinite(to), "root motion between times that are not finite");
  Affine X = Affine::Identity();
  X.affine() = motion_of(displacement(play, from, to, KeySide::After)).value;
  return X;
}

void Player::place(NodeId id, const Affine& M_PN) {
  Carrier* carrier = impl_->carrier(id);
  PANTIN_EXPECTS(carrier != nullptr, called(id) + " carries no root motion; ask is_carrier() first");
  PANTIN_EXPECTS(M_PN.matrix().allFinite(), "the matrix to place a carrier at is not finite");
  carrier->M_anchor = M_PN;
  carrier->anchor = impl_->time;
}

}  // namespace pantin

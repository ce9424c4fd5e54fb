#include <pantin/bridge/node_driver.hpp>

#include <algorithm>
#include <limits>

namespace pantin {
namespace {

KeySide key_side(Side side) { return side == Side::Before ? KeySide::Before : KeySide::After; }

LocalMotion local_motion(const ChainPart& part, double t, Side side) {
  return part.player == nullptr ? part.rest : part.player->motion(part.node, t, key_side(side));
}

bool is_constant(const ChainPart& part) { return part.player == nullptr && part.blend == nullptr; }

/// A part's motion seen from the rigid frame of the node above, whose affine motion is split into X and S.
SplitMotion seen_from(const SplitMotion& above, const LocalMotion& local) {
  LocalMotion S;
  S.value << above.S, Vector3::Zero();
  S.first << above.S1, Vector3::Zero();
  S.second << above.S2, Vector3::Zero();
  return split(S * local);
}

}  // namespace

void NodeMotion::set_chain(const Affine& M_FA, std::vector<ChainPart> parts) {
  base_ = constant_motion(M_FA);
  parts_.clear();
  // Runs of parts that stand still are multiplied out, but the last part stays alone: blends begin at it.
  for (std::size_t k = 0; k < parts.size(); ++k) {
    const bool last = k + 1 == parts.size();
    if (!last && is_constant(parts[k]) && parts_.empty()) {
      base_ = base_ * parts[k].rest;
    } else if (!last && is_constant(parts[k]) && is_constant(parts_.back())) {
      parts_.back().rest = parts_.back().rest * parts[k].rest;
    } else {
      parts_.push_back(parts[k]);
    }
  }
  still_.reset();
  if (!is_played()) still_ = split(affine(0, Side::After));
}

LocalMotion NodeMotion::affine(double t, Side side, std::size_t parts) const {
  LocalMotion M = base_;
  for (std::size_t k = 0; k < parts; ++k) {
    const ChainPart& part = parts_[k];
    const LocalMotion local = local_motion(part, t, side);
    if (part.blend == nullptr || !part.blend->active(t, side)) {
      M = M * local;
      continue;
    }
    const SplitMotion above = split(M);
    const SplitMotion blended = part.blend->applied(seen_from(above, local), t, side);
    SplitMotion rigid;
    rigid.X = above.X;
    M = joined(rigid) * joined(blended);
  }
  return M;
}

SplitMotion NodeMotion::in_parent(double t, Side side) const {
  return seen_from(split(parent(t, side)), local_motion(parts_.back(), t, side));
}

SplitMotion NodeMotion::split_at(double t, Side side) const {
  const SplitMotion motion = still_ ? *still_ : split(affine(t, side));
  return move_ ? move_->applied(motion, t, side) : motion;
}

double NodeMotion::next_break(double t) const {
  double next = std::numeric_limits<double>::infinity();
  for (const ChainPart& part : parts_) {
    if (part.player != nullptr) next = std::min(next, part.player->next_break(part.node, t));
  }
  if (move_ && move_->end() > t) next = std::min(next, move_->end());
  return next;
}

bool NodeMotion::is_played() const noexcept {
  return std::any_of(parts_.begin(), parts_.end(),
                     [](const ChainPart& part) { return part.player != nullptr || part.blend != nullptr; });
}

bool NodeMotion::begins_at(double t) const noexcept {
  return std::any_of(parts_.begin(), parts_.end(), [t](const ChainPart& part) {
    return part.player != nullptr && part.player->begins_at(part.node, t);
  });
}

RigidMotion NodeDriver::motion(double t, Side side) const { return motion_->split_at(t, side).X; }

}  // namespace pantin

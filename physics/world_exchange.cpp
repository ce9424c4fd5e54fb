// How coordinates and velocities of the world, or of a part of it, come from the state and go back to it.
#include <algorithm>
#include <cmath>

#include <pantin/physics/constraints/joint_models.hpp>
#include <pantin/physics/world_dynamics.hpp>

namespace pantin {

namespace {

constexpr std::size_t kFreeCoordinates = 7, kFreeVelocities = 6;

void write(const BodyState& s, double* q, double* v) {
  q[0] = s.p_WBcm.x(), q[1] = s.p_WBcm.y(), q[2] = s.p_WBcm.z();
  q[3] = s.q_WB.w(), q[4] = s.q_WB.x(), q[5] = s.q_WB.y(), q[6] = s.q_WB.z();
  for (int i = 0; i < 3; ++i) v[i] = s.linear_momentum[i], v[3 + i] = s.angular_momentum[i];
}

BodyState read(const double* q, const double* v) {
  return {{q[0], q[1], q[2]}, Quaternion{q[3], q[4], q[5], q[6]}, {v[0], v[1], v[2]}, {v[3], v[4], v[5]}};
}

}  // namespace

void BodyRoom::begin(const BodyStore& bodies, const ConstraintManager& constraints) {
  stage = bodies.state.kinematics;
  wrenches.resize(bodies.size());
  has_animated =
      std::find(bodies.kinds.begin(), bodies.kinds.end(), BodyKind::Animated) != bodies.kinds.end();
  constraints.ground_motions(bodies, {bodies.state.time, Side::After}, grounds);
}

void WorldDynamics::begin() {
  q_.resize(kFreeCoordinates * layout_.free_bodies.size() + layout_.coordinates);
  v_.resize(kFreeVelocities * layout_.free_bodies.size() + layout_.rates);
  open_loop_ = {};
  efforts_.resize(loads_.on_links() ? kMostNodes * layout_.rates : 0);
  lane_.fits = false;
  begin_cut_joints();
  trees_before_ = bodies_.state.coordinates;
  rates_before_ = bodies_.state.rates;
  if (part_ == nullptr) return;
  part_q_.resize(layout_.coordinates);
  part_v_.resize(layout_.rates);
  for (std::size_t k = 0; k < layout_.trees.size(); ++k) {
    const Tree &tree = layout_.trees[k], &whole = tree_of_whole(k);
    std::copy(trees_before_.begin() + whole.q_begin, trees_before_.begin() + whole.q_end,
              part_q_.begin() + tree.q_begin);
    std::copy(rates_before_.begin() + whole.v_begin, rates_before_.begin() + whole.v_end,
              part_v_.begin() + tree.v_begin);
  }
  trees_before_ = part_q_;
  rates_before_ = part_v_;
}

void WorldDynamics::begin_cut_joints() {
  cut_near_.resize(kMostCoordinates * layout_.closures.size());
  for (std::size_t k = 0; k < layout_.trees.size(); ++k) {
    const auto [here, whole, count] = cut_numbers(k);
    std::copy_n(bodies_.state.cut_coordinates.begin() + whole, count, cut_near_.begin() + here);
  }
}

WorldDynamics::CutNumbers WorldDynamics::cut_numbers(std::size_t k) const {
  const Tree& tree = layout_.trees[k];
  const auto place = [](std::uint32_t closure) {
    return static_cast<std::ptrdiff_t>(std::size_t{kMostCoordinates} * closure);
  };
  return {place(tree.closures_begin), place(tree_of_whole(k).closures_begin),
          place(tree.closures_end - tree.closures_begin)};
}

const Tree& WorldDynamics::tree_of_whole(std::size_t k) const {
  return part_ == nullptr ? layout_.trees[k] : constraints_.layout().trees[part_->trees[k]];
}

void WorldDynamics::put_back() {
  for (const std::uint32_t i : free_bodies()) stage_[i] = bodies_.state.kinematics[i];
  for (const TreeMember& m : layout_.members) stage_[m.body] = bodies_.state.kinematics[m.body];
}

std::span<double> WorldDynamics::coordinates_now() {
  double* q = q_.data();
  double unused[kFreeVelocities];
  for (const std::uint32_t i : free_bodies()) {
    write(bodies_.state.bodies[i], q, unused);
    q += kFreeCoordinates;
  }
  std::copy(trees_before_.begin(), trees_before_.end(), q);
  return q_;
}

std::span<double> WorldDynamics::velocities_now() {
  double* v = v_.data();
  double unused[kFreeCoordinates];
  for (const std::uint32_t i : free_bodies()) {
    write(bodies_.state.bodies[i], unused, v);
    v += kFreeVelocities;
  }
  std::copy(rates_before_.begin(), rates_before_.end(), v);
  return v_;
}

std::int32_t WorldDynamics::first_not_finite() const {
  const auto bad = [](const double* begin, std::size_t n) {
    return !std::all_of(begin, begin + n, [](double x) { return std::isfinite(x); });
  };
  const double *q = q_.data(), *v = v_.data();
  for (const std::uint32_t i : free_bodies()) {
    if (bad(q, kFreeCoordinates) || bad(v, kFreeVelocities)) return static_cast<std::int32_t>(i);
    q += kFreeCoordinates;
    v += kFreeVelocities;
  }
  for (const Tree& tree : layout_.trees) {
    if (bad(q + tree.q_begin, tree.q_end - tree.q_begin) ||
        bad(v + tree.v_begin, tree.v_end - tree.v_begin)) {
      return static_cast<std::int32_t>(layout_.members[layout_.links[tree.links_begin].members_begin].body);
    }
  }
  return -1;
}

bool WorldDynamics::is_at_rest(const Tree& whole, Instant at) {
  Articulated& kernel = constraints_.kernel();
  kernel.place(constraints_.layout(), whole, grounds_, at, bodies_.state.coordinates, bodies_.state.rates);
  for (std::uint32_t l = whole.links_begin; l < whole.links_end; ++l) {
    const LinkWork& link = kernel.link(static_cast<std::int32_t>(l));
    if (dot(link.w, link.w) + dot(link.v, link.v) != 0) return false;
  }
  return true;
}

void WorldDynamics::write_back(double t) {
  const double *q = q_.data(), *v = v_.data();
  State& state = bodies_.state;
  for (const std::uint32_t i : free_bodies()) {
    const BodyState s = read(q, v);
    BodyState& old = state.bodies[i];
    if (s.p_WBcm != old.p_WBcm || s.q_WB.coeffs() != old.q_WB.coeffs() ||
        s.linear_momentum != old.linear_momentum || s.angular_momentum != old.angular_momentum) {
      old = s;
      bodies_.refresh(i);
    }
    q += kFreeCoordinates;
    v += kFreeVelocities;
  }
  const Instant end{t, Side::Before};
  for (std::size_t i = 0; room_.has_animated && i < bodies_.size(); ++i) {
    if (bodies_.kinds[i] == BodyKind::Animated)
      bodies_.place(i, grounds_[i] = bodies_.drivers[i]->motion(t, end.side));
  }
  for (std::size_t k = 0; k < layout_.trees.size(); ++k) {
    const Tree &tree = layout_.trees[k], &whole = tree_of_whole(k);
    const auto to_q = state.coordinates.begin() + whole.q_begin, to_v = state.rates.begin() + whole.v_begin;
    const bool same = std::equal(q + tree.q_begin, q + tree.q_end, to_q) &&
                      std::equal(v + tree.v_begin, v + tree.v_end, to_v);
    if (same && (!whole.follows_driver || is_at_rest(whole, end))) continue;
    const auto [cut_here, cut_whole, count] = cut_numbers(k);
    std::copy_n(cut_near_.begin() + cut_here, count, state.cut_coordinates.begin() + cut_whole);
    std::copy(q + tree.q_begin, q + tree.q_end, to_q);
    std::copy(v + tree.v_begin, v + tree.v_end, to_v);
    constraints_.commit(bodies_, whole, grounds_, end);
  }
}

}  // namespace pantin

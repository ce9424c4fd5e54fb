// Force laws that act along one number, for implicit integrators: where their lines lie among the numbers of
// the state. With w the wrenches of a unit of effort, the stretch changes by -w . (motion of the bodies).
#include <algorithm>

#include <pantin/physics/constraints/joint_models.hpp>
#include <pantin/physics/world_dynamics.hpp>

namespace pantin {

std::span<const LineStiffness> WorldDynamics::lines() {
  line_.laws.clear();
  line_.stiffness.clear();
  const std::span<const ForceLaw* const> all =
      part_ == nullptr ? forces_.laws() : std::span<const ForceLaw* const>{part_->laws};
  for (const ForceLaw* law : all) {
    const LineForce* line = law->line();
    if (line == nullptr || (line->stiffness() == 0 && line->damping() == 0)) continue;
    line_.laws.push_back(line);
    line_.stiffness.push_back({line->stiffness(), line->damping()});
  }
  return line_.stiffness;
}

void WorldDynamics::adjust_lines(const BodiesAt& bodies) {
  for (std::size_t r = 0; r < line_.kept.size(); ++r) {
    const double change = line_.kept[r] - line_.laws[r]->effort(bodies);
    line_.laws[r]->add_effort(bodies, change, wrenches_);
  }
  if (line_.pulled >= 0) line_.laws[static_cast<std::size_t>(line_.pulled)]->add_effort(bodies, 1, wrenches_);
}

void WorldDynamics::jacobian_beside_lines(const JacobianPoint& point, Jacobian& J) {
  place(point.at, point.q, point.v);
  const BodiesAt bodies = bodies_at(point.at);
  line_.kept.clear();
  for (const LineForce* law : line_.laws) line_.kept.push_back(law->effort(bodies));
  take_differences(point, J);
  line_.kept.clear();
}

void WorldDynamics::place_lines(const Stages& stages, const LineStages& out) {
  const std::size_t count = stages.at.size(), nq = stages.q.size(), nv = stages.v.size();
  lane_.q.resize(q_.size());
  lane_.v.resize(v_.size());
  for (std::size_t s = 0; s < count; ++s) {
    place_lane(stages, s);
    const BodiesAt bodies = bodies_at(stages.at[s]);
    for (std::size_t r = 0; r < line_.laws.size(); ++r) {
      std::fill(wrenches_.begin(), wrenches_.end(), Wrench{});
      line_.laws[r]->add_effort(bodies, -1, wrenches_);
      project_line(lane_.q, s, count, out.stretch_by_q.subspan(r * nq, nq),
                   out.rate_by_v.subspan(r * nv, nv));
    }
  }
  line_.q_dot.resize(nq);
  line_.v_dot.resize(nv);
  for (std::size_t r = 0; r < line_.laws.size(); ++r) {
    line_.pulled = static_cast<std::int32_t>(r);
    derivatives({stages.at, stages.q, stages.v, line_.q_dot, line_.v_dot});
    for (std::size_t i = 0; i < nv; ++i) out.response[r * nv + i] = line_.v_dot[i] - stages.v_dot[i];
  }
  line_.pulled = -1;
}

namespace {

constexpr std::size_t kFreeCoordinates = 7, kFreeVelocities = 6;

}  // namespace

/// The wrenches in the room by coordinates and velocities of bodies without joints and of trees.
void WorldDynamics::project_line(std::span<const double> q, std::size_t stage, std::size_t stages,
                                 std::span<double> by_q, std::span<double> by_v) {
  double *to_q = by_q.data() + stage, *to_v = by_v.data() + stage;
  const double* at = q.data();
  for (const std::uint32_t i : free_bodies()) {
    const Wrench& w = wrenches_[i];
    const Matrix3& R = stage_[i].R_WB;
    const Vector3 by_L = R * (bodies_.inverse_inertia[i] * (R.transpose() * w.torque));
    double by_quaternion[4] = {};
    for (int k = 0; k < 3; ++k) {
      kernel::Vec3<double> axis{k == 0 ? 1.0 : 0.0, k == 1 ? 1.0 : 0.0, k == 2 ? 1.0 : 0.0};
      double turn[4], size = 0;
      kernel::quaternion_rate_world(at + 3, axis, turn);
      for (const double x : turn) size += x * x;
      for (int j = 0; j < 4; ++j) by_quaternion[j] += w.torque[k] * turn[j] / size;
    }
    for (int k = 0; k < 7; ++k, to_q += stages) *to_q = k < 3 ? w.force[k] : by_quaternion[k - 3];
    for (int k = 0; k < 6; ++k, to_v += stages)
      *to_v = k < 3 ? w.force[k] / bodies_.mass[i].mass : by_L[k - 3];
    at += kFreeCoordinates;
  }
  project_on_trees(q.last(layout_.coordinates), stage, stages, by_q.last(layout_.coordinates * stages),
                   by_v.last(layout_.rates * stages));
}

void WorldDynamics::project_on_trees(std::span<const double> q, std::size_t stage, std::size_t stages,
                                     std::span<double> by_q, std::span<double> by_v) {
  line_.on_links.assign(layout_.links.size(), {});
  line_.by_rate.resize(layout_.rates);
  for (std::size_t l = 0; l < layout_.links.size(); ++l) {
    Wrench& on = line_.on_links[l];
    for (std::uint32_t m = layout_.links[l].members_begin; m < layout_.links[l].members_end; ++m) {
      const std::uint32_t i = layout_.members[m].body;
      on.force += wrenches_[i].force;
      on.torque += wrenches_[i].torque + stage_[i].p_WBcm.cross(wrenches_[i].force);
    }
  }
  for (const Tree& tree : layout_.trees) kernel_.project(layout_, tree, line_.on_links, line_.by_rate);
  for (const TreeLink& link : layout_.links) {
    with_model(link, [&](auto model) {
      constexpr int kNumbers = decltype(model)::kCoordinates, kRates = decltype(model)::kRates;
      double by_numbers[kNumbers + 1] = {};
      // Rates move coordinates at right angles to each other.
      for (int k = 0; k < kRates; ++k) {
        double unit[kRates + 1] = {}, moved[kNumbers + 1] = {}, size = 0;
        unit[k] = 1;
        model.rate(q.data() + link.q, unit, moved);
        for (const double x : moved) size += x * x;
        const double effort = line_.by_rate[link.v + static_cast<std::uint32_t>(k)];
        for (int j = 0; j < kNumbers; ++j) by_numbers[j] += effort * moved[j] / size;
        by_v[(link.v + static_cast<std::uint32_t>(k)) * stages + stage] = effort;
      }
      for (int j = 0; j < kNumbers; ++j)
        by_q[(link.q + static_cast<std::uint32_t>(j)) * stages + stage] = by_numbers[j];
    });
  }
}

}  // namespace pantin

// Stages of the world side by side: trees in the lane kernel, free bodies in lanes, force laws stage after
// stage unless all they do is the same acceleration for everybody.
#include <algorithm>

#include <pantin/physics/constraints/joint_models.hpp>
#include <pantin/physics/world_dynamics.hpp>

namespace pantin {

void WorldDynamics::fit_lanes(const lanes::Kernel& kernel) {
  if (lane_.fits) return;
  std::int32_t given = lanes::fill_constants(layout_, bodies_, lane_.links, lane_.free);
  for (std::size_t i = 0; kernel_.holds() && i < lane_.links.size(); ++i) {
    lanes::LinkConstants& link = lane_.links[i];
    link.holds = true;
    with_model(layout_.links[i], [&](auto model) {
      for (std::uint32_t j = 0; j < std::uint32_t{decltype(model)::kRates}; ++j) {
        link.locked[j] = kernel_.is_locked(link.v + j);
        link.effort[j] = kernel_.effort(link.v + j);
      }
    });
  }
  const auto count = static_cast<std::size_t>(kernel.lanes);
  std::size_t largest = 0;
  for (const Tree& tree : layout_.trees) {
    largest =
        std::max(largest, kernel.work_size(tree.links_end - tree.links_begin, tree.v_end - tree.v_begin));
  }
  if (!layout_.closures.empty()) given = fit_loops(kernel, given);
  lane_.motions.resize(static_cast<std::size_t>(given) * lanes::kMotionNumbers * count);
  lane_.wrenches.resize(lane_.links.size() * 6 * count);
  lane_.work.resize(largest);
  lane_.q.resize(q_.size());
  lane_.v.resize(v_.size());
  lane_.fits = true;
}

void WorldDynamics::rates(const Stages& stages) {
  const std::size_t count = stages.at.size();
  const lanes::Kernel* kernel = lanes::kernel_for_stages(count);
  if (!uses_lanes || kernel == nullptr) return Dynamics::rates(stages);
  fit_lanes(*kernel);
  for (std::size_t first = 0; first < count; first += static_cast<std::size_t>(kernel->lanes)) {
    kernel->free_rates({lane_.free.data(), lane_.free.size(), stages.q.data(), stages.v.data(),
                        stages.q_dot.data(), count, first});
  }
  const std::size_t q0 = (stages.q.size() / count - layout_.coordinates) * count,
                    v0 = (stages.v.size() / count - layout_.rates) * count;
  for (const TreeLink& link : layout_.links) {
    const double *q = stages.q.data() + q0 + link.q * count, *v = stages.v.data() + v0 + link.v * count;
    double* out = stages.q_dot.data() + q0 + link.q * count;
    with_model(link, [&](auto model) {
      using Model = decltype(model);
      if constexpr (Model::kCoordinates == Model::kRates) {
        std::copy_n(v, static_cast<std::size_t>(Model::kRates) * count, out);
      } else {
        for (std::size_t s = 0; s < count; ++s) {
          double one_q[Model::kCoordinates], one_v[Model::kRates], one_out[Model::kCoordinates];
          for (std::size_t k = 0; k < Model::kCoordinates; ++k) one_q[k] = q[k * count + s];
          for (std::size_t k = 0; k < Model::kRates; ++k) one_v[k] = v[k * count + s];
          model.rate(one_q, one_v, one_out);
          for (std::size_t k = 0; k < Model::kCoordinates; ++k) out[k * count + s] = one_out[k];
        }
      }
    });
  }
}

void WorldDynamics::derivatives(const Stages& stages) {
  const std::size_t count = stages.at.size();
  const lanes::Kernel* kernel = lanes::kernel_for_stages(count);
  if (!uses_lanes || kernel == nullptr) return Dynamics::derivatives(stages);
  rates(stages);
  evaluations += static_cast<int>(count);
  const bool plain = also == nullptr && !bodies_.state.loaded && !loads_.on_closures();
  const std::optional<Vector3> uniform = plain ? laws().uniform_acceleration() : std::nullopt;
  if (uniform) free_forces(stages, *uniform);
  loads_.write_efforts(layout_, stages.at,
                       stages.q.data() + (stages.q.size() / count - layout_.coordinates) * count,
                       stages.v.data() + (stages.v.size() / count - layout_.rates) * count, efforts_.data());
  for (std::size_t first = 0; first < count; first += static_cast<std::size_t>(kernel->lanes)) {
    lane_group(stages, *kernel, first, uniform);
  }
}

void WorldDynamics::free_forces(const Stages& stages, const Vector3& g_W) {
  const std::size_t count = stages.at.size();
  double* out = stages.v_dot.data();
  for (const std::uint32_t i : free_bodies()) {
    const Vector3 force = bodies_.mass[i].mass * g_W;
    for (int k = 0; k < 6; ++k, out += count) std::fill_n(out, count, k < 3 ? force[k] : 0.0);
  }
}

void WorldDynamics::given_motions(const Stages& stages, std::size_t first, std::size_t count) {
  for (std::size_t i = 0; i < lane_.links.size(); ++i) {
    const lanes::LinkConstants& c = lane_.links[i];
    const TreeLink& link = layout_.links[i];
    for (std::size_t lane = 0; lane < count; ++lane) {
      const Instant& at = stages.at[first + lane];
      const auto to = [&](std::int32_t number) {
        return lane_.motions.data() + static_cast<std::size_t>(number) * lanes::kMotionNumbers * count + lane;
      };
      if (c.ground >= 0) {
        lanes::put_motion(motion_of_ground(link.ground, at), count, to(c.ground));
      }
      if (c.given >= 0) {
        const RigidMotion motion = link.driver->motion(at.t, at.side);
        lanes::put_motion(link.reversed ? inverse(motion) : motion, count, to(c.given));
      }
    }
  }
}

RigidMotion WorldDynamics::motion_of_ground(std::int32_t place, Instant at) const {
  const auto body = static_cast<std::size_t>(place);
  return bodies_.kinds[body] == BodyKind::Animated ? bodies_.drivers[body]->motion(at.t, at.side)
                                                   : grounds_[body];
}

void WorldDynamics::lane_group(const Stages& stages, const lanes::Kernel& kernel, std::size_t first,
                               const std::optional<Vector3>& uniform) {
  const std::size_t count = stages.at.size(), lanes = static_cast<std::size_t>(kernel.lanes);
  if (!lane_.motions.empty()) given_motions(stages, first, lanes);
  if (!layout_.closures.empty()) given_loop_motions(stages, first, lanes);
  lanes::Task task{.links = lane_.links.data(),
                   .q = stages.q.data() + (stages.q.size() / count - layout_.coordinates) * count,
                   .v = stages.v.data() + (stages.v.size() / count - layout_.rates) * count,
                   .v_dot = stages.v_dot.data() + (stages.v.size() / count - layout_.rates) * count,
                   .stages = count,
                   .first = first,
                   .motions = lane_.motions.data(),
                   .efforts = efforts_.data(),
                   .work = lane_.work.data()};
  if (uniform) std::copy_n(uniform->data(), 3, task.gravity);
  if (!uniform) {
    std::fill(lane_.wrenches.begin(), lane_.wrenches.end(), 0.0);
    for (std::size_t lane = 0; lane < lanes; ++lane) {
      // All trees are placed before any law is asked: laws couple them.
      place_lane(stages, first + lane);
      gather_wrenches(stages.at[first + lane]);
      collect_wrenches(stages, first, lane, lanes);
    }
  }
  for (const Tree& tree : layout_.trees) {
    task.begin = tree.links_begin, task.end = tree.links_end;
    kernel.outward(task);
    for (std::uint32_t l = tree.links_begin; !uniform && l < tree.links_end; ++l) {
      kernel.add_wrench(task, l, lane_.wrenches.data() + l * 6 * lanes);
    }
    if (!tree.has_closures()) {
      kernel.solve(task);
      continue;
    }
    const lanes::LoopTask loop = loop_task(tree);
    kernel.trace(task, loop);
    kernel.solve(task);
    loop_margin = std::min(loop_margin, kernel.close(task, loop));
  }
}

void WorldDynamics::take_stage(const Stages& stages, std::size_t stage) {
  const std::size_t count = stages.at.size();
  for (std::size_t i = 0; i < lane_.q.size(); ++i) lane_.q[i] = stages.q[i * count + stage];
  for (std::size_t i = 0; i < lane_.v.size(); ++i) lane_.v[i] = stages.v[i * count + stage];
}

void WorldDynamics::place_lane(const Stages& stages, std::size_t stage) {
  take_stage(stages, stage);
  place_grounds(stages.at[stage]);
  place_free(lane_.q, lane_.v, {});
  place_trees(stages.at[stage], lane_.q, lane_.v);
}

void WorldDynamics::collect_wrenches(const Stages& stages, std::size_t first, std::size_t lane,
                                     std::size_t count) {
  double* out = stages.v_dot.data() + first + lane;
  for (const std::uint32_t i : free_bodies()) {
    for (int k = 0; k < 6; ++k, out += stages.at.size())
      *out = k < 3 ? wrenches_[i].force[k] : wrenches_[i].torque[k - 3];
  }
  for (std::size_t l = 0; l < layout_.links.size(); ++l) {
    for (std::uint32_t m = layout_.links[l].members_begin; m < layout_.links[l].members_end; ++m) {
      const std::uint32_t i = layout_.members[m].body;
      put_wrench(l, lane, count, wrenches_[i].force, wrenches_[i].torque, stage_[i].p_WBcm);
    }
  }
  for (const Tree& tree : layout_.trees) {
    loads_.on_cut_joints(
        layout_, tree, kernel_, grounds_, stages.at[first + lane], cut_near_,
        [&](std::int32_t link, const Vector3& force, const Vector3& torque, const Vector3& p_WQ) {
          put_wrench(static_cast<std::size_t>(link), lane, count, force, torque, p_WQ);
        });
  }
}

void WorldDynamics::put_wrench(std::size_t link, std::size_t lane, std::size_t count, const Vector3& force,
                               const Vector3& torque, const Vector3& p_WQ) {
  const LinkWork& work = kernel_.link(static_cast<std::int32_t>(link));
  const Vector3 about_origin = torque + (p_WQ - Vector3{work.p.x, work.p.y, work.p.z}).cross(force);
  double* to = lane_.wrenches.data() + link * 6 * count + lane;
  for (Eigen::Index k = 0; k < 3; ++k) {
    to[static_cast<std::size_t>(k) * count] += force[k];
    to[static_cast<std::size_t>(3 + k) * count] += about_origin[k];
  }
}

}  // namespace pantin

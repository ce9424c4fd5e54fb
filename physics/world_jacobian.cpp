// How the derivative changes with the state, island by island. For free bodies, with q the quaternion, J the
// inertia in W, turn = 2 vec(dq q*) / |q|^2, and w = J^-1 L, so that dw = (J^-1 [L] - [w]) turn + J^-1 dL:
//
//          dp                dq                              dP          dL
//   p'                                                       1/m
//   q'                       (w q + [G] w_turn turn_q) / 2               G J^-1 / 2, with q' = G w / 2
//   P', L' by position       (turn + spin w_turn) turn_q     velocity/m  spin J^-1      of the laws
#include <algorithm>

#include <pantin/physics/islands.hpp>
#include <pantin/physics/world_dynamics.hpp>

namespace pantin {

namespace {

constexpr std::size_t kFreeCoordinates = 7, kFreeVelocities = 6;
using Matrix4 = Eigen::Matrix4d;
using Matrix43 = Eigen::Matrix<double, 4, 3>;

/// (0, w) q as a matrix times q, in the order w, x, y, z.
Matrix4 left_product(const Vector3& w) {
  Matrix4 product = Matrix4::Zero();
  product.block<1, 3>(0, 1) = -w.transpose();
  product.block<3, 1>(1, 0) = w;
  product.block<3, 3>(1, 1) = cross_matrix(w);
  return product;
}

/// The same as a matrix times w.
Matrix43 right_product(const double* q) {
  const Vector3 v{q[1], q[2], q[3]};
  Matrix43 product;
  product.row(0) = -v.transpose();
  product.bottomRows<3>() = q[0] * Matrix3::Identity() - cross_matrix(v);
  return product;
}

}  // namespace

void WorldDynamics::list_groups(NumberGroups& groups) {
  fit_groups();
  groups = jacobian_.groups;
}

void WorldDynamics::fit_groups() {
  JacobianRoom& room = jacobian_;
  const std::uint64_t layout = constraints_.layout_revision() + 1;
  if (room.layout == layout && room.forces == forces_.revision()) return;
  room.layout = layout, room.forces = forces_.revision();
  room.groups.clear();
  room.is_free.clear();
  room.free.resize(free_bodies().size());
  room.free_place.assign(bodies_.size(), -1);
  for (std::size_t f = 0; f < free_bodies().size(); ++f)
    room.free_place[free_bodies()[f]] = static_cast<std::int32_t>(f);

  const std::size_t q0 = kFreeCoordinates * free_bodies().size(), nq = q0 + layout_.coordinates;
  const std::size_t v0 = nq + kFreeVelocities * free_bodies().size();
  std::vector<std::size_t> trees;
  for (const Island& island : find_islands(bodies_, constraints_.layout(), forces_)) {
    trees.clear();
    std::size_t free = 0;
    for (const std::uint32_t i : island.bodies) {
      if (layout_.link_of_body[i] >= 0) trees.push_back(layout_.tree_of(layout_.link_of_body[i]));
      if (room.free_place[i] < 0) continue;
      const auto f = static_cast<std::size_t>(room.free_place[i]);
      room.groups.add(kFreeCoordinates * f, kFreeCoordinates);
      room.free[f] = {.group = room.groups.size(), .q = kFreeCoordinates * free};
      ++free;
    }
    std::sort(trees.begin(), trees.end());
    trees.erase(std::unique(trees.begin(), trees.end()), trees.end());
    std::size_t coordinates = kFreeCoordinates * free;
    for (const std::size_t k : trees) {
      const Tree& tree = layout_.trees[k];
      room.groups.add(q0 + tree.q_begin, tree.q_end - tree.q_begin);
      coordinates += tree.q_end - tree.q_begin;
    }
    free = 0;
    for (const std::uint32_t i : island.bodies) {
      if (room.free_place[i] < 0) continue;
      const auto f = static_cast<std::size_t>(room.free_place[i]);
      room.groups.add(nq + kFreeVelocities * f, kFreeVelocities);
      room.free[f].v = coordinates + kFreeVelocities * free++;
    }
    for (const std::size_t k : trees) {
      const Tree& tree = layout_.trees[k];
      room.groups.add(v0 + tree.v_begin, tree.v_end - tree.v_begin);
    }
    const std::size_t before = room.groups.size();
    room.groups.end_group();
    if (room.groups.size() > before) room.is_free.push_back(trees.empty() ? 1 : 0);
  }
}

void WorldDynamics::jacobian(const JacobianPoint& point, Jacobian& J) {
  JacobianRoom& room = jacobian_;
  bool are_known = also == nullptr && std::any_of(room.is_free.begin(), room.is_free.end(),
                                                  [](std::uint8_t is_free) { return is_free != 0; });
  if (are_known) {
    place(point.at, point.q, point.v);
    room.derivatives.clear();
    are_known = laws().gather_derivatives(bodies_at(point.at), room.derivatives);
  }
  room.wanted.clear();
  for (std::size_t g = 0; g < J.groups.size(); ++g) {
    if (!are_known || room.is_free[g] == 0) room.wanted.push_back(g);
  }
  if (are_known) {
    add_free_motion(point, J);
    add_laws(J);
  }
  take_differences(point, room.wanted, J);
}

void WorldDynamics::add_free_motion(const JacobianPoint& point, Jacobian& J) {
  const double *q = point.q.data(), *v = point.v.data();
  for (const std::uint32_t i : free_bodies()) {
    FreeBlock& body = jacobian_.free[static_cast<std::size_t>(jacobian_.free_place[i])];
    const BodyKinematics& k = stage_[i];
    const Vector3 L{v[3], v[4], v[5]};
    body.inverse_mass = 1 / bodies_.mass[i].mass;
    body.inverse_inertia_W = k.R_WB * bodies_.inverse_inertia[i] * k.R_WB.transpose();
    body.spin_by_turn = body.inverse_inertia_W * cross_matrix(L) - cross_matrix(k.w_WB);
    const Matrix43 G = right_product(q + 3);
    body.turn_by_q = 2 / Eigen::Map<const Eigen::Vector4d>{q + 3}.squaredNorm() * G.transpose();
    if (jacobian_.is_free[body.group] != 0) {
      const auto n = static_cast<Eigen::Index>(J.groups.group(body.group).size());
      Eigen::Map<Eigen::MatrixXd> block{J.block(body.group).data(), n, n};
      const auto q0 = static_cast<Eigen::Index>(body.q), v0 = static_cast<Eigen::Index>(body.v);
      block.block<3, 3>(q0, v0) = body.inverse_mass * Matrix3::Identity();
      block.block<4, 4>(q0 + 3, q0 + 3) =
          0.5 * left_product(k.w_WB) + 0.5 * G * body.spin_by_turn * body.turn_by_q;
      block.block<4, 3>(q0 + 3, v0 + 3) = 0.5 * G * body.inverse_inertia_W;
    }
    q += kFreeCoordinates;
    v += kFreeVelocities;
  }
}

void WorldDynamics::add_laws(Jacobian& J) {
  for (const WrenchDerivative& part : jacobian_.derivatives.parts()) {
    const std::int32_t on_place = jacobian_.free_place[part.on], by_place = jacobian_.free_place[part.by];
    if (on_place < 0 || by_place < 0) continue;  // not simulated, of a tree, or of another part of the world
    const FreeBlock &on = jacobian_.free[static_cast<std::size_t>(on_place)],
                    &by = jacobian_.free[static_cast<std::size_t>(by_place)];
    if (on.group != by.group || jacobian_.is_free[on.group] == 0) continue;
    const auto n = static_cast<Eigen::Index>(J.groups.group(on.group).size());
    Eigen::Map<Eigen::MatrixXd> block{J.block(on.group).data(), n, n};
    const auto row = static_cast<Eigen::Index>(on.v);
    const auto q0 = static_cast<Eigen::Index>(by.q), v0 = static_cast<Eigen::Index>(by.v);
    const auto add = [&](Eigen::Index at, const ByMotion& change) {
      block.block<3, 3>(at, q0) += change.position;
      block.block<3, 4>(at, q0 + 3) += (change.turn + change.spin * by.spin_by_turn) * by.turn_by_q;
      block.block<3, 3>(at, v0) += by.inverse_mass * change.velocity;
      block.block<3, 3>(at, v0 + 3) += change.spin * by.inverse_inertia_W;
    };
    add(row, part.force);
    add(row + 3, part.torque);
  }
}

}  // namespace pantin

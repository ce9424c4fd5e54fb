// Errors of coordinates as motion of bodies: what an integrator's tolerance is about. An error of joint
// coordinates is a rate at which the tree would move, so the kernel's outward pass carries it to the bodies
// with its lever arms.
#include <algorithm>
#include <cmath>

#include <pantin/physics/constraints/joint_models.hpp>
#include <pantin/physics/world_dynamics.hpp>

namespace pantin {

namespace {

/// The greatest of several; what is not a number stays the greatest.
struct Greatest {
  double value{0};
  void count(double x) {
    if (!(x <= value)) value = x;
  }
};

double length(const double* x, int n) {
  double squares = 0;
  for (int i = 0; i < n; ++i) squares += x[i] * x[i];
  return std::sqrt(squares);
}

/// The rates that move q by q_dot as nearly as they can: the columns of q' = N(q) v are orthogonal for every
/// joint.
template <class Model>
void rates_of(const Model& model, const double* q, const double* q_dot, double* v) {
  for (int j = 0; j < Model::kRates; ++j) {
    double unit[kMostRates] = {}, column[kMostCoordinates] = {};
    unit[j] = 1;
    model.rate(q, unit, column);
    double along = 0, squares = 0;
    for (int i = 0; i < Model::kCoordinates; ++i) {
      along += column[i] * q_dot[i];
      squares += column[i] * column[i];
    }
    v[j] = along / squares;
  }
}

/// How far a unit of each number of a joint moves what lies within `reach` of it. Coordinates are
/// quaternions, positions before quaternions, or the integrals of the rates.
template <class Model>
void link_weights(const Model& model, double reach, double* q_weight, double* v_weight) {
  kernel::Vec3<double> angular[kMostRates], linear[kMostRates];
  model.columns(kernel::Mat3<double>::identity(), angular, linear);
  for (int j = 0; j < Model::kRates; ++j) {
    v_weight[j] = reach * std::sqrt(dot(angular[j], angular[j])) + std::sqrt(dot(linear[j], linear[j]));
  }
  for (int k = 0; k < Model::kCoordinates; ++k) {
    if constexpr (Model::kCoordinates == Model::kRates) q_weight[k] = v_weight[k];
    else q_weight[k] = k < Model::kCoordinates - 4 ? 1 : 2 * reach;
  }
}

}  // namespace

double WorldDynamics::motion_error(std::span<const double> q, std::span<const double>,
                                   std::span<const double> q_error, std::span<const double> v_error,
                                   double h) {
  const double free = free_error(q, q_error, v_error, h);
  const double trees = tree_error(q, q_error, v_error, h);
  return !(trees <= free) ? trees : free;
}

double WorldDynamics::free_error(std::span<const double> q_all, std::span<const double> q_error,
                                 std::span<const double> v_error, double h) const {
  Greatest error;
  const double *q = q_all.data(), *dq = q_error.data(), *dv = v_error.data();
  for (const std::uint32_t i : free_bodies()) {
    error.count(length(dq, 3));
    error.count(2 * length(dq + 3, 4));
    error.count(h * length(dv, 3) / bodies_.mass[i].mass);
    const kernel::Vec3<double> L =
        kernel::transposed_times(kernel::rotation_of(q + 3), {dv[3], dv[4], dv[5]});
    error.count(h * (bodies_.inverse_inertia[i] * Vector3{L.x, L.y, L.z}).norm());
    q += 7, dq += 7, dv += 6;
  }
  return error.value;
}

double WorldDynamics::tree_error(std::span<const double> q, std::span<const double> q_error,
                                 std::span<const double> v_error, double h) {
  if (layout_.links.empty()) return 0;
  const double* q0 = q.data() + (q.size() - layout_.coordinates);
  const double* dq = q_error.data() + (q_error.size() - layout_.coordinates);
  const std::span<const double> dv = v_error.last(layout_.rates);
  error_rates_.assign(2 * layout_.rates, 0.0);
  const std::span<double> by_q{error_rates_.data(), layout_.rates};
  const std::span<double> by_v{error_rates_.data() + layout_.rates, layout_.rates};
  for (const TreeLink& link : layout_.links) {
    with_model(link, [&](auto model) { rates_of(model, q0 + link.q, dq + link.q, by_q.data() + link.v); });
  }
  for (std::size_t j = 0; j < layout_.rates; ++j) by_v[j] = h * dv[j];

  Greatest error;
  const Instant now{bodies_.state.time, Side::After};
  for (const Tree& tree : layout_.trees) {
    if (tree.has_closures()) {
      // Near singular positions the way out of the loop is full of noise, and is settled away.
      const TreeView view{layout_, tree, kernel_, grounds_, now};
      loops_.make_tangential(view, q.last(layout_.coordinates), by_q);
      loops_.make_tangential(view, q.last(layout_.coordinates), by_v);
    }
    kernel_.place(layout_, tree, grounds_, now, q.last(layout_.coordinates), by_q);
    for (const std::span<const double> rates :
         {std::span<const double>{by_q}, std::span<const double>{by_v}}) {
      kernel_.carry(layout_, tree, rates);
      for (std::uint32_t i = tree.links_begin; i < tree.links_end; ++i) count_link(i, error.value);
    }
  }
  return error.value;
}

void WorldDynamics::count_link(std::uint32_t i, double& greatest) const {
  const LinkWork& link = kernel_.link(static_cast<std::int32_t>(i));
  Greatest error{greatest};
  error.count(std::sqrt(dot(link.w, link.w)));
  for (std::uint32_t m = layout_.links[i].members_begin; m < layout_.links[i].members_end; ++m) {
    const TreeMember& member = layout_.members[m];
    const Vector3 c = member.X_LB * bodies_.mass[member.body].p_BBcm;
    const kernel::Vec3<double> of_cm =
        link.v + cross(link.w, link.R * kernel::Vec3<double>{c.x(), c.y(), c.z()});
    error.count(std::sqrt(dot(of_cm, of_cm)));
  }
  greatest = error.value;
}

void WorldDynamics::weights(std::span<double> q_weight, std::span<double> v_weight) {
  double *wq = q_weight.data(), *wv = v_weight.data();
  for (const std::uint32_t i : free_bodies()) {
    for (int k = 0; k < 7; ++k) wq[k] = k < 3 ? 1 : 2;
    for (int k = 0; k < 6; ++k) wv[k] = k < 3 ? 1 / bodies_.mass[i].mass : bodies_.inverse_inertia[i].norm();
    wq += 7, wv += 6;
  }
  // From the leaves: how far a body may be from the origin of a link.
  reach_.assign(layout_.links.size(), 0.0);
  for (std::size_t i = layout_.links.size(); i-- > 0;) {
    const TreeLink& link = layout_.links[i];
    for (std::uint32_t m = link.members_begin; m < link.members_end; ++m) {
      const TreeMember& member = layout_.members[m];
      reach_[i] = std::max(reach_[i], (member.X_LB * bodies_.mass[member.body].p_BBcm).norm());
    }
    with_model(link, [&](auto model) {
      link_weights(model, std::max(1.0, reach_[i]), wq + link.q, wv + link.v);
      if (link.parent < 0) return;
      kernel::Mat3<double> R;
      kernel::Vec3<double> p;
      if (link.driver == nullptr) model.place(trees_before_.data() + link.q, R, p);
      double& above = reach_[static_cast<std::size_t>(link.parent)];
      above = std::max(above, reach_[i] + link.X_PJ.p.norm() + std::sqrt(dot(p, p)));
    });
  }
}

}  // namespace pantin

// Rows between links through the factor of the elimination. Since M^-1 = P^T D^-1 P with P the inward pass, a
// row costs one inward pass along its path, and products of rows are sums over the joints that they share (G.
// Rodriguez, A. Jain, K. Kreutz-Delgado, Int. J. Robotics Research 10, 371 (1991)).
#include <algorithm>

#include <pantin/physics/constraints/articulated.hpp>
#include <pantin/physics/constraints/joint_models.hpp>

namespace pantin {

using kernel::cross;
using kernel::dot;

void Articulated::load_inertia(const TreeLayout& layout, const Tree& tree) {
  for (std::uint32_t i = tree.links_begin; i < tree.links_end; ++i) {
    start_inertia(layout.links[i], work_[i]);
    work_[i].p_a = work_[i].p_l = {};
  }
}

void Articulated::carry(const TreeLayout& layout, const Tree& tree, std::span<const double> rates) {
  for (std::uint32_t i = tree.links_begin; i < tree.links_end; ++i) {
    const TreeLink& link = layout.links[i];
    LinkWork& work = work_[i];
    work.w = {}, work.v = {};
    if (link.parent >= 0) {
      const LinkWork& parent = work_[static_cast<std::size_t>(link.parent)];
      work.w = parent.w, work.v = parent.v + cross(parent.w, work.r);
    }
    if (link.driver != nullptr) continue;
    with_model(link, [&](auto model) {
      for (std::uint32_t j = link.v; j < link.v + std::uint32_t{decltype(model)::kRates}; ++j) {
        work.w += rates[j] * S_a_[j];
        work.v += rates[j] * S_l_[j];
      }
    });
  }
}

void Articulated::project(const TreeLayout& layout, const Tree& tree, std::span<Wrench> on_links,
                          std::span<double> by_rate) const {
  const auto plain = [](const Vector3& x) { return Vec{x.x(), x.y(), x.z()}; };
  for (std::uint32_t i = tree.links_end; i-- > tree.links_begin;) {
    const TreeLink& link = layout.links[i];
    const Wrench& on = on_links[i];
    const Vec force = plain(on.force), torque = plain(on.torque) - cross(work_[i].p, force);
    with_model(link, [&](auto model) {
      for (std::uint32_t J = link.v; J < link.v + std::uint32_t{decltype(model)::kRates}; ++J)
        by_rate[J] = is_locked(J) ? 0 : dot(S_a_[J], torque) + dot(S_l_[J], force);
    });
    if (link.parent < 0) continue;
    Wrench& up = on_links[static_cast<std::size_t>(link.parent)];
    up.force += on.force;
    up.torque += on.torque;
  }
}

template <int N>
void Articulated::reduce_link(const TreeLink& link, const LinkWork& work, const RowWrench& row, Vec& p_a,
                              Vec& p_l, const double* effort, double* y, Reduction& sum) const {
  // At its best the lever from the joint to the row's point is at right angles to the force.
  const Vec lever = row.point - work.p;
  const double linear = dot(row.force, row.force);
  const double angular = dot(row.torque, row.torque) + dot(lever, lever) * linear;
  const Vec a = p_a, l = p_l;
  for (int j = 0; j < N; ++j) {
    const auto J = link.v + static_cast<std::uint32_t>(j);
    // What holds a locked rate bears whatever acts there.
    y[j] = is_locked(J) ? 0 : effort[j] - dot(S_a_[J], a) - dot(S_l_[J], l);
    double bound = angular * dot(S_a_[J], S_a_[J]) + linear * dot(S_l_[J], S_l_[J]);
    for (int k = 0; k < j; ++k) {
      const double l_jk = D_[J][static_cast<std::size_t>(k)];
      y[j] -= l_jk * y[k];
      bound += l_jk * l_jk * y[k] * y[k];
    }
    const double by_d = 1 / D_[J][static_cast<std::size_t>(j)], s = y[j] * by_d;
    sum.squares += y[j] * s;
    sum.bound += bound * by_d;
    p_a += s * U_a_[J];
    p_l += s * U_l_[J];
  }
  p_a += cross(work.r, p_l);
}

Articulated::Reduction Articulated::reduce(const TreeLayout& layout, const Closure& closure,
                                           const RowWrench& row, std::span<Passing> passing,
                                           std::span<double> y) const {
  Reduction sum;
  const std::uint32_t count = closure.path_end - closure.path_begin;
  for (std::uint32_t k = 0; k < count; ++k) {
    const PathLink& at = layout.paths[closure.path_begin + k];
    const LinkWork& work = work_[at.link];
    Passing& here = passing[k];
    here = {};
    // As bias, so with the sign turned: what acts on B is taken away from it.
    const double on_b = static_cast<std::int32_t>(at.link) == closure.b.link ? 1 : 0;
    const double on_a = static_cast<std::int32_t>(at.link) == closure.a.link ? 1 : 0;
    if (on_b == on_a) continue;
    const double sign = on_a - on_b;
    here.p_l = sign * row.force;
    here.p_a = sign * (row.torque + cross(row.point - work.p, row.force));
  }
  for (std::uint32_t k = 0; k < count; ++k) {
    const PathLink& at = layout.paths[closure.path_begin + k];
    const TreeLink& link = layout.links[at.link];
    Passing& here = passing[k];
    double effort[kMostRates] = {};
    for (const JointEffort& acting : row.efforts) {
      if (acting.link == static_cast<std::int32_t>(at.link))
        std::copy(acting.by_rate.begin(), acting.by_rate.end(), effort);
    }
    with_model(link, [&](auto model) {
      reduce_link<decltype(model)::kRates>(link, work_[at.link], row, here.p_a, here.p_l, effort,
                                           y.data() + at.rates, sum);
    });
    if (at.up < 0) continue;
    passing[static_cast<std::size_t>(at.up)].p_a += here.p_a;
    passing[static_cast<std::size_t>(at.up)].p_l += here.p_l;
  }
  // Efforts have no levers, so that what they do never vanishes.
  if (row.efforts[0].link >= 0) sum.bound = sum.squares;
  return sum;
}

double Articulated::product(const TreeLayout& layout, std::uint32_t index, const double* y,
                            const double* z) const {
  const TreeLink& link = layout.links[index];
  double sum = 0;
  with_model(link, [&](auto model) {
    for (std::uint32_t j = 0; j < std::uint32_t{decltype(model)::kRates}; ++j) {
      sum += y[j] * z[j] / D_[link.v + j][j];
    }
  });
  return sum;
}

void Articulated::push(const TreeLayout& layout, const Closure& closure, double multiplier,
                       std::span<const double> y) {
  for (std::uint32_t k = closure.path_begin; k < closure.path_end; ++k) {
    const PathLink& at = layout.paths[k];
    const TreeLink& link = layout.links[at.link];
    const std::uint32_t next = k + 1 < closure.path_end ? layout.paths[k + 1].rates : closure.path_rates;
    for (std::uint32_t j = 0; j + at.rates < next; ++j) u_[link.v + j] += multiplier * y[at.rates + j];
  }
}

}  // namespace pantin

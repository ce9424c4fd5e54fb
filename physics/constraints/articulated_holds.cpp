// Rates that are locked, and efforts along rates, through the factor of the elimination.
#include <algorithm>

#include <pantin/physics/constraints/articulated.hpp>
#include <pantin/physics/constraints/joint_models.hpp>

namespace pantin {

using kernel::cross;
using kernel::dot;

void Articulated::hold(std::span<const std::uint8_t> locked, std::span<const double> efforts) {
  locked_.assign(locked.begin(), locked.end());
  efforts_.assign(efforts.begin(), efforts.end());
  holds_ = true;
}

/// A locked rate has no columns, so an inertia of one and no effort leave it at zero.
void Articulated::hold_rate(std::uint32_t rate, bool moves) {
  if (locked_[rate] != 0) u_[rate] = 0;
  else if (moves) u_[rate] += efforts_[rate];
}

void Articulated::clear_efforts(const Tree& tree) {
  std::fill(u_.begin() + tree.v_begin, u_.begin() + tree.v_end, 0.0);
}

/// What is left of efforts y at a link's joint is added to the right-hand side, as L^-1 y; the rest goes on
/// to the parent as bias p.
template <int N>
void Articulated::pass_effort(const TreeLink& link, double* y, Vec& p_a, Vec& p_l) {
  const Vec a = p_a, l = p_l;
  for (std::uint32_t j = 0; j < std::uint32_t{N}; ++j) {
    const std::uint32_t J = link.v + j;
    y[j] -= dot(S_a_[J], a) + dot(S_l_[J], l);
    for (std::uint32_t k = 0; k < j; ++k) y[j] -= D_[J][k] * y[k];
    const double s = y[j] / D_[J][j];
    u_[J] += y[j];
    p_a += s * U_a_[J];
    p_l += s * U_l_[J];
  }
}

void Articulated::push_effort(const TreeLayout& layout, std::uint32_t link, std::uint32_t rate,
                              double effort) {
  double y[kMostRates] = {};
  y[rate - layout.links[link].v] = effort;
  Vec p_a, p_l;
  for (auto i = static_cast<std::int32_t>(link); i >= 0;) {
    const TreeLink& at = layout.links[static_cast<std::size_t>(i)];
    with_model(at, [&](auto model) { pass_effort<decltype(model)::kRates>(at, y, p_a, p_l); });
    p_a += cross(work_[static_cast<std::size_t>(i)].r, p_l);
    std::fill(std::begin(y), std::end(y), 0.0);
    i = at.parent;
  }
}

}  // namespace pantin

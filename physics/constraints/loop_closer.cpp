#include <pantin/physics/constraints/loop_closer.hpp>

#include <algorithm>
#include <cmath>

#include <pantin/physics/constraints/joint_models.hpp>

namespace pantin {

namespace {

constexpr int kSettlePasses = 3, kClosePasses = 200;
/// A pass of `close` moves no joint by more [rad] or [m].
constexpr double kStride = 0.5;
constexpr double kOpen = 1e-7;

}  // namespace

void LoopCloser::resize(const TreeLayout& layout) {
  solver_.resize(layout);
  change_.assign(layout.rates, 0.0);
  still_.assign(layout.rates, 0.0);
  driven_.assign(layout.rates, 0.0);
  kept_.assign(layout.coordinates, 0.0);
}

void LoopCloser::look(const TreeView& view, std::span<const double> q, std::span<const double> v) {
  view.kernel.place(view.layout, view.tree, view.grounds, view.at, q, v);
  solver_.measure(view.layout, view.tree, view.kernel, view.grounds, view.at, {q, v, {}});
}

void LoopCloser::factor(const TreeView& view) {
  view.kernel.load_inertia(view.layout, view.tree);
  view.kernel.eliminate(view.layout, view.tree, {});
  solver_.factor(view.layout, view.tree, view.kernel);
}

void LoopCloser::step(const TreeView& view, ClosureLevel level) {
  solver_.solve(view.layout, view.tree, level, view.kernel);
  view.kernel.substitute(view.layout, view.tree, change_);
}

void LoopCloser::move(const TreeView& view, std::span<double> q, double part,
                      std::span<const double> change) {
  for (std::uint32_t i = view.tree.links_begin; i < view.tree.links_end; ++i) {
    const TreeLink& link = view.layout.links[i];
    with_model(link, [&](auto model) {
      using Model = decltype(model);
      double dq[kMostCoordinates];
      model.rate(q.data() + link.q, change.data() + link.v, dq);
      for (int k = 0; k < Model::kCoordinates; ++k) q[link.q + static_cast<std::uint32_t>(k)] += part * dq[k];
      Model::normalise(q.data() + link.q);
    });
  }
}

void LoopCloser::settle(const TreeView& view, std::span<double> q, std::span<double> v) {
  look(view, q, v);
  double gap = solver_.gap_in_roundings(view.tree);
  for (int pass = 0; pass < kSettlePasses && gap > 1; ++pass) {
    factor(view);
    step(view, ClosureLevel::Position);
    move(view, q, 1, change_);
    look(view, q, v);
    const double now = solver_.gap_in_roundings(view.tree);
    const bool helps = now < 0.5 * gap;
    gap = now;
    if (!helps) break;
  }
  if (!(solver_.rate_in_roundings(view.tree) > 1)) return;
  factor(view);
  step(view, ClosureLevel::Velocity);
  for (std::uint32_t j = view.tree.v_begin; j < view.tree.v_end; ++j) v[j] += change_[j];
}

bool LoopCloser::project(const TreeView& view, std::span<const double> q, std::span<double> v) {
  look(view, q, v);
  factor(view);
  step(view, ClosureLevel::Velocity);
  for (std::uint32_t j = view.tree.v_begin; j < view.tree.v_end; ++j) v[j] += change_[j];
  look(view, q, v);
  for (std::uint32_t c = view.tree.closures_begin; c < view.tree.closures_end; ++c) {
    for (const ClosureRow& row : solver_.rows(c)) {
      if (!(std::abs(row.rate) <= kOpen * (1 + row.rate_size))) return false;
    }
  }
  return true;
}

void LoopCloser::make_tangential(const TreeView& view, std::span<const double> q, std::span<double> change) {
  // Driven parts move without any rate; what they do to the rows is no part of the change.
  for (const std::span<const double> rates :
       {std::span<const double>{still_}, std::span<const double>{change}}) {
    look(view, q, rates);
    factor(view);
    step(view, ClosureLevel::Velocity);
    std::swap(change_, driven_);
  }
  // By now change_ holds the answer to no rates, driven_ that to the change.
  for (std::uint32_t j = view.tree.v_begin; j < view.tree.v_end; ++j) change[j] += driven_[j] - change_[j];
}

bool LoopCloser::close(const TreeView& view, std::span<double> q) {
  look(view, q, still_);
  for (int pass = 0; pass < kClosePasses && solver_.gap_in_roundings(view.tree) > 1; ++pass) {
    const double before = solver_.gap_squared(view.tree);
    factor(view);
    step(view, ClosureLevel::Position);
    if (!search(view, q, before)) break;
  }
  return open_loop(view.layout, view.tree).joint < 0;
}

/// Goes along the change as far as the gaps shrink. Leaves the tree measured at q.
bool LoopCloser::search(const TreeView& view, std::span<double> q, double before) {
  double most = 0;
  bool finite = true;
  for (std::uint32_t j = view.tree.v_begin; j < view.tree.v_end; ++j) {
    most = std::max(most, std::abs(change_[j]));
    finite = finite && std::isfinite(change_[j]);
  }
  if (!finite) return false;
  const auto begin = q.begin() + view.tree.q_begin, end = q.begin() + view.tree.q_end;
  std::copy(begin, end, kept_.begin() + view.tree.q_begin);
  for (double part = std::min(1.0, kStride / most); part > 1e-6; part *= 0.5) {
    move(view, q, part, change_);
    look(view, q, still_);
    if (solver_.gap_squared(view.tree) < before) return true;
    std::copy(kept_.begin() + view.tree.q_begin, kept_.begin() + view.tree.q_end, begin);
  }
  look(view, q, still_);
  return false;
}

OpenLoop LoopCloser::open_loop(const TreeLayout& layout, const Tree& tree) const {
  OpenLoop worst;
  for (std::uint32_t c = tree.closures_begin; c < tree.closures_end; ++c) {
    for (const ClosureRow& row : solver_.rows(c)) {
      if (std::abs(row.gap) <= std::max(worst.gap, kOpen * (1 + row.size))) continue;
      worst = {layout.closures[c].joint, layout.closures[c].coupling, std::abs(row.gap)};
    }
  }
  return worst;
}

}  // namespace pantin

#include <pantin/physics/stops/axis_response.hpp>

namespace pantin {

void AxisResponse::factor(const Tree& tree, std::span<const RigidMotion> grounds, Instant at,
                          std::span<const double> q) {
  const TreeLayout& layout = constraints_.layout();
  Articulated& kernel = constraints_.kernel();
  tree_ = &tree, grounds_ = grounds, at_ = at, q_ = q;
  zero_.assign(layout.rates, 0.0);
  driven_.assign(layout.rates, 0.0);
  kernel.hold_nothing();
  kernel.place(layout, tree, grounds, at, q, zero_);
  kernel.load_inertia(layout, tree);
  kernel.eliminate(layout, tree, {});
  kernel.clear_efforts(tree);
  if (!tree.has_closures()) return;
  kernel.substitute(layout, tree, driven_);
  ClosureSolver& solver = constraints_.loops().solver();
  solver.measure(layout, tree, kernel, grounds, at, {q, zero_, driven_});
  solver.factor(layout, tree, kernel);
  // Rows of loops that driven parts move accelerate by themselves; that is no answer to efforts.
  substitute(driven_);
}

void AxisResponse::push(std::uint32_t link, std::uint32_t rate, double effort) {
  constraints_.kernel().push_effort(constraints_.layout(), link, rate, effort);
}

void AxisResponse::substitute(std::span<double> out) {
  const TreeLayout& layout = constraints_.layout();
  Articulated& kernel = constraints_.kernel();
  kernel.substitute(layout, *tree_, out);
  if (tree_->has_closures()) {
    ClosureSolver& solver = constraints_.loops().solver();
    solver.measure(layout, *tree_, kernel, grounds_, at_, {q_, zero_, out});
    solver.solve(layout, *tree_, ClosureLevel::Acceleration, kernel);
    kernel.substitute(layout, *tree_, out);
  }
  kernel.clear_efforts(*tree_);
}

void AxisResponse::respond(std::span<double> out) {
  substitute(out);
  if (!tree_->has_closures() || !tree_->follows_driver) return;
  for (std::uint32_t j = tree_->v_begin; j < tree_->v_end; ++j) out[j] -= driven_[j];
}

}  // namespace pantin

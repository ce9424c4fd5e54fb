#include <pantin/physics/constraints/coupling_row.hpp>

#include <cmath>

#include <pantin/physics/constraints/joint_models.hpp>

namespace pantin {

namespace {

/// A number of a joint, B relative to A, and how the rates of its link change it.
struct NumberMotion {
  double value{0};
  double bias{0};                   ///< second derivative where the rates do not change
  std::array<double, 3> by_rate{};  ///< gradient
};

NumberMotion number_of(const TreeLink& link, std::uint32_t axis, const double* q, const double* v) {
  NumberMotion out;
  with_model(link, [&](auto model) {
    using Model = decltype(model);
    if constexpr (Model::kRates > 0 && Model::kRates == Model::kCoordinates) {
      if (!link.reversed) {
        out.value = q[axis];
        out.by_rate[axis] = 1;
        return;
      }
      for (int k = 0; k < Model::kRates; ++k) {
        double numbers[Model::kCoordinates], rates[Model::kRates] = {};
        std::copy_n(q, Model::kCoordinates, numbers);
        rates[k] = 1;
        model.reverse(numbers, rates);
        out.value = numbers[axis];
        out.by_rate[static_cast<std::size_t>(k)] = rates[axis];
      }
      if constexpr (requires(double* bias) { model.reversed_bias(q, v, bias); }) {
        double bias[Model::kRates];
        model.reversed_bias(q, v, bias);
        out.bias = bias[axis];
      }
    }
  });
  return out;
}

}  // namespace

Closure make_coupling(TreeLayout& layout, const JointCoupling& coupling, std::int32_t position) {
  Closure closure;
  closure.joint = static_cast<std::int32_t>(coupling.b);
  closure.coupling = position;
  closure.rows = 1;
  closure.a.link = layout.link_of_joint[coupling.a];
  closure.b.link = layout.link_of_joint[coupling.b];
  closure.coupled = {CoupledNumber{closure.a.link, coupling.axis_a, -coupling.ratio},
                     CoupledNumber{closure.b.link, coupling.axis_b, 1}};
  closure.offset = coupling.offset;
  append_path(layout, closure);
  return closure;
}

ClosureRow coupling_row(const TreeLayout& layout, const Closure& closure, const CoordinateMotion& motion) {
  ClosureRow row;
  row.gap = -closure.offset;
  row.size = std::abs(closure.offset);
  for (std::size_t i = 0; i < closure.coupled.size(); ++i) {
    const CoupledNumber& coupled = closure.coupled[i];
    const double factor = coupled.factor;
    const TreeLink& link = layout.links[static_cast<std::size_t>(coupled.link)];
    const NumberMotion number =
        number_of(link, coupled.axis, motion.q.data() + link.q, motion.v.data() + link.v);
    row.wrench.efforts[i].link = coupled.link;
    row.gap += factor * number.value;
    // Angles are measured from attitudes, and rounded as these are.
    const double least = is_length(link.kind, static_cast<int>(coupled.axis)) ? 0 : 1;
    row.size += std::abs(factor) * std::max(least, std::abs(number.value));
    row.acceleration += factor * number.bias;
    for (std::size_t k = 0; k < number.by_rate.size(); ++k) {
      const double weight = factor * number.by_rate[k];
      row.wrench.efforts[i].by_rate[k] = weight;
      if (weight == 0) continue;
      const double rate = weight * motion.v[link.v + k];
      row.rate += rate;
      row.rate_size += std::abs(rate);
      if (!motion.v_dot.empty()) row.acceleration += weight * motion.v_dot[link.v + k];
    }
  }
  return row;
}

}  // namespace pantin

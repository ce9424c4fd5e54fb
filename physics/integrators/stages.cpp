// What a Dynamics does unless it knows better: stage after stage, and no weights.
#include <algorithm>

#include <pantin/physics/integrators/integrator.hpp>

namespace pantin {

namespace {

void take_out(std::span<const double> stages, std::size_t count, std::size_t stage, std::span<double> one) {
  for (std::size_t i = 0; i < one.size(); ++i) one[i] = stages[i * count + stage];
}

void put_in(std::span<double> stages, std::size_t count, std::size_t stage, std::span<const double> one) {
  for (std::size_t i = 0; i < one.size(); ++i) stages[i * count + stage] = one[i];
}

}  // namespace

void Dynamics::derivatives(const Stages& stages) {
  const std::size_t count = stages.at.size(), nq = coordinates(), nv = velocities();
  one_stage_.resize(2 * (nq + nv));
  const std::span<double> all{one_stage_}, q = all.first(nq), v = all.subspan(nq, nv),
                                           q_dot = all.subspan(nq + nv, nq), v_dot = all.last(nv);
  for (std::size_t s = 0; s < count; ++s) {
    take_out(stages.q, count, s, q);
    take_out(stages.v, count, s, v);
    derivative(stages.at[s], q, v, q_dot, v_dot);
    put_in(stages.q_dot, count, s, q_dot);
    put_in(stages.v_dot, count, s, v_dot);
  }
}

void Dynamics::rates(const Stages& stages) {
  const std::size_t count = stages.at.size(), nq = coordinates(), nv = velocities();
  one_stage_.resize(2 * (nq + nv));
  const std::span<double> all{one_stage_}, q = all.first(nq), v = all.subspan(nq, nv),
                                           q_dot = all.subspan(nq + nv, nq);
  for (std::size_t s = 0; s < count; ++s) {
    take_out(stages.q, count, s, q);
    take_out(stages.v, count, s, v);
    rate(stages.at[s], q, v, q_dot);
    put_in(stages.q_dot, count, s, q_dot);
  }
}

void Dynamics::weights(std::span<double> q_weight, std::span<double> v_weight) {
  std::fill(q_weight.begin(), q_weight.end(), 1.0);
  std::fill(v_weight.begin(), v_weight.end(), 1.0);
}

}  // namespace pantin

// y1 = y + h sum b_i k_i with k_i = f(t + c_i h, y + h sum a_ij k_j), and the error estimate e = h sum (b_i -
// b*_i) k_i against the embedded method of fourth order. The last stage stands at y1: it is the first of the
// next step. J. R. Dormand, P. J. Prince, J. Comp. Appl. Math. 6, 19 (1980); coefficients as in E. Hairer, S.
// Norsett, G. Wanner, Solving Ordinary Differential Equations I, 2nd ed., table II.5.2. Next step: h * 0.9 (h
// tol / |e|)^(1/4), since the error per unit time is of fourth order (ibid., II.4).
#include <pantin/physics/integrators/dormand_prince.hpp>

#include <algorithm>
#include <array>
#include <cmath>

#include <pantin/physics/expects.hpp>
#include <pantin/physics/integrators/step_arrays.hpp>
#include <pantin/physics/setting_checks.hpp>

namespace pantin {
namespace {

constexpr int kStages = 7;
constexpr std::array<double, kStages> kNodes{0, 1. / 5, 3. / 10, 4. / 5, 8. / 9, 1, 1};
constexpr std::array<std::array<double, 6>, kStages> kMatrix{{
    {},
    {1. / 5},
    {3. / 40, 9. / 40},
    {44. / 45, -56. / 15, 32. / 9},
    {19372. / 6561, -25360. / 2187, 64448. / 6561, -212. / 729},
    {9017. / 3168, -355. / 33, 46732. / 5247, 49. / 176, -5103. / 18656},
    {35. / 384, 0, 500. / 1113, 125. / 192, -2187. / 6784, 11. / 84},
}};
constexpr std::array<double, kStages> kError{71. / 57600,      0,         -71. / 16695, 71. / 1920,
                                             -17253. / 339200, 22. / 525, -1. / 40};

constexpr double kSafety = 0.9, kShrinkMost = 0.2, kGrowMost = 5;
/// Steps shorter than this (of the time reached and the step asked for) are not tried.
constexpr double kShortest = 1e-14;

/// Sum of weights[j] * slopes[j] from the first `count` slopes.
void combine(std::span<double> out, const std::array<std::span<double>, kStages>& slopes,
             const double* weights, int count) {
  std::fill(out.begin(), out.end(), 0.0);
  for (int j = 0; j < count; ++j) {
    if (weights[j] != 0) add_scaled(out, weights[j], slopes[static_cast<std::size_t>(j)]);
  }
}

class DormandPrince final : public Integrator {
 public:
  explicit DormandPrince(const DormandPrinceSettings& settings) : settings_{settings} {}

  std::string_view name() const override { return "dormand-prince"; }
  int order() const override { return 5; }
  int evaluations(const Dynamics&) const override { return kStages; }
  StepControl* control() override { return &control_; }
  std::unique_ptr<Integrator> another() const override { return make_dormand_prince(settings_); }

  void step(Dynamics& dynamics, double t, double h, std::span<double> q, std::span<double> v) override {
    expect_step(dynamics, t, h, q, v);
    take_room(q.size(), v.size());
    control_.accepted = control_.refused = 0;
    control_.shortest = h;
    const bool controlled = std::isfinite(settings_.tolerance);
    const double end = t + h, floor = kShortest * (std::abs(t) + h);
    double next = controlled && control_.memory.next > 0 ? control_.memory.next : h, done = 0;
    dynamics.derivative({t, Side::After}, q, v, K_[0], L_[0]);
    while (done < h) {
      const bool last = next >= h - done - floor;
      const double part = last ? h - done : next;
      stages(dynamics, last ? end : t + done + part, part, q, v);
      const double error = controlled ? estimate(dynamics, part, q, v) : 0;
      const double ratio = error / settings_.tolerance;
      const double factor = ratio > 0 ? kSafety * std::pow(ratio, -0.25) : kGrowMost;
      if (!(ratio <= 1)) {  // too far off, or not a number
        ++control_.refused;
        next = part * std::clamp(std::isfinite(factor) ? factor : 0, kShrinkMost, 1.0);
        if (next < floor) return give_up(v);
        continue;
      }
      std::copy(q1_.begin(), q1_.end(), q.begin());
      std::copy(v1_.begin(), v1_.end(), v.begin());
      go_on(dynamics, last ? end : t + done + part, last, q, v);
      ++control_.accepted;
      control_.shortest = std::min(control_.shortest, part);
      // A part cut short by the end of the step says nothing against the step proposed before.
      const double proposed = part * std::clamp(factor, kShrinkMost, kGrowMost);
      next = last ? std::max(next, proposed) : proposed;
      done = last ? h : done + part;
    }
    control_.memory.next = next;
    dynamics.settle({t + h, Side::Before}, q, v);
  }

 private:
  void take_room(std::size_t q, std::size_t v) {
    work_.reserve((kStages + 2) * (q + v));
    for (std::span<double>& k : K_) k = work_.take(q);
    for (std::span<double>& l : L_) l = work_.take(v);
    q1_ = work_.take(q), v1_ = work_.take(v);
    q_sum_ = work_.take(q), v_sum_ = work_.take(v);
  }

  /// The last stage is the first of the next part, unless constraints move the state away from it.
  void go_on(Dynamics& dynamics, double t, bool last, std::span<double> q, std::span<double> v) {
    if (!dynamics.has_constraints() || last) {
      std::swap(K_[0], K_[6]);
      std::swap(L_[0], L_[6]);
      return;
    }
    dynamics.settle({t, Side::Before}, q, v);
    dynamics.derivative({t, Side::Before}, q, v, K_[0], L_[0]);
  }

  /// Stages two to seven; the last one stands at (q1, v1), the solution at `end`.
  void stages(Dynamics& dynamics, double end, double h, std::span<const double> q,
              std::span<const double> v) {
    for (std::size_t i = 1; i < kStages; ++i) {
      combine(q_sum_, K_, kMatrix[i].data(), static_cast<int>(i));
      combine(v_sum_, L_, kMatrix[i].data(), static_cast<int>(i));
      set_sum(q1_, q, h, q_sum_);
      set_sum(v1_, v, h, v_sum_);
      dynamics.derivative({end - (1 - kNodes[i]) * h, Side::Before}, q1_, v1_, K_[i], L_[i]);
    }
  }

  /// Error per unit time of the step just made.
  double estimate(Dynamics& dynamics, double h, std::span<const double> q, std::span<const double> v) {
    combine(q_sum_, K_, kError.data(), kStages);
    combine(v_sum_, L_, kError.data(), kStages);
    return dynamics.motion_error(q, v, q_sum_, v_sum_, h);
  }

  // No step is short enough. The manager finds what is not finite and keeps the state before.
  static void give_up(std::span<double> v) {
    std::fill(v.begin(), v.end(), std::numeric_limits<double>::quiet_NaN());
  }

  DormandPrinceSettings settings_{};
  StepControl control_{};
  WorkSpace work_{};
  std::array<std::span<double>, kStages> K_{}, L_{};
  std::span<double> q1_{}, v1_{}, q_sum_{}, v_sum_{};
};

}  // namespace

std::unique_ptr<Integrator> make_dormand_prince(const DormandPrinceSettings& settings) {
  PANTIN_EXPECTS(settings.tolerance > 0,
                 "tolerance is " + text_of(settings.tolerance) + "; give an error per second above zero");
  return std::make_unique<DormandPrince>(settings);
}

std::unique_ptr<Integrator> make_dormand_prince() { return make_dormand_prince(DormandPrinceSettings{}); }

}  // namespace pantin

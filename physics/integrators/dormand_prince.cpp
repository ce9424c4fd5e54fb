// y1 = y + h sum b_i k_i with k_i = f(t + c_i h, y + h sum a_ij k_j), and the error estimate e = h sum (b_i -
// b*_i) k_i against the embedded method of fourth order. The last stage stands at y1: it is the first of the
// next step. J. R. Dormand, P. J. Prince, J. Comp. Appl. Math. 6, 19 (1980); coefficients as in E. Hairer, S.
// Norsett, G. Wanner, Solving Ordinary Differential Equations I, 2nd ed., table II.5.2. Next step: h * 0.9 (h
// tol / |e|)^(1/4), since the error per unit time is of fourth order (ibid., II.4).
#include <pantin/physics/integrators/dormand_prince.hpp>

#include <algorithm>
#include <array>

#include <pantin/physics/expects.hpp>
#include <pantin/physics/integrators/controlled.hpp>
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

/// What the interpolant adds to the cubic through both ends.
constexpr std::array<double, kStages> kInside{-12715105075. / 11282082432,  0,
                                              87487479700. / 32700410799,   -10690763975. / 1880347072,
                                              701980252875. / 199316789632, -1453857185. / 822651844,
                                              69997945. / 29380423};

/// Sum of weights[j] * slopes[j] from the first `count` slopes.
void combine(std::span<double> out, const std::array<std::span<double>, kStages>& slopes,
             const double* weights, int count) {
  std::fill(out.begin(), out.end(), 0.0);
  for (int j = 0; j < count; ++j) {
    if (weights[j] != 0) add_scaled(out, weights[j], slopes[static_cast<std::size_t>(j)]);
  }
}

class DormandPrince final : public ControlledIntegrator {
 public:
  explicit DormandPrince(const DormandPrinceSettings& settings)
      : ControlledIntegrator{settings.tolerance}, settings_{settings} {}

  std::string_view name() const override { return "dormand-prince"; }
  int order() const override { return 5; }
  int evaluations(const Dynamics&) const override { return kStages; }
  std::unique_ptr<Integrator> another() const override { return make_dormand_prince(settings_); }

 private:
  void begin(Dynamics& dynamics, double t, double, std::span<const double> q,
             std::span<const double> v) override {
    dynamics_ = &dynamics;
    work_.reserve((kStages + 2) * (q.size() + v.size()));
    for (std::span<double>& k : K_) k = work_.take(q.size());
    for (std::span<double>& l : L_) l = work_.take(v.size());
    q1_ = work_.take(q.size()), v1_ = work_.take(v.size());
    q_sum_ = work_.take(q.size()), v_sum_ = work_.take(v.size());
    dynamics.derivative({t, Side::After}, q, v, K_[0], L_[0]);
  }

  double first_part(double, double h, std::span<const double>, std::span<const double>) override {
    return control_.memory.next > 0 ? control_.memory.next : h;
  }

  /// Stages two to seven; the last one stands at (q1, v1), the solution at the end.
  Outcome attempt(const Part& part, std::span<const double> q, std::span<const double> v) override {
    for (std::size_t i = 1; i < kStages; ++i) {
      combine(q_sum_, K_, kMatrix[i].data(), static_cast<int>(i));
      combine(v_sum_, L_, kMatrix[i].data(), static_cast<int>(i));
      set_sum(q1_, q, part.h, q_sum_);
      set_sum(v1_, v, part.h, v_sum_);
      dynamics_->derivative({part.end - (1 - kNodes[i]) * part.h, Side::Before}, q1_, v1_, K_[i], L_[i]);
    }
    if (!is_controlled()) return {true, 1};
    combine(q_sum_, K_, kError.data(), kStages);
    combine(v_sum_, L_, kError.data(), kStages);
    return decide(dynamics_->motion_error(q, v, q_sum_, v_sum_, part.h), {.order = 4, .grow_most = 5});
  }

  void accept(const Part& part, std::span<double> q, std::span<double> v) override {
    if (record_ != nullptr) record(part, q, v);
    std::copy(q1_.begin(), q1_.end(), q.begin());
    std::copy(v1_.begin(), v1_.end(), v.begin());
    const Instant end{part.end, Side::Before};
    const bool moves = dynamics_->has_constraints();
    if (part.last || moves) dynamics_->settle(end, q, v);
    if (part.last) return;
    // The last stage is the first of the next part, unless constraints move the state away from it.
    std::swap(K_[0], K_[6]);
    std::swap(L_[0], L_[6]);
    if (moves) dynamics_->derivative(end, q, v, K_[0], L_[0]);
  }

  /// y = y0 + x r + x (1 - x) s + x^2 (1 - x) u + x^2 (1 - x)^2 w  with  r = y1 - y0,  s = h k1 - r,
  /// u = r - h k7 - s,  w = h sum d_i k_i  (ibid., II.6).
  void record(const Part& part, std::span<const double> q, std::span<const double> v) {
    const MotionRecord::Room room = record_->add(part.t, part.h, 4, q, v);
    combine(q_sum_, K_, kInside.data(), kStages);
    combine(v_sum_, L_, kInside.data(), kStages);
    const auto fill = [&](std::size_t i, double y0, double y1, double k1, double k7, double inside) {
      const double r = y1 - y0, s = part.h * k1 - r, u = r - part.h * k7 - s, w = part.h * inside;
      room.at(1)[i] = r + s;
      room.at(2)[i] = u + w - s;
      room.at(3)[i] = -u - 2 * w;
      room.at(4)[i] = w;
    };
    for (std::size_t i = 0; i < q.size(); ++i) fill(i, q[i], q1_[i], K_[0][i], K_[6][i], q_sum_[i]);
    for (std::size_t i = 0; i < v.size(); ++i)
      fill(q.size() + i, v[i], v1_[i], L_[0][i], L_[6][i], v_sum_[i]);
  }

  DormandPrinceSettings settings_{};
  Dynamics* dynamics_{nullptr};
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

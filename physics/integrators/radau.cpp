// Slopes k_i = f(t + c_i h, y + h sum a_ij k_j) of y = (q, v), by an iteration that gives each stage an
// implicit part of its own,
//   (1 - h g_i J) (k_i' - k_i) = f(y + h sum a_ij k_j) - k_i,   J = df/dy at the begin of a step,
// with g chosen so that it contracts on the whole left half-plane, for motion that decays and that
// oscillates; P. J. van der Houwen, J. J. B. de Swart, Parallel linear system solvers for Runge-Kutta
// methods, 1997, for the idea. Nodes and weights: Radau IIA, E. Hairer, G. Wanner, Solving Ordinary
// Differential Equations II, 2nd ed., IV.5. The last node stands at the end of the step.
#include <pantin/physics/integrators/radau.hpp>

#include <Eigen/LU>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <pantin/physics/expects.hpp>
#include <pantin/physics/integrators/collocation.hpp>
#include <pantin/physics/integrators/stage_arrays.hpp>
#include <pantin/physics/integrators/step_arrays.hpp>
#include <pantin/physics/setting_checks.hpp>

namespace pantin {
namespace {

constexpr int kStages = 4;
constexpr std::array<double, kStages> kDiagonal{.25832332244025374, .08465508228266594, .20389264736174081,
                                                .30630376583844887};
constexpr double kSafety = 0.8, kShrinkMost = 0.2, kGrowMost = 3;
constexpr double kOvershoot = 2, kIterationShare = 0.05;
constexpr int kMostSweeps = 60, kStepsPerDerivative = 20;
constexpr double kSlow = 0.6;  ///< contraction from which the derivative is taken anew
/// A step that is given is cut into no shorter parts than this many; a call that refuses more steps than this
/// has met motion that no step resolves.
constexpr double kMostParts = 1e4;
constexpr int kMostRefusals = 1000000;
constexpr double kShortest = 1e-14, kRounding = 1e-15;
constexpr double kDifference = 3e-8, kLeastSize = 1e-3;  ///< of a number [m, rad, ...], for differences

class Radau final : public Integrator {
 public:
  explicit Radau(const RadauSettings& settings) : settings_{settings} {}

  std::string_view name() const override { return "radau"; }
  int order() const override { return 2 * kStages - 1; }
  int evaluations(const Dynamics&) const override { return 2 * kStages; }
  std::unique_ptr<Integrator> another() const override { return make_radau(settings_); }
  StepControl* control() override { return &control_; }

  void step(Dynamics& dynamics, double t, double h, std::span<double> q, std::span<double> v) override {
    expect_step(dynamics, t, h, q, v);
    control_.accepted = control_.refused = 0;
    control_.shortest = h;
    if (q.empty() && v.empty()) return;
    begin(dynamics, q, v);
    const double end = t + h, least = std::isfinite(settings_.tolerance) ? 0 : h / kMostParts;
    const double floor = std::max(kShortest * (std::abs(t) + h), least);
    const bool controlled = std::isfinite(settings_.tolerance);
    double next = controlled && control_.memory.next > 0 ? control_.memory.next : (controlled ? 0.01 * h : h),
           done = 0;
    while (done < h) {
      const double rest = h - done;
      const bool last = next >= rest - floor;
      const double part = last ? rest : (next > 0.5 * rest ? 0.5 * rest : next);
      const Outcome outcome = attempt(last ? end - part : t + done, part);
      if (!outcome.accepted) {
        ++control_.refused;
        next = part * outcome.factor;
        if (next < floor || control_.refused > kMostRefusals) return give_up(v);
        continue;
      }
      add_compensated(kStages, y_, kept_back_, part, k_, method_.b);
      std::copy_n(y_.begin(), q.size(), q.begin());
      std::copy_n(y_.begin() + static_cast<std::ptrdiff_t>(q.size()), v.size(), v.begin());
      dynamics.settle({last ? end : t + done + part, Side::Before}, q, v);
      take(q, v);
      ++control_.accepted;
      ++age_;
      control_.shortest = std::min(control_.shortest, part);
      const double proposed = part * outcome.factor;
      next = last ? std::max(next, proposed) : proposed;
      done = last ? h : done + part;
    }
    control_.memory.next = next;
  }

 private:
  struct Outcome {
    bool accepted{false};
    double factor{1};
  };

  void begin(Dynamics& dynamics, std::span<const double> q, std::span<const double> v) {
    dynamics_ = &dynamics;
    nq_ = q.size();
    n_ = q.size() + v.size();
    work_.reserve((3 * kStages + 6) * n_);
    for (std::span<double>* stages : {&Y_, &k_, &f_}) *stages = work_.take(n_ * kStages);
    for (std::span<double>* one : {&y_, &slope_, &trial_, &trial_slope_, &kept_back_, &weight_})
      *one = work_.take(n_);
    std::fill(kept_back_.begin(), kept_back_.end(), 0.0);
    dynamics.weights(weight_.first(nq_), weight_.subspan(nq_));
    take(q, v);
    const auto n = static_cast<Eigen::Index>(n_);
    if (J_.rows() != n) J_.resize(n, n), x_.resize(n);
    age_ = kStepsPerDerivative;  // what was differentiated in another call may be another system
    factored_for_ = 0;
  }

  void take(std::span<const double> q, std::span<const double> v) {
    std::copy(q.begin(), q.end(), y_.begin());
    std::copy(v.begin(), v.end(), y_.begin() + static_cast<std::ptrdiff_t>(nq_));
  }

  void evaluate(Instant at, std::span<const double> y, std::span<double> slope) {
    dynamics_->derivative(at, y.first(nq_), y.subspan(nq_), slope.first(nq_), slope.subspan(nq_));
  }

  /// df/dy by one-sided differences at the begin of the step; slope_ is f there.
  void differentiate(double t, double h) {
    std::copy(y_.begin(), y_.end(), trial_.begin());
    for (std::size_t j = 0; j < n_; ++j) {
      const double by =
          kDifference * std::max({std::abs(y_[j]), std::min(std::abs(h * slope_[j]), 1.0), kLeastSize});
      trial_[j] = y_[j] + by;
      evaluate({t, Side::After}, trial_, trial_slope_);
      trial_[j] = y_[j];
      for (std::size_t i = 0; i < n_; ++i) {
        J_(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) = (trial_slope_[i] - slope_[i]) / by;
      }
    }
    age_ = 0;
    factored_for_ = 0;
  }

  void factor(double h) {
    if (h == factored_for_) return;
    for (std::size_t i = 0; i < kStages; ++i) {
      lu_[i].compute(Eigen::MatrixXd::Identity(J_.rows(), J_.cols()) - h * kDiagonal[i] * J_);
    }
    factored_for_ = h;
  }

  Outcome attempt(double t, double h) {
    for (std::size_t i = 0; i < kStages; ++i) at_[i] = {t + h * method_.c[i], Side::Before};
    evaluate({t, Side::After}, y_, slope_);
    if (age_ >= kStepsPerDerivative) differentiate(t, h);
    factor(h);
    spread(kStages, k_, slope_);
    const bool controlled = std::isfinite(settings_.tolerance);
    double last = 0;
    for (int sweep = 1; sweep <= kMostSweeps; ++sweep) {
      const double change = improve(h), rho = sweep > 1 ? quotient(change, last) : 1;
      if (!std::isfinite(change)) break;
      const double enough =
          std::max(controlled ? kIterationShare * settings_.tolerance : 0, kRounding * slope_size(h));
      const bool stalls = sweep > 6 && rho > 0.9 && change <= 1e4 * enough + 1e-11 * slope_size(h);
      if (change <= enough || stalls || (sweep > 1 && rho < 1 && change * rho < enough * (1 - rho))) {
        if (rho > kSlow && age_ > 0) age_ = kStepsPerDerivative;
        return judge(h);
      }
      if (sweep > 4 && rho > 1.5) break;
      last = change;
    }
    age_ = kStepsPerDerivative;
    return {false, 0.3};
  }

  /// One sweep: says by how much it changed the slopes, as motion per unit time.
  double improve(double h) {
    add_stages(kStages, Y_, y_, h, k_, method_.a);
    const std::size_t cut = nq_ * kStages;
    dynamics_->derivatives({at_, Y_.first(cut), Y_.subspan(cut), f_.first(cut), f_.subspan(cut)});
    double most = 0;
    for (std::size_t s = 0; s < kStages; ++s) {
      for (std::size_t i = 0; i < n_; ++i)
        x_[static_cast<Eigen::Index>(i)] = f_[i * kStages + s] - k_[i * kStages + s];
      x_ = lu_[s].solve(x_);
      for (std::size_t i = 0; i < n_; ++i) {
        const double by = x_[static_cast<Eigen::Index>(i)];
        k_[i * kStages + s] += by;
        const double size = (i < nq_ ? 1 : h) * weight_[i] * std::abs(by);
        if (!(size <= most)) most = size;
      }
    }
    return most;
  }

  double slope_size(double h) const {
    return std::max(greatest(kStages, k_.first(nq_ * kStages), weight_.first(nq_)),
                    h * greatest(kStages, k_.subspan(nq_ * kStages), weight_.subspan(nq_)));
  }

  /// As in gauss.cpp: the first Legendre coefficient that the step leaves out, by how the last ones fall off.
  Outcome judge(double h) {
    if (!std::isfinite(settings_.tolerance)) return {true, 1};
    std::array<double, kStages> sizes{};
    for (std::size_t k = 0; k < kStages; ++k) {
      coefficients(kStages, trial_, k_, method_.legendre[k]);
      sizes[k] = std::max(greatest(trial_.first(nq_), weight_.first(nq_)),
                          h * greatest(trial_.subspan(nq_), weight_.subspan(nq_)));
    }
    const double noise = 10 * kRounding * slope_size(h);
    const double decay =
        std::sqrt(std::max(sizes[2], sizes[3]) / std::max({sizes[0], sizes[1], noise, 1e-300}));
    double error = 0;
    if (std::max(sizes[2], sizes[3]) > noise) {
      const double top =
          dynamics_->motion_error(y_.first(nq_), y_.subspan(nq_), trial_.first(nq_), trial_.subspan(nq_), h);
      error = top * std::pow(std::min(decay, 1.0), kStages - 1);
    }
    const double ratio = error / settings_.tolerance;
    const double by = ratio > 0 ? kSafety * std::pow(ratio, -1.0 / (kStages + 2)) : kGrowMost;
    if (!(ratio <= kOvershoot)) return {false, std::clamp(std::isfinite(by) ? by : 0, kShrinkMost, 0.9)};
    return {true, std::clamp(by, kShrinkMost, kGrowMost)};
  }

  // No step is short enough. The manager finds what is not finite and keeps the state before.
  void give_up(std::span<double> v) {
    control_.memory = {};
    std::fill(v.begin(), v.end(), std::numeric_limits<double>::quiet_NaN());
  }

  RadauSettings settings_{};
  Collocation method_{radau_collocation(kStages)};
  StepControl control_{};
  Dynamics* dynamics_{nullptr};
  std::size_t nq_{0}, n_{0};
  WorkSpace work_{};
  std::span<double> Y_{}, k_{}, f_{}, y_{}, slope_{}, trial_{}, trial_slope_{}, kept_back_{}, weight_{};
  std::array<Instant, kStages> at_{};
  Eigen::MatrixXd J_{};
  Eigen::VectorXd x_{};
  std::array<Eigen::PartialPivLU<Eigen::MatrixXd>, kStages> lu_{};
  int age_{0};              ///< steps since J was taken
  double factored_for_{0};  ///< step [s]; 0 = none
};

}  // namespace

std::unique_ptr<Integrator> make_radau(const RadauSettings& settings) {
  PANTIN_EXPECTS(settings.tolerance > 0,
                 "tolerance is " + text_of(settings.tolerance) + "; give an error per second above zero");
  return std::make_unique<Radau>(settings);
}
std::unique_ptr<Integrator> make_radau() { return make_radau(RadauSettings{}); }

}  // namespace pantin

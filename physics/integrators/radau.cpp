// Slopes k_i = f(t + c_i h, y + h sum a_ij k_j) of y = (q, v), by an iteration that gives each stage an
// implicit part of its own,
//   (1 - h g_i J) (k_i' - k_i) = f(y + h sum a_ij k_j) - k_i,   J = df/dy at the begin of a step,
// with g chosen so that it contracts on the whole left half-plane, for motion that decays and that
// oscillates; P. J. van der Houwen, J. J. B. de Swart, Parallel linear system solvers for Runge-Kutta
// methods, 1997, for the idea. Nodes and weights: Radau IIA, E. Hairer, G. Wanner, Solving Ordinary
// Differential Equations II, 2nd ed., IV.5. The last node stands at the end of the step.
#include <pantin/physics/integrators/radau.hpp>

#include <algorithm>
#include <array>
#include <cmath>

#include <pantin/physics/expects.hpp>
#include <pantin/physics/integrators/collocation.hpp>
#include <pantin/physics/integrators/controlled.hpp>
#include <pantin/physics/integrators/group_solver.hpp>
#include <pantin/physics/integrators/stage_arrays.hpp>
#include <pantin/physics/integrators/step_arrays.hpp>
#include <pantin/physics/setting_checks.hpp>

namespace pantin {
namespace {

constexpr int kStages = 4;
constexpr std::array<double, kStages> kDiagonal{.25832332244025374, .08465508228266594, .20389264736174081,
                                                .30630376583844887};
constexpr double kIterationShare = 0.05;
constexpr int kMostSweeps = 60, kStepsPerDerivative = 20;
constexpr double kSlow = 0.6;  ///< contraction from which the derivative is taken anew
constexpr double kRounding = 1e-15;
constexpr double kFirstPart = 0.01;                      ///< of the step asked for, where nothing is known
constexpr double kDifference = 3e-8, kLeastSize = 1e-3;  ///< of a number [m, rad, ...], for differences

class Radau final : public ControlledIntegrator {
 public:
  explicit Radau(const RadauSettings& settings)
      : ControlledIntegrator{settings.tolerance}, settings_{settings} {}

  std::string_view name() const override { return "radau"; }
  int order() const override { return 2 * kStages - 1; }
  int evaluations(const Dynamics&) const override { return 2 * kStages; }
  std::unique_ptr<Integrator> another() const override { return make_radau(settings_); }

 private:
  void begin(Dynamics& dynamics, double, double, std::span<const double> q,
             std::span<const double> v) override {
    dynamics_ = &dynamics;
    nq_ = q.size();
    n_ = q.size() + v.size();
    work_.reserve((3 * kStages + 7) * n_);
    for (std::span<double>* stages : {&Y_, &k_, &f_}) *stages = work_.take(n_ * kStages);
    for (std::span<double>* one : {&y_, &slope_, &trial_, &change_, &x_, &kept_back_, &weight_})
      *one = work_.take(n_);
    std::fill(kept_back_.begin(), kept_back_.end(), 0.0);
    dynamics.weights(weight_.first(nq_), weight_.subspan(nq_));
    take(q, v);
    dynamics.list_groups(J_.groups);
    age_ = kStepsPerDerivative;  // what was differentiated in another call may be another system
    factored_for_ = 0;
  }

  double first_part(double, double h, std::span<const double>, std::span<const double>) override {
    return control_.memory.next > 0 ? control_.memory.next : kFirstPart * h;
  }

  void accept(const Part& part, std::span<double> q, std::span<double> v) override {
    if (record_ != nullptr) record(part, q, v);
    add_compensated(kStages, y_, kept_back_, part.h, k_, method_.b);
    std::copy_n(y_.begin(), q.size(), q.begin());
    std::copy_n(y_.begin() + static_cast<std::ptrdiff_t>(q.size()), v.size(), v.begin());
    dynamics_->settle({part.end, Side::Before}, q, v);
    take(q, v);
    ++age_;
  }

  void record(const Part& part, std::span<const double> q, std::span<const double> v) {
    const MotionRecord::Room room = record_->add(part.t, part.h, kStages, q, v);
    for (std::size_t k = 0; k < kStages; ++k) {
      coefficients(kStages, room.at(k + 1), k_, method_.powers[k]);
      for (double& x : room.at(k + 1)) x *= part.h;
    }
  }

  void take(std::span<const double> q, std::span<const double> v) {
    std::copy(q.begin(), q.end(), y_.begin());
    std::copy(v.begin(), v.end(), y_.begin() + static_cast<std::ptrdiff_t>(nq_));
  }

  void evaluate(Instant at, std::span<const double> y, std::span<double> slope) {
    dynamics_->derivative(at, y.first(nq_), y.subspan(nq_), slope.first(nq_), slope.subspan(nq_));
  }

  /// df/dy at the begin of the step; slope_ is f there.
  void differentiate(double t, double h) {
    for (std::size_t j = 0; j < n_; ++j) {
      change_[j] =
          kDifference * std::max({std::abs(y_[j]), std::min(std::abs(h * slope_[j]), 1.0), kLeastSize});
    }
    J_.fit();
    dynamics_->jacobian({.at = {t, Side::After},
                         .q = y_.first(nq_),
                         .v = y_.subspan(nq_),
                         .slope = slope_,
                         .change = change_},
                        J_);
    age_ = 0;
    factored_for_ = 0;
  }

  void factor(double h) {
    if (h == factored_for_) return;
    for (std::size_t i = 0; i < kStages; ++i) solvers_[i].factor(J_, h * kDiagonal[i]);
    factored_for_ = h;
  }

  Outcome attempt(const Part& part, std::span<const double>, std::span<const double>) override {
    const double t = part.t, h = part.h;
    for (std::size_t i = 0; i < kStages; ++i) at_[i] = {t + h * method_.c[i], Side::Before};
    evaluate({t, Side::After}, y_, slope_);
    if (age_ >= kStepsPerDerivative) differentiate(t, h);
    factor(h);
    spread(kStages, k_, slope_);
    double last = 0;
    for (int sweep = 1; sweep <= kMostSweeps; ++sweep) {
      const double change = improve(h), rho = sweep > 1 ? quotient(change, last) : 1;
      if (!std::isfinite(change)) break;
      const double enough =
          std::max(is_controlled() ? kIterationShare * tolerance() : 0, kRounding * slope_size(h));
      // What changes at the level of rounding will not settle further.
      const bool stalls = (sweep > 2 && rho > 0.5 && change <= 100 * kRounding * slope_size(h)) ||
                          (sweep > 6 && rho > 0.9 && change <= 1e4 * enough + 1e-11 * slope_size(h));
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
      for (std::size_t i = 0; i < n_; ++i) x_[i] = f_[i * kStages + s] - k_[i * kStages + s];
      solvers_[s].solve(J_, x_);
      for (std::size_t i = 0; i < n_; ++i) {
        const double by = x_[i];
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
    if (!is_controlled()) return {true, 1};
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
    return decide(error, {.order = kStages + 2, .safety = 0.8, .grow_most = 3, .overshoot = 2});
  }

  RadauSettings settings_{};
  Collocation method_{radau_collocation(kStages)};
  Dynamics* dynamics_{nullptr};
  std::size_t nq_{0}, n_{0};
  WorkSpace work_{};
  std::span<double> Y_{}, k_{}, f_{}, y_{}, slope_{}, trial_{}, change_{}, x_{}, kept_back_{}, weight_{};
  std::array<Instant, kStages> at_{};
  Jacobian J_{};
  std::array<GroupSolver, kStages> solvers_{};
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

// Slopes k_i = f(t + c_i h, y + h sum a_ij k_j) of y = (q, v), by an iteration that gives each stage an
// implicit part of its own,
//   (1 - h g_i J) (k_i' - k_i) = f(y + h sum a_ij k_j) - k_i,   J = df/dy at the begin of a step, or beside
//   it what stiff forces along lines do at the stage (stage_factors.hpp),
// with g chosen so that it contracts on the whole left half-plane, for motion that decays and that
// oscillates; P. J. van der Houwen, J. J. B. de Swart, Parallel linear system solvers for Runge-Kutta
// methods, 1997, for the idea. Nodes and weights: Radau IIA, E. Hairer, G. Wanner, Solving Ordinary
// Differential Equations II, 2nd ed., IV.5. The last node stands at the end of the step.
#include <pantin/physics/integrators/radau.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <pantin/physics/expects.hpp>
#include <pantin/physics/integrators/collocation.hpp>
#include <pantin/physics/integrators/controlled.hpp>
#include <pantin/physics/integrators/stage_arrays.hpp>
#include <pantin/physics/integrators/stage_factors.hpp>
#include <pantin/physics/integrators/step_arrays.hpp>
#include <pantin/physics/setting_checks.hpp>

namespace pantin {
namespace {

constexpr int kStages = 4;
constexpr std::array<double, kStages> kDiagonal{.25832332244025374, .08465508228266594, .20389264736174081,
                                                .30630376583844887};
constexpr double kIterationShare = 0.05;
constexpr int kMostSweeps = 60, kMostSweepsBesideLines = 100, kStepsPerDerivative = 20;
constexpr double kSlow = 0.6;  ///< contraction from which the derivative is taken anew
constexpr double kRounding = 1e-15;
constexpr double kGrowAgain = 1.5;   ///< of a step that is given and was cut, from part to part
constexpr double kFirstPart = 0.01;  ///< of the step asked for, where nothing is known
// Where steps are controlled, a shorter one with J at the begin costs less than one with rows for forces
// along lines, unless steps must be cut time and again: a step cut counts so many, one that did well takes
// one off.
constexpr int kPriceOfCut = 2, kTooManyCuts = 5;
constexpr int kStepsPerTrial = 20;  ///< with such rows, until J is tried again
constexpr int kIdleSweeps = 5;      ///< without a lesser change: rounding is all that is left
constexpr double kAstray = 30;      ///< times the least change: sweeps do not come back from there

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
    work_.reserve((3 * kStages + 6) * n_);
    for (std::span<double>* stages : {&Y_, &k_, &f_}) *stages = work_.take(n_ * kStages);
    for (std::span<double>* one : {&y_, &slope_, &trial_, &x_, &kept_back_, &weight_}) *one = work_.take(n_);
    std::fill(kept_back_.begin(), kept_back_.end(), 0.0);
    dynamics.weights(weight_.first(nq_), weight_.subspan(nq_));
    take(q, v);
    factors_.begin(dynamics);
    age_ = kStepsPerDerivative;  // what was differentiated in another call may be another system
    lined_ = cuts_ = 0;
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
    lined_ = std::max(lined_ - 1, 0);
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

  Outcome attempt(const Part& part, std::span<const double>, std::span<const double>) override {
    const double t = part.t, h = part.h;
    for (std::size_t i = 0; i < kStages; ++i) at_[i] = {t + h * method_.c[i], Side::Before};
    evaluate({t, Side::After}, y_, slope_);
    if (lined_ == 0) {
      if (age_ >= kStepsPerDerivative || factors_.are_beside_lines()) take_derivative(t, h, false);
      if (sweep(h)) {
        cuts_ = std::max(cuts_ - 1, 0);
        return judge(h);
      }
      age_ = kStepsPerDerivative;
      cuts_ += kPriceOfCut;
      if (is_controlled() && cuts_ < kTooManyCuts) return {false, 0.3};
    }
    // The lines of stiff springs turn with the motion, which J at the begin does not know.
    if (factors_.has_lines()) {
      if (age_ >= kStepsPerDerivative || !factors_.are_beside_lines()) take_derivative(t, h, true);
      if (sweep(h)) {
        lined_ = kStepsPerTrial;
        return judge(h);
      }
      age_ = kStepsPerDerivative;
    }
    return {false, 0.3};
  }

  void take_derivative(double t, double h, bool beside_lines) {
    factors_.take({t, Side::After}, h, y_, slope_, beside_lines);
    age_ = 0;
  }

  /// Sweeps until the slopes settle; says whether they do.
  bool sweep(double h) {
    factors_.factor(h);
    spread(kStages, k_, slope_);
    // Places are known to rounding, of which stiff forces make slopes: `noise` at least, and up to `loud` at
    // the stage with the least implicit part. A tolerance asks for less than that, or is not met.
    const double noise = kRounding * place_size() / h;
    const double loud = is_controlled() ? 0 : 30 * noise / (kDiagonal[1] * kDiagonal[1]);
    double last = 0, least = std::numeric_limits<double>::infinity();
    int best = 0;  // sweep with the least change
    const int most = factors_.are_beside_lines() ? kMostSweepsBesideLines : kMostSweeps;
    for (int count = 1; count <= most; ++count) {
      evaluate_stages(h);
      if (factors_.are_beside_lines()) factors_.place_lines(stages());
      const double change = improve(h), rho = count > 1 ? quotient(change, last) : 1;
      if (!std::isfinite(change)) return false;
      const double enough =
          std::max(is_controlled() ? kIterationShare * tolerance() : 0, kRounding * slope_size(h));
      // What changes at the level of rounding will not settle further.
      const bool stalls =
          (count > 2 && rho > 0.5 && change <= 100 * kRounding * slope_size(h)) ||
          (count > 6 && rho > 0.9 && change <= 1e4 * enough + 1e-11 * slope_size(h) + 10 * noise) ||
          (count > best + kIdleSweeps && change <= loud);
      if (change <= enough || stalls || (count > 1 && rho < 1 && change * rho < enough * (1 - rho))) {
        if (rho > kSlow && age_ > 0) age_ = kStepsPerDerivative;
        return true;
      }
      // Beside lines the first sweeps wander until these have turned to where they belong.
      if (count > 4 && rho > 1.5 && change > loud &&
          (!factors_.are_beside_lines() || change > kAstray * least))
        return false;
      last = change;
      if (change < least) least = change, best = count;
    }
    return false;
  }

  Stages stages() {
    const std::size_t cut = nq_ * kStages;
    return {at_, Y_.first(cut), Y_.subspan(cut), f_.first(cut), f_.subspan(cut)};
  }

  void evaluate_stages(double h) {
    add_stages(kStages, Y_, y_, h, k_, method_.a);
    dynamics_->derivatives(stages());
  }

  /// Says by how much it changed the slopes, as motion per unit time.
  double improve(double h) {
    double most = 0;
    for (std::size_t s = 0; s < kStages; ++s) {
      for (std::size_t i = 0; i < n_; ++i) x_[i] = f_[i * kStages + s] - k_[i * kStages + s];
      factors_.solve(s, x_);
      for (std::size_t i = 0; i < n_; ++i) {
        const double by = x_[i];
        k_[i * kStages + s] += by;
        const double size = (i < nq_ ? 1 : h) * weight_[i] * std::abs(by);
        if (!(size <= most)) most = size;
      }
    }
    return most;
  }

  /// What forces know to rounding; attitudes count as one.
  double place_size() const {
    double most = 0;
    for (std::size_t i = 0; i < nq_; ++i) most = std::max(most, weight_[i] * std::max(std::abs(y_[i]), 1.0));
    return most;
  }

  double slope_size(double h) const {
    return std::max(greatest(kStages, k_.first(nq_ * kStages), weight_.first(nq_)),
                    h * greatest(kStages, k_.subspan(nq_ * kStages), weight_.subspan(nq_)));
  }

  /// As in gauss.cpp: the first Legendre coefficient that the step leaves out, by how the last ones fall off.
  Outcome judge(double h) {
    if (!is_controlled()) return {true, kGrowAgain};
    std::array<double, kStages> sizes{};
    for (std::size_t k = 0; k < kStages; ++k) {
      std::array<double, kMostNodes> row{};
      for (std::size_t j = 0; j < kStages; ++j) row[j] = method_.legendre[j][k];
      coefficients(kStages, trial_, k_, row);
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
  std::span<double> Y_{}, k_{}, f_{}, y_{}, slope_{}, trial_{}, x_{}, kept_back_{}, weight_{};
  std::array<Instant, kStages> at_{};
  StageFactors factors_{kDiagonal};
  int age_{0};    ///< steps since J was taken
  int cuts_{0};   ///< for which J at the begin did not do, weighed
  int lined_{0};  ///< so many steps more forces along lines are kept beside J
};

}  // namespace

std::unique_ptr<Integrator> make_radau(const RadauSettings& settings) {
  PANTIN_EXPECTS(settings.tolerance > 0,
                 "tolerance is " + text_of(settings.tolerance) + "; give an error per second above zero");
  return std::make_unique<Radau>(settings);
}
std::unique_ptr<Integrator> make_radau() { return make_radau(RadauSettings{}); }

}  // namespace pantin

// Stage values  V_i = v + h sum a_ij F_j,  Q_i = q + h sum a_ij K_j,  K_i = rate(Q_i, V_i),  F_i = v'(Q_i,
// V_i), iterated until they repeat; then  q1 = q + h sum b_j K_j,  v1 = v + h sum b_j F_j, in compensated
// sums. K is taken at the newest V, so that motion along q' = v converges as for an equation of second order.
// The iteration starts from the series of the step before, and bounds the step (sweep_forecast.hpp) as the
// error does (series_tail.hpp). M. Antonana, E. Alberdi, J. Makazaga, A. Murua, An implicit symplectic solver
// for high-precision long-term integrations of the Solar System, 2022, for the arrangement of stages; E.
// Hairer, C. Lubich, G. Wanner, Geometric Numerical Integration, 2nd ed., VIII.6, for starting and stopping.
#include <pantin/physics/integrators/gauss.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include <pantin/physics/expects.hpp>
#include <pantin/physics/integrators/collocation.hpp>
#include <pantin/physics/integrators/controlled.hpp>
#include <pantin/physics/integrators/series_tail.hpp>
#include <pantin/physics/integrators/stage_arrays.hpp>
#include <pantin/physics/integrators/step_arrays.hpp>
#include <pantin/physics/integrators/sweep_forecast.hpp>
#include <pantin/physics/setting_checks.hpp>

namespace pantin {
namespace {

constexpr double kSafety = 0.75, kShrinkMost = 0.2;
/// Steps are chosen for this part of the tolerance, since errors of long runs add up, and accepted up to this
/// multiple of that.
constexpr double kAim = 0.1, kOvershoot = 2;
/// The iteration stops where what it would still change is this part of the tolerance.
constexpr double kIterationShare = 0.1;
/// A step that needs more sweeps than this is shortened; than the second number, where it is given.
constexpr int kMostSweeps = 16, kMostSweepsFixed = 60;
/// A second sweep that changes this many times what the first did has started from a wrong series.
constexpr double kDiverges = 2;
/// The first step, as a part of the time in which slopes change by themselves, for each stage.
constexpr double kFirstReach = 0.12;
/// Slopes are not known better than this, relative to themselves.
constexpr double kRounding = 1e-15;

class Gauss final : public ControlledIntegrator {
 public:
  explicit Gauss(const GaussSettings& settings)
      : ControlledIntegrator{settings.tolerance},
        settings_{settings},
        method_{gauss_collocation(settings.stages)} {}

  std::string_view name() const override {
    return settings_.stages == 4 ? "gauss8" : settings_.stages == 8 ? "gauss16" : "gauss";
  }
  int order() const override { return 2 * settings_.stages; }
  int evaluations(const Dynamics&) const override { return 2 * settings_.stages; }
  std::unique_ptr<Integrator> another() const override { return make_gauss(settings_); }

 private:
  /// Slopes at the stages, of coordinates and velocities.
  struct Slopes {
    std::span<double> q{}, v{};
  };

  void begin(Dynamics& dynamics, double, double, std::span<const double> q,
             std::span<const double> v) override {
    dynamics_ = &dynamics;
    refused_ = {};
    const auto s = static_cast<std::size_t>(method_.nodes);
    const std::size_t nq = q.size(), nv = v.size();
    work_.reserve((4 * s + 1) * (nq + nv));
    Q_ = work_.take(nq * s), V_ = work_.take(nv * s);
    now_ = {work_.take(nq * s), work_.take(nv * s)};
    fresh_ = {work_.take(nq * s), work_.take(nv * s)};
    series_ = {work_.take(nq * s), work_.take(nv * s)};
    q_weight_ = work_.take(nq), v_weight_ = work_.take(nv);
    dynamics.weights(q_weight_, v_weight_);
    plain_ = dynamics.rates_are_velocities();

    StepMemory& memory = control_.memory;
    continues_ = memory.reached.size() == nq + nv && memory.slopes.size() == (nq + nv) * s &&
                 std::equal(q.begin(), q.end(), memory.reached.begin()) &&
                 std::equal(v.begin(), v.end(), memory.reached.begin() + static_cast<std::ptrdiff_t>(nq));
    if (!continues_) {
      memory.reached.resize(nq + nv);
      memory.slopes.resize((nq + nv) * s);
      memory.kept_back.assign(nq + nv, 0.0);
    }
    const std::span<double> slopes{memory.slopes}, kept{memory.kept_back};
    before_ = {slopes.first(nq * s), slopes.last(nv * s)};
    kept_ = {kept.first(nq), kept.last(nv)};
    if (continues_) sizes_before_ = sizes_of(before_);
  }

  void finish(std::span<const double> q, std::span<const double> v) override {
    StepMemory& memory = control_.memory;
    std::copy(q.begin(), q.end(), memory.reached.begin());
    std::copy(v.begin(), v.end(), memory.reached.begin() + static_cast<std::ptrdiff_t>(q.size()));
  }

  /// Where nothing is known, from how fast the slopes change over a short trial.
  double first_part(double t, double h, std::span<const double> q, std::span<const double> v) override {
    if (continues_) return control_.memory.next;
    const std::span<double> k0 = now_.q.first(q.size()), f0 = now_.v.first(v.size());
    const std::span<double> k1 = fresh_.q.first(q.size()), f1 = fresh_.v.first(v.size());
    const std::span<double> q1 = Q_.first(q.size()), v1 = V_.first(v.size());
    const double trial = 1e-3 * h;
    dynamics_->derivative({t, Side::After}, q, v, k0, f0);
    set_sum(v1, v, trial, f0);
    dynamics_->rate({t, Side::After}, q, v1, k0);
    set_sum(q1, q, trial, k0);
    dynamics_->derivative({t + trial, Side::Before}, q1, v1, k1, f1);
    // Accelerations change by omega^2 trial^2 of themselves, rates, at equal velocities, by omega trial.
    const double per_force =
        quotient(greatest_difference(f1, f0, v_weight_), greatest(f0, v_weight_) + greatest(f1, v_weight_));
    const double per_rate = quotient(greatest_difference(k1, k0, q_weight_), greatest(k0, q_weight_));
    const double omega = std::max(std::sqrt(per_force), per_rate) / trial;
    return omega * h > kFirstReach * settings_.stages ? kFirstReach * settings_.stages / omega : h;
  }

  Outcome attempt(const Part& part, std::span<const double> q, std::span<const double> v) override {
    const Outcome outcome = iterate(part, q, v);
    if (!outcome.accepted) refused_.h = part.h;
    return outcome;
  }

  Outcome iterate(const Part& part, std::span<const double> q, std::span<const double> v) {
    const double h = part.h;
    for (std::size_t i = 0; i < at_.size(); ++i) at_[i] = {part.t + h * method_.c[i], Side::Before};
    start(part, q, v);
    refused_.settled = false;
    const int most = is_controlled() ? kMostSweeps : kMostSweepsFixed;
    enough_ = std::max(is_controlled() ? kIterationShare * tolerance() : 0, kRounding * slope_size(h));
    double last_change = 0;
    for (int sweep = 1;; ++sweep) {
      const double change = this->sweep(h, q, v), rho = sweep > 1 ? quotient(change, last_change) : 1;
      settling_ = {settling_.ratio, sweep, sweep == 1 ? change : settling_.first, change};
      if (change <= enough_ || (sweep > 1 && rho < 1 && change * rho < enough_ * (1 - rho))) {
        return judge(h, q, v);
      }
      // What changes at the level of rounding will not settle further.
      if (sweep > 2 && rho > 0.5 && change <= 100 * kRounding * slope_size(h)) return judge(h, q, v);
      const bool hopeless =
          (sweep == 2 && rho > kDiverges) ||
          (sweep > 2 && (rho > 0.9 || change * power(rho, most - sweep) > enough_ * (1 - rho)));
      if (!std::isfinite(change) || hopeless || sweep == most) {
        return {false, std::isfinite(change) ? std::clamp(std::sqrt(0.2 / rho), 0.25, 0.7) : kShrinkMost};
      }
      last_change = change;
    }
  }

  /// Slopes to start from: of the refused part, which reaches further, of the step before, or of now.
  void start(const Part& part, std::span<const double> q, std::span<const double> v) {
    settling_ = {};
    if (refused_.settled) return combine(now_, series_, legendre_at_nodes(method_, 0, part.h / refused_.h));
    if (continues_) {
      settling_.ratio = part.h / control_.memory.last;
      return combine(now_, before_, continuation(method_, sizes_before_, settling_.ratio, part.h));
    }
    const std::span<double> k0 = fresh_.q.first(q.size()), f0 = fresh_.v.first(v.size());
    dynamics_->derivative({part.t, Side::After}, q, v, k0, f0);
    spread(method_.nodes, now_.q, k0);
    spread(method_.nodes, now_.v, f0);
  }

  [[nodiscard]] SeriesSizes sizes_of(const Slopes& series) const {
    return {method_.nodes, greatest_by_stage(method_.nodes, series.q, q_weight_),
            greatest_by_stage(method_.nodes, series.v, v_weight_)};
  }

  void write_series() {
    combine(series_, now_, method_.legendre);
    sizes_ = sizes_of(series_);
  }

  void combine(const Slopes& to, const Slopes& from, const NodeMatrix& a) const {
    combine_stages(method_.nodes, to.q, from.q, a);
    combine_stages(method_.nodes, to.v, from.v, a);
  }

  /// One iteration, from now_ to now_; says by how much it changed the slopes, as motion per unit time.
  double sweep(double h, std::span<const double> q, std::span<const double> v) {
    const int s = method_.nodes;
    add_stages(s, V_, v, h, now_.v, method_.a);
    if (!plain_) {
      add_stages(s, Q_, q, h, now_.q, method_.a);
      dynamics_->rates({at(), Q_, V_, now_.q, {}});
    }
    add_stages(s, Q_, q, h, plain_ ? V_ : now_.q, method_.a);
    dynamics_->derivatives({at(), Q_, V_, fresh_.q, fresh_.v});
    double change = h * greatest_difference(s, fresh_.v, now_.v, v_weight_);
    if (!plain_) change = std::max(greatest_difference(s, fresh_.q, now_.q, q_weight_), change);
    std::swap(now_, fresh_);
    return change;
  }

  /// Of a step whose iteration has settled: whether the polynomial is good enough, and the next step.
  Outcome judge(double h, std::span<const double> q, std::span<const double> v) {
    write_series();
    if (!is_controlled()) return {true, 1};
    const double cheapest = cheapest_ratio(sizes_, settling_, h, enough_);
    const Rule rule{.order = 2.0 * settings_.stages,
                    .safety = kSafety,
                    .shrink_most = kShrinkMost,
                    .grow_most = refused_.h == 0 ? cheapest : std::min(cheapest, 1.0),
                    .overshoot = kOvershoot};
    const double plenty = kAim * tolerance() * power(rule.safety / rule.grow_most, 2 * settings_.stages);
    const double error = estimate(h, q, v, plenty);
    refused_.settled = std::isfinite(error);
    return decide(error / kAim, rule);
  }

  /// Error per unit time, or a bound of it that is no more than `plenty`, below which it decides nothing.
  double estimate(double h, std::span<const double> q, std::span<const double> v, double plenty) {
    const int s = method_.nodes;
    std::array<double, 4> sizes{};  // of the last coefficients, the last one first
    for (int back = std::min(s, 4) - 1; back >= 0; --back) {
      sizes[static_cast<std::size_t>(back)] = sizes_.at(static_cast<std::size_t>(s - 1 - back), h);
    }
    const SeriesTail tail = tail_of(sizes, s, 10 * kRounding * slope_size(h));
    if (tail.share == 0) return 0;
    const std::span<double> q_top = fresh_.q.first(q.size()), v_top = fresh_.v.first(v.size());
    take_stage(s, q_top, series_.q, s - 1 - tail.back);
    take_stage(s, v_top, series_.v, s - 1 - tail.back);
    const double bound =
        tail.share * std::max(weighted_sum(q_top, q_weight_), h * weighted_sum(v_top, v_weight_));
    return bound <= plenty ? bound : tail.share * dynamics_->motion_error(q, v, q_top, v_top, h);
  }

  /// How large the slopes are, as motion per unit time.
  double slope_size(double h) const {
    return std::max(greatest(method_.nodes, now_.q, q_weight_),
                    h * greatest(method_.nodes, now_.v, v_weight_));
  }

  void accept(const Part& part, std::span<double> q, std::span<double> v) override {
    const int s = method_.nodes;
    add_stages(s, V_, v, part.h, now_.v, method_.a);
    dynamics_->rates({at(), Q_, V_, now_.q, {}});
    if (record_ != nullptr) record(part, q, v);
    add_compensated(s, q, kept_.q, part.h, now_.q, method_.b);
    add_compensated(s, v, kept_.v, part.h, now_.v, method_.b);
    std::copy(series_.q.begin(), series_.q.end(), before_.q.begin());
    std::copy(series_.v.begin(), series_.v.end(), before_.v.begin());
    sizes_before_ = sizes_;
    control_.memory.last = part.h;
    continues_ = true;
    refused_ = {};
    dynamics_->settle({part.end, Side::Before}, q, v);
  }

  void record(const Part& part, std::span<const double> q, std::span<const double> v) {
    const auto nodes = static_cast<std::size_t>(method_.nodes);
    const MotionRecord::Room room = record_->add(part.t, part.h, nodes, q, v);
    for (std::size_t k = 0; k < nodes; ++k) {
      const std::span<double> c = room.at(k + 1);
      coefficients(method_.nodes, c.first(q.size()), now_.q, method_.powers[k]);
      coefficients(method_.nodes, c.subspan(q.size()), now_.v, method_.powers[k]);
      for (double& x : c) x *= part.h;
    }
  }

  [[nodiscard]] std::span<const Instant> at() const {
    return {at_.data(), static_cast<std::size_t>(method_.nodes)};
  }

  GaussSettings settings_{};
  Collocation method_{};
  struct Refused {
    double h{0};          ///< of the part tried last from here; 0 = none was
    bool settled{false};  ///< its slopes are right, though it is too long
  };
  Refused refused_{};
  double enough_{0};  ///< change of slopes at which the iteration stops
  Dynamics* dynamics_{nullptr};
  bool continues_{false};
  bool plain_{false};  ///< q' is v
  WorkSpace work_{};
  std::array<Instant, kMostNodes> at_{};
  std::span<double> Q_{}, V_{}, q_weight_{}, v_weight_{};
  SeriesSizes sizes_{}, sizes_before_{};
  Settling settling_{};
  Slopes now_{}, fresh_{};
  Slopes series_{},
      before_{};  ///< as Legendre coefficients in the place of stages: of this part, the last one
  Slopes kept_{};
};

}  // namespace

std::unique_ptr<Integrator> make_gauss(const GaussSettings& settings) {
  PANTIN_EXPECTS(settings.stages >= 1 && settings.stages <= kMostNodes,
                 "stages is " + std::to_string(settings.stages) + "; give 1 to 8");
  PANTIN_EXPECTS(settings.tolerance > 0,
                 "tolerance is " + text_of(settings.tolerance) + "; give an error per second above zero");
  return std::make_unique<Gauss>(settings);
}

std::unique_ptr<Integrator> make_gauss8() { return make_gauss({.stages = 4, .tolerance = 1e-6}); }
std::unique_ptr<Integrator> make_gauss16() { return make_gauss({.stages = 8, .tolerance = 1e-10}); }

}  // namespace pantin

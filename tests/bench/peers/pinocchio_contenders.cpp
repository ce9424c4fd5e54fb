#include "pinocchio_contenders.hpp"

#include <algorithm>
#include <boost/numeric/odeint/integrate/integrate_adaptive.hpp>
#include <boost/numeric/odeint/stepper/generation.hpp>
#include <cmath>

#include "pinocchio_model.hpp"

namespace pantin::bench {
namespace {

namespace odeint = boost::numeric::odeint;

/// Angles and rates of a chain in Pinocchio, and what all methods do with them.
class PinocchioChain : public Contender {
 public:
  explicit PinocchioChain(const Chain& chain)
      : chain_{chain}, model_{chain}, links_{static_cast<std::size_t>(chain.links)} {}

  long evaluations() const override { return evaluations_; }
  std::vector<Point> points() override { return model_.centres(state_.data()); }

 protected:
  void place() {
    evaluations_ = 0;
    state_.assign(2 * links_, 0.0);
    for (int i = 0; i < chain_.links; ++i) state_[static_cast<std::size_t>(i)] = start_angle(chain_, i);
    state_.back() = chain_.spin;
  }
  const double* acceleration(const double* q, const double* v) {
    ++evaluations_;
    return model_.acceleration(q, v);
  }

  Chain chain_{};
  PinocchioModel model_;
  std::size_t links_{0};
  std::vector<double> state_{};  ///< all angles, then all rates
  long evaluations_{0};
};

class Rk4 final : public PinocchioChain {
 public:
  using PinocchioChain::PinocchioChain;
  std::string name() const override { return "Pinocchio RK4"; }
  int order() const override { return 4; }
  std::string setting(int k) const override { return std::to_string(steps_per_second(k)) + " steps/s"; }
  void prepare(int k) override {
    place();
    const auto rate = static_cast<double>(steps_per_second(k));
    h_ = 1 / rate;
    steps_ = std::lround(rate * chain_.duration);
    stage_.resize(state_.size());
    slope_.resize(state_.size());
  }
  bool run() override {
    for (long i = 0; i < steps_; ++i) step();
    return true;
  }

 private:
  void step() {
    constexpr double kNext[] = {0.5, 0.5, 1, 0}, kWeight[] = {1.0 / 6, 1.0 / 3, 1.0 / 3, 1.0 / 6};
    const std::size_t n = links_;
    double *y = state_.data(), *at = stage_.data(), *sum = slope_.data();
    std::copy_n(y, 2 * n, at);
    std::fill_n(sum, 2 * n, 0.0);
    for (int s = 0; s < 4; ++s) {
      const double* a = acceleration(at, at + n);
      const double weight = kWeight[s], reach = kNext[s] * h_;
      for (std::size_t i = 0; i < n; ++i) {
        const double v = at[n + i];
        sum[i] += weight * v;
        sum[n + i] += weight * a[i];
        at[i] = y[i] + reach * v;
        at[n + i] = y[n + i] + reach * a[i];
      }
    }
    for (std::size_t i = 0; i < 2 * n; ++i) y[i] += h_ * sum[i];
  }

  double h_{0};
  long steps_{0};
  std::vector<double> stage_{}, slope_{};
};

std::string decade(int k) {
  return k == 0 ? "1" : "1e-" + std::string{k < 10 ? "0" : ""} + std::to_string(k);
}

/// The first step that the adaptive methods try; they correct it at once.
constexpr double kFirstStep = 1e-3;

template <class Method>
class Adaptive final : public PinocchioChain {
 public:
  Adaptive(const Chain& chain, std::string name, int order)
      : PinocchioChain{chain}, name_{std::move(name)}, order_{order} {}
  std::string name() const override { return name_; }
  int order() const override { return order_; }
  std::string setting(int k) const override { return decade(k); }
  void prepare(int k) override {
    place();
    tolerance_ = std::pow(10.0, -k);
  }
  bool run() override {
    const auto derivative = [this](const std::vector<double>& y, std::vector<double>& slope, double) {
      const double* a = acceleration(y.data(), y.data() + links_);
      std::copy_n(y.data() + links_, links_, slope.data());
      std::copy_n(a, links_, slope.data() + links_);
    };
    odeint::integrate_adaptive(odeint::make_controlled<Method>(tolerance_, tolerance_), derivative, state_,
                               0.0, chain_.duration, kFirstStep);
    return true;
  }

 private:
  std::string name_{};
  int order_{0};
  double tolerance_{0};
};

/// The free-flyer with its quaternion as four numbers, made a unit at each evaluation.
class FreeTop final : public Contender {
 public:
  explicit FreeTop(const Top& top) : top_{top}, model_{top} {}
  std::string name() const override { return "Pinocchio Fehlberg 7(8)"; }
  int order() const override { return 8; }
  std::string setting(int k) const override { return decade(k); }
  long evaluations() const override { return evaluations_; }
  void prepare(int k) override {
    tolerance_ = std::pow(10.0, -k);
    evaluations_ = 0;
    state_ = {};
    state_[6] = 1;
    std::copy_n(top_.rate, 3, &state_[10]);
  }
  bool run() override {
    const auto derivative = [this](const Numbers& y, Numbers& slope, double) { rate(y, slope); };
    odeint::integrate_adaptive(
        odeint::make_controlled<odeint::runge_kutta_fehlberg78<Numbers>>(tolerance_, tolerance_), derivative,
        state_, 0.0, top_.duration, kFirstStep);
    return true;
  }
  std::vector<Point> points() override { return axes_of(state_[6], state_[3], state_[4], state_[5]); }

 private:
  /// Position, quaternion (x, y, z, w), velocity and rate in axes of the body.
  using Numbers = std::array<double, 13>;

  static void cross(const double* a, const double* b, double* out) {
    out[0] = a[1] * b[2] - a[2] * b[1];
    out[1] = a[2] * b[0] - a[0] * b[2];
    out[2] = a[0] * b[1] - a[1] * b[0];
  }

  void rate(const Numbers& y, Numbers& slope) {
    ++evaluations_;
    double q[7];
    std::copy_n(y.data(), 7, q);
    const double size = std::sqrt(q[3] * q[3] + q[4] * q[4] + q[5] * q[5] + q[6] * q[6]);
    for (int k = 3; k < 7; ++k) q[k] /= size;
    const double *v = &y[7], *w = &y[10];
    std::copy_n(model_.acceleration(q, v), 6, &slope[7]);
    // p' = R v, with t = 2 q x v: v + w t + q x t.
    double t[3], turned[3];
    cross(q + 3, v, t);
    for (double& number : t) number *= 2;
    cross(q + 3, t, turned);
    for (std::size_t k = 0; k < 3; ++k) slope[k] = v[k] + q[6] * t[k] + turned[k];
    const double x = y[3], z = y[5], s = y[6];
    slope[3] = 0.5 * (s * w[0] + y[4] * w[2] - z * w[1]);
    slope[4] = 0.5 * (s * w[1] + z * w[0] - x * w[2]);
    slope[5] = 0.5 * (s * w[2] + x * w[1] - y[4] * w[0]);
    slope[6] = -0.5 * (x * w[0] + y[4] * w[1] + z * w[2]);
  }

  Top top_{};
  PinocchioModel model_;
  Numbers state_{};
  double tolerance_{0};
  long evaluations_{0};
};

}  // namespace

std::unique_ptr<Contender> make_pinocchio_rk4(const Chain& chain) { return std::make_unique<Rk4>(chain); }
std::unique_ptr<Contender> make_pinocchio_dormand_prince(const Chain& chain) {
  return std::make_unique<Adaptive<odeint::runge_kutta_dopri5<std::vector<double>>>>(
      chain, "Pinocchio Dormand-Prince 5", 5);
}
std::unique_ptr<Contender> make_pinocchio_fehlberg(const Chain& chain) {
  return std::make_unique<Adaptive<odeint::runge_kutta_fehlberg78<std::vector<double>>>>(
      chain, "Pinocchio Fehlberg 7(8)", 8);
}
std::unique_ptr<Contender> make_pinocchio_fehlberg(const Top& top) { return std::make_unique<FreeTop>(top); }

}  // namespace pantin::bench

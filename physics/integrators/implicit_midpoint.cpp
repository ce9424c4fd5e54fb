// z = y + h/2 f(t + h/2, z);  y1 = 2 z - y. E. Hairer, C. Lubich, G. Wanner, Geometric Numerical Integration,
// 2nd ed., II.1.1 and IV.2 (quadratic invariants). The equation is iterated as it stands while each pass
// takes most of the error away; where it does not, h times a stiffness is not small, and Newton's method
// takes over.
#include <pantin/physics/integrators/implicit_midpoint.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

#include <pantin/physics/integrators/newton_krylov.hpp>
#include <pantin/physics/integrators/step_arrays.hpp>

namespace pantin {
namespace {

constexpr double kSolved = 2e-16;    // change of the last pass, of the numbers' size
constexpr double kContracts = 0.3;   // a pass that leaves more than this of the change before is too slow
constexpr double kLeastSize = 1e-9;  // of coordinates [m], [rad]: below it all is at zero
constexpr int kMostPasses = 60;

class ImplicitMidpoint final : public Integrator, SlopeFunction {
 public:
  std::string_view name() const override { return "implicit-midpoint"; }
  int order() const override { return 2; }
  int evaluations(const Dynamics&) const override { return 2; }

  void step(Dynamics& dynamics, double t, double h, std::span<double> q, std::span<double> v) override {
    expect_step(dynamics, t, h, q, v);
    const std::size_t n = q.size() + v.size();
    if (n == 0) return;
    work_.reserve(4 * n);
    y_ = work_.take(n), z_ = work_.take(n), slope_ = work_.take(n), scale_ = work_.take(n);
    dynamics_ = &dynamics;
    coordinates_ = q.size();
    middle_ = {t + 0.5 * h, Side::Before};
    std::copy(q.begin(), q.end(), y_.begin());
    std::copy(v.begin(), v.end(), y_.begin() + static_cast<std::ptrdiff_t>(q.size()));
    if (!solve(0.5 * h)) std::fill(z_.begin(), z_.end(), std::numeric_limits<double>::quiet_NaN());
    for (std::size_t i = 0; i < q.size(); ++i) q[i] = z_[i] == y_[i] ? q[i] : 2 * z_[i] - y_[i];
    for (std::size_t i = 0; i < v.size(); ++i) {
      const std::size_t k = coordinates_ + i;
      v[i] = z_[k] == y_[k] ? v[i] : 2 * z_[k] - y_[k];
    }
    dynamics.settle({t + h, Side::Before}, q, v);
  }

 private:
  void evaluate(std::span<const double> z, std::span<double> slope) override {
    dynamics_->derivative(middle_, z.first(coordinates_), z.subspan(coordinates_), slope.first(coordinates_),
                          slope.subspan(coordinates_));
  }

  void list_groups(NumberGroups& groups) override { dynamics_->list_groups(groups); }

  void jacobian(std::span<const double> z, std::span<const double> slope, std::span<const double> change,
                Jacobian& J) override {
    dynamics_->jacobian({middle_, z.first(coordinates_), z.subspan(coordinates_), slope, change}, J);
  }

  bool solve(double s) {
    std::copy(y_.begin(), y_.end(), z_.begin());
    evaluate(z_, slope_);
    std::fill(scale_.begin(), scale_.end(), 0.0);
    measure(s);
    double before = std::numeric_limits<double>::infinity();
    for (int pass = 0; pass < kMostPasses; ++pass) {
      double change = 0;
      for (std::size_t i = 0; i < z_.size(); ++i) {
        const double next = y_[i] + s * slope_[i], by = std::abs(next - z_[i]) / scale_[i];
        if (!(by <= change)) change = by;
        z_[i] = next;
      }
      if (change <= kSolved || (change <= 100 * kSolved && !(change < before))) return true;
      if (!(change <= kContracts * before)) break;
      before = change;
      evaluate(z_, slope_);
      if (pass == 0) measure(s);  // what rates were not at the start they are now
    }
    std::copy(y_.begin(), y_.end(), z_.begin());
    return newton_.solve(*this, s, y_, scale_, z_);
  }

  /// One size for all coordinates and one for all velocities: round-off of the greatest is no error of the
  /// small ones. Never less than what was measured before.
  void measure(double s) {
    const auto fill = [&](std::size_t from, std::size_t to, double least) {
      double size = std::max(scale_[from], least);
      for (std::size_t i = from; i < to; ++i) {
        const double reach = std::abs(y_[i]) + std::abs(s * slope_[i]);
        if (reach > size && std::isfinite(reach)) size = reach;
      }
      if (!(size > 0)) size = 1;
      std::fill(scale_.begin() + static_cast<std::ptrdiff_t>(from),
                scale_.begin() + static_cast<std::ptrdiff_t>(to), size);
    };
    if (coordinates_ > 0) fill(0, coordinates_, kLeastSize);
    if (coordinates_ < y_.size()) fill(coordinates_, y_.size(), 0);
  }

  Dynamics* dynamics_{nullptr};
  Instant middle_{};
  std::size_t coordinates_{0};
  WorkSpace work_{};
  std::span<double> y_{}, z_{}, slope_{}, scale_{};
  NewtonKrylov newton_{};
};

}  // namespace

std::unique_ptr<Integrator> make_implicit_midpoint() { return std::make_unique<ImplicitMidpoint>(); }

}  // namespace pantin

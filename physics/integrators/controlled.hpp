#pragma once
// The loop of an integrator that cuts the step asked for into parts of its own: try one, keep or refuse it,
// propose the next. A method says how a part is computed and how far it was off.
#include <pantin/physics/integrators/integrator.hpp>

namespace pantin {

class ControlledIntegrator : public Integrator {
 public:
  void step(Dynamics& dynamics, double t, double h, std::span<double> q, std::span<double> v) final;
  StepControl* control() final { return &control_; }
  double tolerance() const final { return tolerance_; }

 protected:
  /// Tolerance: local error per unit time [m/s, rad/s], > 0; infinity: the step is given, and cut only where
  /// a part is refused for another reason.
  explicit ControlledIntegrator(double tolerance) : tolerance_{tolerance} {}

  struct Part {
    double t{0}, h{0}, end{0};  ///< [s]
    bool last{false};           ///< of the step
  };
  struct Outcome {
    bool accepted{false};
    double factor{1};  ///< of the part tried: what to try next
  };
  /// How an error per unit time, of this order in the step, decides.
  struct Rule {
    double order{1};
    double safety{0.9}, shrink_most{0.2}, grow_most{2};
    double overshoot{1};  ///< accepted up to this multiple of the tolerance
  };
  [[nodiscard]] Outcome decide(double error, const Rule& rule) const;
  [[nodiscard]] bool is_controlled() const;

  StepControl control_{};

 private:
  /// Before the first part of a step of h from (q, v) at t.
  virtual void begin(Dynamics& dynamics, double t, double h, std::span<const double> q,
                     std::span<const double> v) = 0;
  /// The part to try first, where the tolerance is finite [s], > 0.
  [[nodiscard]] virtual double first_part(double t, double h, std::span<const double> q,
                                          std::span<const double> v) = 0;
  /// Tries a part from (q, v).
  virtual Outcome attempt(const Part& part, std::span<const double> q, std::span<const double> v) = 0;
  /// Moves q and v to the end of the part tried last, which was accepted, settles them, at the latest where
  /// it is the last, and records it where there is a record.
  virtual void accept(const Part& part, std::span<double> q, std::span<double> v) = 0;
  /// After the last part, with the part to be tried next in control_.memory.next.
  virtual void finish(std::span<const double> q, std::span<const double> v) { (void)q, (void)v; }

  double tolerance_{0};
};

}  // namespace pantin

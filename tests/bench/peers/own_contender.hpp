#pragma once
// Pantin through its public interface: PhysicsManager::step, with all that a step does besides integrating.
// Settings: tolerances from 1000 on, a decade apart.
#include <cmath>
#include <functional>
#include <map>
#include <string>

#include "bench/cpu_time.hpp"
#include "bench/own_chain.hpp"
#include "contender.hpp"

namespace pantin::bench {

template <class Problem>
class OwnContender final : public Contender {
 public:
  OwnContender(const Problem& problem, std::string solver) : problem_{problem}, solver_{std::move(solver)} {}

  std::string name() const override { return solver_; }
  int order() const override { return make_integrator(solver_)->order(); }
  std::string setting(int k) const override {
    char text[16];
    std::snprintf(text, sizeof text, "%.0e", std::pow(10.0, 3 - k));
    return text;
  }
  void prepare(int k) override { start(std::pow(10.0, 3 - k)); }
  /// At a tolerance that need not be one of the settings.
  void start(double tolerance) {
    Simulation& simulation = simulations_[tolerance];
    if (!simulation.start) {
      simulation.physics = build(problem_);
      simulation.physics.set_integrator(make_integrator(solver_, tolerance));
      simulation.start = simulation.physics.snapshot();
    }
    simulation.physics.restore(*simulation.start);
    now_ = &simulation.physics;
  }
  bool run() override {
    const StepReport report = now_->step(problem_.duration);
    evaluations_ = report.evaluations;
    return report.ok();
  }
  long evaluations() const override { return evaluations_; }
  std::vector<Point> points() override { return points_of(problem_); }

 private:
  struct Simulation {
    PhysicsManager physics{};
    std::optional<State> start{};
  };

  std::vector<Point> points_of(const Chain&) const {
    std::vector<Point> points;
    for (const BodyId id : now_->bodies()) {
      const Vector3 p = now_->body(id).p_WBcm();
      points.push_back({p.x(), p.y(), p.z()});
    }
    return points;
  }
  std::vector<Point> points_of(const Top&) const {
    const Quaternion q = now_->body(now_->bodies().front()).q_WB();
    return axes_of(q.w(), q.x(), q.y(), q.z());
  }

  Problem problem_{};
  std::string solver_{};
  std::map<double, Simulation> simulations_{};
  PhysicsManager* now_{nullptr};
  long evaluations_{0};
};

}  // namespace pantin::bench

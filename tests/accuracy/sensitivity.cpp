#include "sensitivity.hpp"

#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include <pantin/physics/physics_manager.hpp>

namespace pantin::test {
namespace {

constexpr double kTolerance = 1e-12, kChange = 1e-7;
constexpr int kDraws = 2;
constexpr double kFrom[] = {0, 0.35, 0.7};  // parts of the samples

enum class What { Positions, Velocities };

/// Of one body: its centre of gravity and attitude, or a particle's place.
struct Place {
  Vector3 p{Vector3::Zero()};
  Quaternion q{Quaternion::Identity()};
  Vector3 v{Vector3::Zero()}, w{Vector3::Zero()};
};
using Places = std::vector<Place>;

double angle(const Quaternion& a, const Quaternion& b) {
  const Quaternion d = a.conjugate() * b;
  return 2 * std::atan2(d.vec().norm(), std::abs(d.w()));
}

double displacement(const Places& a, const Places& b) {
  double most = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    most = std::max({most, (a[i].p - b[i].p).norm(), angle(a[i].q, b[i].q)});
  return most;
}

double change_of_speed(const Places& a, const Places& b) {
  double most = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    most = std::max({most, (a[i].v - b[i].v).norm(), (a[i].w - b[i].w).norm()});
  return most;
}

class Sensitivity {
 public:
  explicit Sensitivity(const ReferenceProblem& problem) {
    Loaded<ReferenceInstance> built = instantiate(problem, physics_);
    EXPECT_TRUE(built.value.has_value()) << problem.name;
    if (built.value) instance_ = std::move(*built.value);
    physics_.set_integrator(make_integrator("gauss16", kTolerance));
    for (const auto& sample : problem.samples) times_.push_back(sample.t);
    duration_ = times_.empty() ? problem.duration : times_.back();
  }

  double measure() {
    std::vector<State> states;
    std::vector<Places> places;
    for (const double t : times_) {
      go_to(t);
      states.push_back(physics_.snapshot());
      places.push_back(places_now());
    }
    double growth = 1;
    for (const double part : kFrom) {
      const auto first = static_cast<std::size_t>(part * static_cast<double>(times_.size() - 1));
      for (int draw = 0; draw < 2 * kDraws; ++draw) {
        physics_.restore(states[first]);
        const What what = draw < kDraws ? What::Positions : What::Velocities;
        disturb(what);
        const Places begin = places_now();
        const double size = what == What::Positions ? displacement(begin, places[first])
                                                    : change_of_speed(begin, places[first]);
        if (size == 0) continue;  // nothing there that can be changed
        for (std::size_t i = first; i < times_.size(); ++i) {
          go_to(times_[i]);
          growth = std::max(growth, displacement(places_now(), places[i]) / size);
        }
      }
    }
    return growth * std::max(duration_, 1.0);
  }

 private:
  void go_to(double t) {
    if (t <= physics_.time()) return;
    EXPECT_TRUE(physics_.step(t - physics_.time()).ok());
  }

  Places places_now() const {
    Places now;
    for (const auto& [name, id] : instance_.bodies) {
      const RigidBody body = physics_.body(id);
      now.push_back({body.p_WBcm(), body.q_WB(), body.v_WBcm(), body.w_WB()});
    }
    for (const auto& [name, id] : instance_.particles) {
      const ParticleSystem system = physics_.particles().system(id.system);
      const std::size_t i = system.position_of(id);
      now.push_back({.p = system.p_WP(i), .v = system.v_WP(i)});
    }
    return now;
  }

  double small() { return kChange * std::uniform_real_distribution<double>{-1, 1}(random_); }
  Vector3 small_vector() { return {small(), small(), small()}; }

  void disturb(What what) {
    for (const auto& [name, id] : instance_.joints) disturb_joint(what, id);
    for (const auto& [name, id] : instance_.bodies) {
      const RigidBody body = physics_.body(id);
      if (body.kind() != BodyKind::Simulated || !physics_.joints_of(id).empty()) continue;
      if (what == What::Velocities) {
        physics_.set_velocity(id, body.v_WBcm() + small_vector(), body.w_WB() + small_vector());
        continue;
      }
      // A teleport keeps velocities, about the centre of gravity.
      const Pose X_WB = body.X_WB();
      const Vector3 turn = small_vector();
      const Quaternion q{Eigen::AngleAxisd{turn.norm(), turn.normalized()}};
      physics_.set_pose(id, {X_WB.p + small_vector(), (q * X_WB.q).normalized()});
    }
    for (const auto& [name, id] : instance_.particles) {
      const ParticleSystem system = physics_.particles().system(id.system);
      const std::size_t i = system.position_of(id);
      if (what == What::Positions) physics_.particles().set_position(id, system.p_WP(i) + small_vector());
      if (what == What::Velocities) physics_.particles().set_velocity(id, system.v_WP(i) + small_vector());
    }
  }

  void disturb_joint(What what, JointId id) {
    const bool values = what == What::Positions;
    JointNumbers numbers = values ? physics_.joint_value(id) : physics_.joint_rate(id);
    if (values && numbers.size() == 4) {  // a ball: its attitude
      const Vector3 turn = small_vector();
      const Quaternion by{Eigen::AngleAxisd{turn.norm(), turn.normalized()}};
      const Quaternion q = Quaternion{numbers[0], numbers[1], numbers[2], numbers[3]} * by;
      const double turned[] = {q.w(), q.x(), q.y(), q.z()};
      for (int k = 0; k < 4; ++k) numbers[k] = turned[k];
    } else {
      for (int k = 0; k < numbers.size(); ++k) numbers[k] += small();
    }
    if (values) physics_.set_joint_value(id, numbers);
    if (!values) physics_.set_joint_rate(id, numbers);
  }

  PhysicsManager physics_{};
  ReferenceInstance instance_{};
  std::vector<double> times_{};
  double duration_{0};
  std::mt19937 random_{7};
};

}  // namespace

double sensitivity(const ReferenceProblem& problem) { return Sensitivity{problem}.measure(); }

}  // namespace pantin::test

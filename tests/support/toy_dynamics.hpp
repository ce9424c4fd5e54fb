#pragma once
// Small dynamical systems for integrators, none of them through bodies or joints of the library: oscillators
// with closed forms, a rigid body in axes of the world, and a decorator that writes down who asks for what
// and when.
#include <cmath>
#include <functional>
#include <vector>

#include <pantin/physics/integrators/integrator.hpp>
#include <pantin/physics/pose.hpp>

namespace pantin::test {

/// Coordinates and velocities of any Dynamics.
struct State {
  std::vector<double> q{}, v{};
};

/// x'' = -omega^2 x - 2 d x' + f cos(W t): one coordinate, one velocity.
class Oscillator final : public Dynamics {
 public:
  struct Settings {
    double omega{1};            ///< [rad/s]
    double decay{0};            ///< d [1/s], < omega
    double force{0};            ///< f [m/s^2]
    double force_frequency{0};  ///< W [rad/s], != omega
  };
  explicit Oscillator(const Settings& settings) : s_{settings} {}

  std::size_t coordinates() const override { return 1; }
  std::size_t velocities() const override { return 1; }
  void rate(Instant, std::span<const double>, std::span<const double> v, std::span<double> q_dot) override {
    q_dot[0] = v[0];
  }
  void acceleration(Instant at, std::span<const double> q, std::span<const double> v,
                    std::span<double> v_dot) override {
    v_dot[0] =
        -s_.omega * s_.omega * q[0] - 2 * s_.decay * v[0] + s_.force * std::cos(s_.force_frequency * at.t);
  }
  bool acceleration_depends_on_velocity() const override { return s_.decay != 0; }

  /// Closed form from any state at t = 0: a particular solution A cos Wt + B sin Wt, plus e^(-dt) (C cos + D
  /// sin) of the damped frequency.
  [[nodiscard]] State exact(const State& start, double t) const {
    const double w2 = s_.omega * s_.omega, W = s_.force_frequency, d = s_.decay;
    const double det = (w2 - W * W) * (w2 - W * W) + 4 * d * d * W * W;
    const double A = s_.force * (w2 - W * W) / det, B = s_.force * 2 * d * W / det;
    const double wd = std::sqrt(w2 - d * d);
    const double C = start.q[0] - A;
    const double D = (start.v[0] - B * W + d * C) / wd;
    const double e = std::exp(-d * t), c = std::cos(wd * t), s = std::sin(wd * t);
    return {{e * (C * c + D * s) + A * std::cos(W * t) + B * std::sin(W * t)},
            {e * ((D * wd - d * C) * c - (C * wd + d * D) * s) - A * W * std::sin(W * t) +
             B * W * std::cos(W * t)}};
  }

 private:
  Settings s_;
};

/// A rigid body about its centre of gravity: q = (p, w, x, y, z), v = (P, L), all in W. L' is the torque and
/// w_W = R I^-1 R^T L, so that momenta are what only loads change.
class ToyBody final : public Dynamics {
 public:
  struct Motion {
    double t{0};
    Vector3 p, v, w;
    Matrix3 R;
  };
  using Load = std::function<Wrench(const Motion&)>;
  struct Settings {
    double mass{1};            ///< [kg]
    Vector3 moments{1, 1, 1};  ///< principal, along body axes [kg m^2]
    Load load{};               ///< none = free
    bool load_looks_at_velocity{false};
  };
  explicit ToyBody(Settings settings) : s_{std::move(settings)} {}

  std::size_t coordinates() const override { return 7; }
  std::size_t velocities() const override { return 6; }
  void rate(Instant at, std::span<const double> q, std::span<const double> v,
            std::span<double> q_dot) override {
    const Motion m = motion(at, q, v);
    const Quaternion half = Quaternion{0, 0.5 * m.w.x(), 0.5 * m.w.y(), 0.5 * m.w.z()} * attitude(q);
    for (std::size_t k = 0; k < 3; ++k) q_dot[k] = m.v[static_cast<Eigen::Index>(k)];
    q_dot[3] = half.w();
    q_dot[4] = half.x();
    q_dot[5] = half.y();
    q_dot[6] = half.z();
  }
  void acceleration(Instant at, std::span<const double> q, std::span<const double> v,
                    std::span<double> v_dot) override {
    const Wrench load = s_.load ? s_.load(motion(at, q, v)) : Wrench{};
    Eigen::Map<Vector3>{v_dot.data()} = load.force;
    Eigen::Map<Vector3>{v_dot.data() + 3} = load.torque;
  }
  void settle(Instant, std::span<double> q, std::span<double>) override {
    Eigen::Map<Eigen::Vector4d>{q.data() + 3}.normalize();
  }
  bool acceleration_depends_on_velocity() const override { return s_.load_looks_at_velocity; }

  [[nodiscard]] static Quaternion attitude(std::span<const double> q) { return {q[3], q[4], q[5], q[6]}; }
  [[nodiscard]] static State state(const Pose& X_WB, const Vector3& P, const Vector3& L) {
    const Quaternion& a = X_WB.q;
    return {{X_WB.p.x(), X_WB.p.y(), X_WB.p.z(), a.w(), a.x(), a.y(), a.z()},
            {P.x(), P.y(), P.z(), L.x(), L.y(), L.z()}};
  }
  [[nodiscard]] double kinetic_energy(const State& state) const {
    const Motion m = motion({}, state.q, state.v);
    return 0.5 * (m.v.dot(Eigen::Map<const Vector3>{state.v.data()}) +
                  m.w.dot(Eigen::Map<const Vector3>{state.v.data() + 3}));
  }
  /// Closed form of the free body with moments (A, A, C) about its centre of gravity: in W it turns about L
  /// at L/A, in its own axes besides about the third one at (1/C - 1/A) L3, where L3 is constant (Landau,
  /// Lifshitz, Mechanics, 33).
  [[nodiscard]] State exact_symmetric(const State& start, double t) const {
    const Vector3 P{start.v[0], start.v[1], start.v[2]}, L{start.v[3], start.v[4], start.v[5]};
    const Quaternion q0 = attitude(start.q);
    const double spin = (1 / s_.moments.z() - 1 / s_.moments.x()) * (q0.conjugate() * L).z();
    const auto turn = [](double angle, const Vector3& axis) {  // continuous in the angle, unlike a matrix
      const Vector3 xyz = std::sin(angle / 2) * axis;
      return Quaternion{std::cos(angle / 2), xyz.x(), xyz.y(), xyz.z()};
    };
    const Quaternion q =
        turn(L.norm() / s_.moments.x() * t, L.normalized()) * q0 * turn(spin * t, Vector3::UnitZ());
    return ToyBody::state({Vector3{start.q[0], start.q[1], start.q[2]} + t / s_.mass * P, q}, P, L);
  }

 private:
  [[nodiscard]] Motion motion(Instant at, std::span<const double> q, std::span<const double> v) const {
    const Matrix3 R = attitude(q).normalized().toRotationMatrix();
    const Vector3 L{v[3], v[4], v[5]};
    const Vector3 w = R * (R.transpose() * L).cwiseQuotient(s_.moments);
    return {at.t, {q[0], q[1], q[2]}, Vector3{v[0], v[1], v[2]} / s_.mass, w, R};
  }

  Settings s_;
};

/// Passes everything on and writes it down.
class Recorder final : public Dynamics {
 public:
  enum class Kind { Rate, Acceleration, Derivative, Settle };
  struct Call {
    Kind kind{};
    double t{0};
    Side side{Side::After};
    bool operator==(const Call&) const = default;
  };
  explicit Recorder(Dynamics& inner) : inner_{inner} {}

  std::size_t coordinates() const override { return inner_.coordinates(); }
  std::size_t velocities() const override { return inner_.velocities(); }
  void rate(Instant at, std::span<const double> q, std::span<const double> v,
            std::span<double> q_dot) override {
    calls.push_back({Kind::Rate, at.t, at.side});
    inner_.rate(at, q, v, q_dot);
  }
  void acceleration(Instant at, std::span<const double> q, std::span<const double> v,
                    std::span<double> v_dot) override {
    calls.push_back({Kind::Acceleration, at.t, at.side});
    inner_.acceleration(at, q, v, v_dot);
  }
  void derivative(Instant at, std::span<const double> q, std::span<const double> v, std::span<double> q_dot,
                  std::span<double> v_dot) override {
    calls.push_back({Kind::Derivative, at.t, at.side});
    inner_.derivative(at, q, v, q_dot, v_dot);
  }
  void settle(Instant at, std::span<double> q, std::span<double> v) override {
    calls.push_back({Kind::Settle});
    inner_.settle(at, q, v);
  }
  bool acceleration_depends_on_velocity() const override { return inner_.acceleration_depends_on_velocity(); }

  mutable std::vector<Call> calls{};

 private:
  Dynamics& inner_;
};

}  // namespace pantin::test

#pragma once
// Private to scenegraph. The rigid motion D that is extracted of a play's root channel (see RootMotion).
//   E(s) = (p_E, q_E): p_E the chosen components of the source's translation at clip time s, q_E the twist of
//   its
//          rotation about the axis: q = (w, u) -> (w, (u.a) a) / length
//   D(s) = E(s) E(0)^-1 within a lap;  in lap n  D = L^n D(s),  L = D(duration)
#include <optional>

#include <pantin/scenegraph/play_clock.hpp>
#include <pantin/scenegraph/quaternion_jet.hpp>

namespace pantin {

/// A rigid motion whose numbers vary in time.
template <class S>
struct Rigid {
  Numbers3<S> p{};
  Numbers4<S> q{S{1}, S{0}, S{0}, S{0}};

  friend Rigid operator*(const Rigid& a, const Rigid& b) {
    const Numbers3<S> turned_b = turned(a.q, b.p);
    return {{a.p[0] + turned_b[0], a.p[1] + turned_b[1], a.p[2] + turned_b[2]}, product(a.q, b.q)};
  }
  [[nodiscard]] Rigid inverse() const {
    const Numbers4<S> back = conjugate(q);
    const Numbers3<S> r = turned(back, p);
    return {{-r[0], -r[1], -r[2]}, back};
  }
};

class RootExtraction {
 public:
  /// `rotation` may be null if there is no turn to extract.
  RootExtraction(const RootMotion& settings, const PreparedTrack& translation, const PreparedTrack* rotation,
                 double duration);

  /// D at a reading, through all laps.
  template <class S>
  [[nodiscard]] Rigid<S> motion(const ClockReading& at) const {
    return constant<S>(laps(at.lap)) * within_lap(sampled<S>(at));
  }
  /// Takes D out of the source's pose as the clip has it.
  template <class S>
  void remove(Numbers3<S>& p, Numbers4<S>& q) const {
    const Rigid<S> rest = within_lap(Rigid<S>{p, q}).inverse() * Rigid<S>{p, q};
    p = rest.p;
    if (axis_) q = rest.q;
  }

  Affine K{Affine::Identity()};  ///< the source's parent seen from the carrier
  Affine K_inverse{Affine::Identity()};

  [[nodiscard]] std::array<const PreparedTrack*, 2> tracks() const { return {translation_, rotation_}; }

 private:
  template <class S>
  static Rigid<S> constant(const Rigid<double>& X) {
    Rigid<S> out;
    for (std::size_t i = 0; i < 3; ++i) out.p[i] = X.p[i];
    for (std::size_t i = 0; i < 4; ++i) out.q[i] = X.q[i];
    return out;
  }
  /// E of a pose.
  template <class S>
  [[nodiscard]] Rigid<S> extracted(const Rigid<S>& pose) const {
    Rigid<S> E;
    for (std::size_t i = 0; i < 3; ++i)
      if (along_[i]) E.p[i] = pose.p[i];
    if (!axis_) return E;
    const Vector3& a = *axis_;
    const S along = S{a.x()} * pose.q[1] + S{a.y()} * pose.q[2] + S{a.z()} * pose.q[3];
    // Half a turn about an axis across leaves no twist to speak of.
    if (value_of(pose.q[0] * pose.q[0] + along * along) < 1e-18) return E;
    E.q = unit(Numbers4<S>{pose.q[0], S{a.x()} * along, S{a.y()} * along, S{a.z()} * along});
    return E;
  }
  template <class S>
  [[nodiscard]] Rigid<S> within_lap(const Rigid<S>& pose) const {
    return extracted(pose) * constant<S>(from_start_);
  }
  /// The source's pose as the clip has it.
  template <class S>
  [[nodiscard]] Rigid<S> sampled(const ClockReading& at) const;
  /// L^n.
  [[nodiscard]] Rigid<double> laps(double n) const;

  std::array<bool, 3> along_;
  std::optional<Vector3> axis_;
  const PreparedTrack* translation_;
  const PreparedTrack* rotation_;
  Rigid<double> from_start_{};  ///< E(0)^-1
  Rigid<double> lap_{};         ///< L
};

/// A track's value at a reading, with derivatives with respect to play time.
void sample_channel(const PreparedTrack& track, const ClockReading& at, KeyCursor& cursor,
                    std::array<double, 7>& value);
void sample_channel(const PreparedTrack& track, const ClockReading& at, KeyCursor& cursor,
                    std::array<Jet, 7>& value);

}  // namespace pantin

#pragma once
// Where particles come from: a place on a body or in the world that gives birth at a rate or in bursts. What
// is random is a function of the seed and of how many were born before, so the same settings give the same
// particles, whatever the steps; a snapshot holds the count.
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include <pantin/physics/ids.hpp>
#include <pantin/physics/pose.hpp>
#include <pantin/physics/problem.hpp>

namespace pantin {

enum class EmitterRegion : std::uint8_t {
  Point,
  Sphere,
  Disc,
  Box
};  ///< evenly within; a disc lies in z = 0

struct Burst {
  double time{0};          ///< [s]
  std::uint64_t count{0};  ///< all born at that instant
};

/// A number evenly spread between two.
struct Range {
  double least{0}, most{0};
};

struct EmitterSettings {
  BodyId body{};  ///< null = the world
  Pose X_BE{};    ///< emitter frame E; particles leave along its z axis
  EmitterRegion region{EmitterRegion::Point};
  Vector3 size{0, 0, 0};  ///< [m]: radius in x (sphere, disc), edge lengths (box), each >= 0
  Range speed{1, 1};      ///< [m/s], >= 0
  double spread{0};       ///< half angle of the cone of directions, evenly over it [rad], 0 .. pi
  double inherit{1};      ///< share of the body's velocity at the place of birth that particles take along
  double rate{0};         ///< births a second, >= 0
  double start{0};        ///< of the rate [s]
  double stop{std::numeric_limits<double>::infinity()};  ///< of the rate [s], >= start
  std::vector<Burst> bursts{};                           ///< in order of time
  Range lifetime{std::numeric_limits<double>::infinity(),
                 std::numeric_limits<double>::infinity()};  ///< [s], > 0
  std::uint64_t seed{0};
};

[[nodiscard]] std::optional<SettingsProblem> problem_with(const EmitterSettings& settings);

/// What the n-th particle of an emitter is born with, in E.
struct Birth {
  Vector3 p_EP{Vector3::Zero()};
  Vector3 v_EP{Vector3::Zero()};
  double lifetime{0};
};
[[nodiscard]] Birth birth_of(const EmitterSettings& settings, std::uint64_t n);

}  // namespace pantin

#pragma once
// Names of what a PhysicsManager owns: values of 8 bytes, null by default, stale ones are detected.
#include <compare>
#include <cstdint>
#include <functional>

namespace pantin {

template <class Tag>
struct PhysicsId {
  std::uint32_t index{0};
  std::uint32_t generation{0};  ///< 0 = null

  explicit operator bool() const noexcept { return generation != 0; }
  friend auto operator<=>(const PhysicsId&, const PhysicsId&) = default;
};

using BodyId = PhysicsId<struct BodyTag>;  ///< as a joint's or force's end, null means the world
using JointId = PhysicsId<struct JointTag>;
using CouplingId = PhysicsId<struct CouplingTag>;
using ForceId = PhysicsId<struct ForceTag>;
using ParticleSystemId = PhysicsId<struct ParticleSystemTag>;
using EmitterId = PhysicsId<struct EmitterTag>;
using ParticleConstraintId = PhysicsId<struct ParticleConstraintTag>;
using DeflectorId = PhysicsId<struct DeflectorTag>;

/// One particle. Serials count up from 0 within a system and are never used again.
struct ParticleId {
  ParticleSystemId system{};
  std::uint64_t serial{0};

  explicit operator bool() const noexcept { return static_cast<bool>(system); }
  friend auto operator<=>(const ParticleId&, const ParticleId&) = default;
};

}  // namespace pantin

template <class Tag>
struct std::hash<pantin::PhysicsId<Tag>> {
  std::size_t operator()(pantin::PhysicsId<Tag> id) const noexcept {
    return std::hash<std::uint64_t>{}(std::uint64_t{id.generation} << 32 | id.index);
  }
};

#pragma once
// Private to bridge. What is known of a bound node: its body, who writes it, what it hangs on.
#include <array>
#include <memory>
#include <optional>

#include <pantin/bridge/drive.hpp>
#include <pantin/bridge/node_driver.hpp>
#include <pantin/physics/ids.hpp>
#include <pantin/physics/mass_properties.hpp>
#include <pantin/scenegraph/link.hpp>
#include <pantin/scenegraph/node_id.hpp>

namespace pantin {

/// What a body is tied to by its one joint upward.
struct JointTie {
  enum class Kind {
    None,    ///< free, static, or with a trajectory in the world
    Link,    ///< a joint made from the node's link
    Driven,  ///< a driven joint to the nearest simulated ancestor
  };
  Kind kind{Kind::None};
  BodyId to{};                     ///< null = the world
  LinkKind link{LinkKind::Fixed};  ///< of Kind::Link
  friend bool operator==(const JointTie&, const JointTie&) = default;
};

struct Binding {
  NodeId node{};
  BodyId body{};
  JointId joint{};
  Drive drive{Drive::Static};
  Affine M_BN{Affine::Identity()};  ///< residual

  Binding* above{nullptr};            ///< nearest bound ancestor
  Binding* simulated_above{nullptr};  ///< nearest simulated one

  JointTie tie{};
  bool is_broken{false};                            ///< its joint has broken since it was handed over
  std::array<double, 3> metres_per_value{1, 1, 1};  ///< by number of the link's value (links_to_joints.hpp)

  MassProperties own_mass{0, Vector3::Zero(), Matrix3::Zero()};  ///< in B, as derived; before composites
  double density{1000};                                          ///< it was derived with [kg/m^3]
  bool shares_mass{false};                   ///< a body fixed to it carries its mass, or it carries theirs
  std::optional<LinkValue> pending_turns{};  ///< with whole turns, to be told to physics

  std::unique_ptr<NodeMotion> motion{
      std::make_unique<NodeMotion>()};  ///< drive Scene; physics' drivers point to it
  std::optional<Offset>
      blend{};  ///< drive Scene: the way back to the clip; the bridge writes the node meanwhile
  Affine M_PN_rest{Affine::Identity()};  ///< local matrix that a blending node without clip goes to
  std::optional<RigidMotion>
      moved_from{};  ///< drive Scene: the user moved it since the last update; where it was

  // What was written to the scene, or stood there at binding.
  Pose X_WB_written{};
  Affine M_WP_written{Affine::Identity()};
  Affine M_WN{Affine::Identity()};
  bool is_remembered{false};  ///< the above is up to date
  bool below_written{false};  ///< a bound node above is written by the bridge

  /// Whether it moves as physics says: simulated, or carried by something simulated.
  [[nodiscard]] bool moves_with_physics() const noexcept {
    return drive == Drive::Physics || simulated_above != nullptr;
  }
  /// Whether the bridge writes the node's matrix from its body.
  [[nodiscard]] bool is_written() const noexcept { return drive == Drive::Physics || blend.has_value(); }
};

}  // namespace pantin

#pragma once
// Private to bridge. The mass of a node's body from what is known of the node and of what follows it rigidly.
#include <functional>
#include <unordered_map>
#include <vector>

#include <pantin/bridge/bridge.hpp>

namespace pantin {

struct DerivedMass {
  MassProperties mass{0, Vector3::Zero(), Matrix3::Zero()};  ///< in B
  bool known{false};       ///< false: neither a declared mass nor geometry, the mass is zero
  bool no_inertia{false};  ///< a declared mass without inertia, and no geometry to shape one from
  /// What was derived, defaulted or taken together; places and subjects are filled in.
  std::vector<Diagnostic> notes{};
};

/// Where masses come from.
struct MassSources {
  const Scene& scene;
  const std::unordered_map<NodeId, NodeBody>& node_bodies;
  std::function<bool(NodeId)> is_bound;  ///< nodes that have, or are about to get, a body of their own
};

/// A node that follows a body's node rigidly, and where it is in the body.
struct RigidFollower {
  NodeId node{};
  Affine M_BD{Affine::Identity()};
};

/// The node itself, which lies in the body by `M_BN`, and all below it up to bound ones, parents first.
[[nodiscard]] std::vector<RigidFollower> rigid_followers(const MassSources& from, NodeId node,
                                                         const Affine& M_BN);

/// Declared mass of the node (kept under scale, inertia deformed with M_BN); else derived at `density`
/// [kg/m^3] from its shapes, or its closed meshes, or their bounding boxes, and those of unbound nodes below.
/// Declared masses of unbound nodes below are added. A declared mass without inertia is given that of the
/// geometry.
[[nodiscard]] DerivedMass derive_mass(const MassSources& sources, NodeId node, const Affine& M_BN,
                                      double density);

/// The mass `mass`, given in a frame N, in B: kept under scale, centre of gravity and second moments mapped.
[[nodiscard]] MassProperties mapped(const Affine& M_BN, const MassProperties& mass);

}  // namespace pantin

#pragma once
// Private to bridge. A link of the scene graph as a joint of physics: frames, zero, sign and value kept.
#include <array>
#include <optional>

#include <pantin/physics/constraints/joint.hpp>
#include <pantin/scenegraph/link.hpp>

namespace pantin {

/// Where the two ends of a link are when the joint is made.
struct LinkPlace {
  Affine M_WP{Affine::Identity()};  ///< the node's parent
  Affine M_PN{Affine::Identity()};  ///< the node's local matrix
  Pose X_WA{}, X_WB{};              ///< bodies at the ends; A the identity for the world
};

struct LinkJoint {
  JointDefinition definition{};  ///< with limits as stops; ends, damping and friction left to be filled in
  LinkValue value{};             ///< that the link has now, measured from the local matrix
  /// By number of the value: how far the body moves for one unit of it; 1 for angles.
  std::array<double, 3> metres_per_value{1, 1, 1};
  double misfit{0};  ///< how much of the local matrix the link does not explain, relative to its size
};

/// The joint of a link of any kind but Free; nothing where the parent's matrix is singular along the
/// axis. A link moves its node in the parent's frame, which may scale, shear and mirror; the joint moves the
/// body rigidly:
/// - pivot: about the image of the axis, the line of points that stay; under a mirror the other way round it;
/// - slider: along the image of the axis, by the length of the axis' image for each unit of value;
/// - cylindrical, screw: as pivot and slider;
/// - universal: about the images of its axes, exact where these are at right angles;
/// - planar: in the plane of the images of its directions, exact where the parent scales evenly there;
/// - ball: in the frame of the polar rotation; exact where the parent scales evenly.
[[nodiscard]] std::optional<LinkJoint> joint_of_link(const Link& link, const LinkPlace& place);

/// The coordinates of the joint where the link has `value`.
[[nodiscard]] JointNumbers joint_numbers(const LinkValue& value,
                                         const std::array<double, 3>& metres_per_value);
/// The link's value where the joint has `numbers`; of two quaternions the one nearer to `near`.
[[nodiscard]] LinkValue link_value(const JointNumbers& numbers, const std::array<double, 3>& metres_per_value,
                                   const LinkValue& near);

}  // namespace pantin

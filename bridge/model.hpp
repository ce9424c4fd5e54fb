#pragma once
// What every loader returns: a plain description of a hierarchy with links, shapes, masses and clips. It
// belongs to no scene; Bridge::instantiate makes nodes of it. Nothing is invented here: masses are as read,
// also impossible ones.
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <pantin/physics/mass_properties.hpp>
#include <pantin/physics/shape.hpp>
#include <pantin/scenegraph/clip.hpp>
#include <pantin/scenegraph/link.hpp>

namespace pantin {

/// Which direction of the model's own frame is up.
enum class UpAxis { X, Y, Z };
[[nodiscard]] std::string_view to_string(UpAxis axis) noexcept;  ///< "X", "Y", "Z"

/// A mesh as it stands in the file, in units of metres, placed in the node that carries it.
struct ModelMesh {
  std::string name{};
  std::shared_ptr<const TriangleMesh> mesh{};
  Affine M_NS{Affine::Identity()};  ///< mesh frame in the node; may scale
};

/// What resists a link's motion, as read; a link of the scene graph is geometry only.
struct LinkDynamics {
  double damping{0};   ///< [N m s/rad] or [N s/m], >= 0
  double friction{0};  ///< Coulomb friction [N m] or [N], >= 0
};

struct ModelNode {
  std::string name{};
  std::int32_t parent{-1};                 ///< position in Model::nodes, smaller than its own; -1 = top
  Affine M_PN{Affine::Identity()};         ///< for a node with a link: local_matrix(link, link.value)
  std::optional<Link> link{};              ///< how it moves against its parent
  std::optional<LinkDynamics> dynamics{};  ///< of `link`; nothing where the file says nothing
  std::optional<MassProperties> mass{};  ///< as read, in the node's axes; nothing where the file says nothing
  std::vector<Shape> shapes{};           ///< colliders, X_BS = pose in the node
  std::vector<ModelMesh> meshes{};       ///< geometry that is no collider (visuals)
  std::string place{};                   ///< "file:line" or JSON pointer, for diagnostics
};

struct Model {
  std::string name{};
  std::string format{};  ///< "urdf", "gltf", "glb", else the lower-case extension: "obj", "dae"
  UpAxis up_axis{UpAxis::Z};
  double unit_m{1};                ///< metres per unit of the file; applied already
  std::vector<ModelNode> nodes{};  ///< parents before children
  std::vector<Clip> clips{};       ///< Track::target = position in `nodes`
};

}  // namespace pantin

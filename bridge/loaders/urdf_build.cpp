#include <pantin/bridge/loaders/urdf_build.hpp>

#include <urdf_model/joint.h>
#include <urdf_model/link.h>
#include <urdf_model/model.h>

#include <cmath>
#include <string>
#include <unordered_map>
#include <utility>

namespace pantin::urdf_loader {
namespace {

Vector3 vector_of(const urdf::Vector3& v) { return {v.x, v.y, v.z}; }

Pose pose_of(const urdf::Pose& pose) {
  return {vector_of(pose.position),
          Quaternion{pose.rotation.w, pose.rotation.x, pose.rotation.y, pose.rotation.z}.normalized()};
}

Affine affine_of(const Pose& pose) {
  Affine M = Affine::Identity();
  M.linear() = pose.rotation();
  M.translation() = pose.p;
  return M;
}

/// URDF gives inertia in axes of the inertial's own frame I, at its origin, the centre of gravity:
/// I_NNcm_N = R_NI I_I R_NI^T.
MassProperties mass_of(const urdf::Inertial& inertial) {
  const Pose X_NI = pose_of(inertial.origin);
  Matrix3 I_I;
  I_I << inertial.ixx, inertial.ixy, inertial.ixz,  //
      inertial.ixy, inertial.iyy, inertial.iyz,     //
      inertial.ixz, inertial.iyz, inertial.izz;
  const Matrix3 R_NI = X_NI.rotation();
  const bool same_axes = X_NI.q.vec().isZero(0);  // keeps the numbers of the file to the last bit
  const Matrix3 turned = R_NI * I_I * R_NI.transpose();
  const Matrix3 symmetric = 0.5 * (turned + turned.transpose());
  return {.mass = inertial.mass, .p_BBcm = X_NI.p, .I_BBcm_B = same_axes ? I_I : symmetric};
}

LinkKind kind_of(JointType type) {
  switch (type) {
    case JointType::Revolute:
    case JointType::Continuous:
      return LinkKind::Pivot;
    case JointType::Prismatic:
      return LinkKind::Slider;
    case JointType::Planar:
      return LinkKind::Planar;
    case JointType::Floating:
      return LinkKind::Free;
    default:
      return LinkKind::Fixed;
  }
}

/// URDF names only the plane's normal. Its first direction is the image of x under the least turn of z to the
/// normal.
Vector3 first_across(const Vector3& normal) {
  return (Quaternion::FromTwoVectors(Vector3::UnitZ(), normal) * Vector3::UnitX()).normalized();
}

Link link_of(const urdf::Joint& joint, JointType type) {
  Link link{.kind = kind_of(type),
            .name = joint.name,
            .M_PJ = affine_of(pose_of(joint.parent_to_joint_origin_transform)),
            .value = zero_value(kind_of(type))};
  if (has_axis(type)) link.axis = vector_of(joint.axis).normalized();
  if (type == JointType::Planar) link.axis2 = first_across(link.axis);
  if (has_value(type) && type != JointType::Continuous && joint.limits) {
    link.limits[0] = {joint.limits->lower, joint.limits->upper};
  }
  if (joint.mimic) {
    link.mimic = LinkMimic{joint.mimic->joint_name, joint.mimic->multiplier, joint.mimic->offset};
  }
  return link;
}

/// The shapes of one link.
class Shapes {
 public:
  Shapes(const LinkEntry& link, Meshes& meshes, Ledger& ledger)
      : link_{link}, meshes_{meshes}, ledger_{ledger} {}

  void add_collision(const urdf::Collision& collision, const GeometryEntry& entry, ModelNode& node) const {
    const Pose X_BS = pose_of(collision.origin);
    const auto add = [&](ShapeGeometry geometry) { node.shapes.push_back({std::move(geometry), X_BS}); };
    switch (collision.geometry->type) {
      case urdf::Geometry::SPHERE:
        add(SphereShape{cast<urdf::Sphere>(collision.geometry).radius});
        break;
      case urdf::Geometry::BOX:
        add(BoxShape{vector_of(cast<urdf::Box>(collision.geometry).dim)});
        break;
      case urdf::Geometry::CYLINDER: {
        const auto& cylinder = cast<urdf::Cylinder>(collision.geometry);
        if (entry.is_capsule) {
          add(CapsuleShape{cylinder.radius, cylinder.length});
        } else {
          add(CylinderShape{cylinder.radius, cylinder.length});
        }
        break;
      }
      case urdf::Geometry::MESH: {
        const auto& mesh = cast<urdf::Mesh>(collision.geometry);
        if (auto triangles = meshes_.find(mesh.filename, entry.line, subject("collision", entry))) {
          add(MeshShape{std::move(triangles), vector_of(mesh.scale)});
        } else {
          ledger_.lose({entry.number, {}, kNoMesh});
        }
        break;
      }
    }
  }

  void add_visual(const urdf::Visual& visual, const GeometryEntry& entry, ModelNode& node) const {
    if (visual.geometry->type != urdf::Geometry::MESH) return;  // the survey keeps no others
    const auto& mesh = cast<urdf::Mesh>(visual.geometry);
    auto triangles = meshes_.find(mesh.filename, entry.line, subject("visual", entry));
    if (triangles == nullptr) return ledger_.lose({entry.number, {}, kNoMesh});
    const Affine M_NS = affine_of(pose_of(visual.origin)) * Eigen::Scaling(vector_of(mesh.scale));
    const std::string stem = std::filesystem::path{mesh.filename}.stem().string();
    node.meshes.push_back({entry.name.empty() ? stem : entry.name, std::move(triangles), M_NS});
  }

 private:
  template <class Kind>
  static const Kind& cast(const urdf::GeometrySharedPtr& geometry) {
    return static_cast<const Kind&>(*geometry);
  }
  std::string subject(const char* what, const GeometryEntry& entry) const {
    const std::string name = entry.name.empty() ? "" : " '" + entry.name + '\'';
    return "link '" + link_.name + "', " + what + name;
  }

  static constexpr const char* kNoMesh = "its mesh is not read";

  const LinkEntry& link_;
  Meshes& meshes_;
  Ledger& ledger_;
};

/// Whether urdfdom kept just the shapes that the survey left in its copy.
bool agrees(const urdf::Link& link, const LinkEntry& entry) {
  const auto complete = [](const auto& shapes, std::size_t count) {
    for (const auto& shape : shapes) {
      if (shape == nullptr || shape->geometry == nullptr) return false;
    }
    return shapes.size() == count;
  };
  return complete(link.collision_array, entry.collisions.size()) &&
         complete(link.visual_array, entry.visuals.size());
}

void add_joint(const urdf::Joint& joint, const JointEntry& entry, ModelNode& node) {
  node.link = link_of(joint, entry.type);
  node.M_PN = local_matrix(*node.link, node.link->value);
  if (joint.dynamics) node.dynamics = LinkDynamics{joint.dynamics->damping, joint.dynamics->friction};
}

/// Links that follow others start where these have them; chains of them end, as the survey saw to.
void start_mimics(Model& model, Ledger& ledger) {
  std::unordered_map<std::string, Link*> by_name;
  for (ModelNode& node : model.nodes)
    if (node.link) by_name.try_emplace(node.link->name, &*node.link);
  for (ModelNode& node : model.nodes) {
    if (!node.link || !node.link->mimic) continue;
    double factor = 1;  // against the link at the end of the chain, whose value is 0
    double value = 0;
    for (const Link* link = &*node.link; link->mimic; link = by_name.at(link->mimic->source)) {
      value += factor * link->mimic->offset;
      factor *= link->mimic->multiplier;
    }
    if (!std::isfinite(value)) {
      ledger.error({0, "joint '" + node.link->name + "'", "its mimic starts at a value that is not finite",
                    "check multipliers and offsets"});
      continue;
    }
    node.link->value = value;
    node.M_PN = local_matrix(*node.link, node.link->value);
  }
}

}  // namespace

std::optional<Model> build_model(const urdf::ModelInterface& robot, const Survey& survey, Meshes& meshes,
                                 Ledger& ledger) {
  Model model{.name = survey.robot, .format = "urdf", .up_axis = UpAxis::Z, .unit_m = 1};
  model.nodes.reserve(survey.tree.size());
  for (const TreeEntry& at : survey.tree) {
    const LinkEntry& entry = survey.links[at.link];
    const urdf::LinkConstSharedPtr link = robot.getLink(entry.name);
    const JointEntry* joint_entry =
        at.joint >= 0 ? &survey.joints[static_cast<std::size_t>(at.joint)] : nullptr;
    const urdf::JointConstSharedPtr joint =
        joint_entry != nullptr ? robot.getJoint(joint_entry->name) : nullptr;
    if (link == nullptr || !agrees(*link, entry) || (joint_entry != nullptr) != (joint != nullptr)) {
      ledger.error({entry.line, "link '" + entry.name + '\'',
                    "urdfdom reads this link or its joint otherwise",
                    "check the characters of its name and its shapes"});
      return std::nullopt;
    }
    ModelNode node{.name = entry.name, .parent = at.parent, .place = ledger.place(entry.line)};
    if (joint != nullptr) add_joint(*joint, *joint_entry, node);
    if (link->inertial != nullptr) node.mass = mass_of(*link->inertial);
    const Shapes shapes{entry, meshes, ledger};
    for (std::size_t i = 0; i < entry.collisions.size(); ++i) {
      shapes.add_collision(*link->collision_array[i], entry.collisions[i], node);
    }
    for (std::size_t i = 0; i < entry.visuals.size(); ++i) {
      shapes.add_visual(*link->visual_array[i], entry.visuals[i], node);
    }
    model.nodes.push_back(std::move(node));
  }
  start_mimics(model, ledger);
  if (ledger.has_error()) return std::nullopt;
  return model;
}

}  // namespace pantin::urdf_loader

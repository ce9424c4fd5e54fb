#include <pantin/bridge/writers/model_json.hpp>

#include <cmath>

#include <pantin/bridge/writers/ledger_json.hpp>

namespace pantin {
namespace {

/// A number for one, an array for several, null for none.
void write_value(JsonStream& json, std::span<const double> numbers) {
  if (numbers.empty()) json.null();
  else if (numbers.size() == 1) json.value(numbers.front());
  else json.value(numbers);
}

/// One end of the limits, for several numbers an array; infinity is written as null.
void write_limits(JsonStream& json, const Link& link, double LinkLimits::*end) {
  const int count = limit_count(link.kind);
  if (count == 0) json.null();
  else if (count == 1) json.value(link.limits[0].*end);
  else {
    json.begin_array();
    for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) json.value(link.limits[i].*end);
    json.end_array();
  }
}

void write_link(JsonStream& json, const Link& link, const LinkValue& value) {
  json.begin_object().member("name", link.name).member("kind", to_string(link.kind));
  json.key("axis");
  has_axis(link.kind) ? json.value(link.axis) : json.null();
  if (has_axis2(link.kind)) json.member("axis2", link.axis2);
  if (link.kind == LinkKind::Screw) json.member("pitch", link.pitch);
  json.key("lower");
  write_limits(json, link, &LinkLimits::lower);
  json.key("upper");
  write_limits(json, link, &LinkLimits::upper);
  json.key("value");
  write_value(json, value.numbers());
  json.end_object();
}

void write_mesh_size(JsonStream& json, const std::shared_ptr<const TriangleMesh>& mesh) {
  json.member("vertices", mesh ? mesh->vertices.size() : 0);
  json.member("triangles", mesh ? mesh->triangles.size() : 0);
}

void write_shapes(JsonStream& json, std::string_view key, const std::vector<Shape>& shapes);

void write_geometry(JsonStream& json, const ShapeGeometry& geometry) {
  if (const auto* sphere = std::get_if<SphereShape>(&geometry)) {
    json.member("radius", sphere->radius);
  } else if (const auto* box = std::get_if<BoxShape>(&geometry)) {
    json.member("size", box->size);
  } else if (const auto* capsule = std::get_if<CapsuleShape>(&geometry)) {
    json.member("radius", capsule->radius).member("length", capsule->length);
  } else if (const auto* cylinder = std::get_if<CylinderShape>(&geometry)) {
    json.member("radius", cylinder->radius).member("length", cylinder->length);
  } else if (const auto* mesh = std::get_if<MeshShape>(&geometry)) {
    write_mesh_size(json, mesh->mesh);
    json.member("scale", mesh->scale);
  } else if (const auto* cone = std::get_if<ConeShape>(&geometry)) {
    json.member("radius", cone->radius).member("length", cone->length);
  } else if (const auto* ellipsoid = std::get_if<EllipsoidShape>(&geometry)) {
    json.member("radii", ellipsoid->radii);
  } else if (const auto* convex = std::get_if<ConvexShape>(&geometry)) {
    write_mesh_size(json, convex->hull);
    json.member("scale", convex->scale);
  } else if (const auto* compound = std::get_if<CompoundShape>(&geometry)) {
    write_shapes(json, "parts", *compound->parts);
  }
}

void write_shapes(JsonStream& json, std::string_view key, const std::vector<Shape>& shapes) {
  json.key(key).begin_array();
  for (const Shape& shape : shapes) {
    json.begin_object().member("kind", kind_of(shape.geometry));
    write_geometry(json, shape.geometry);
    json.member("position", shape.X_BS.p).member("quaternion_wxyz", shape.X_BS.q).end_object();
  }
  json.end_array();
}

void write_solids(JsonStream& json, const ModelNode& node) {
  write_shapes(json, "shapes", node.shapes);
  json.key("meshes").begin_array();
  for (const ModelMesh& mesh : node.meshes) {
    json.begin_object();
    write_mesh_size(json, mesh.mesh);
    json.end_object();
  }
  json.end_array();
}

void write_mass(JsonStream& json, const std::optional<MassProperties>& mass) {
  if (mass) {
    json.member("mass", mass->mass);
    json.member("centre_of_gravity", mass->p_BBcm);
    json.member("inertia", mass->I_BBcm_B);
  } else {
    json.key("mass").null().key("centre_of_gravity").null().key("inertia").null();
  }
}

/// `paths` are those of all nodes.
void write_node(JsonStream& json, const ModelInScene& view, std::span<const std::string> paths,
                std::size_t i) {
  const ModelNode& node = view.model.nodes[i];
  const NodeId id = view.nodes[i];
  json.begin_object().member("path", paths[i]).member("name", node.name);
  json.key("parent");
  node.parent < 0 ? json.null() : json.value(paths[static_cast<std::size_t>(node.parent)]);
  json.member("local", view.scene.local(id)).member("absolute", view.scene.world(id));
  json.key("link");
  const Link* placed = view.scene.link(id);
  if (node.link) write_link(json, *node.link, placed != nullptr ? placed->value : node.link->value);
  else json.null();
  write_mass(json, node.mass);
  write_solids(json, node);
  json.end_object();
}

}  // namespace

std::optional<double> total_mass(const Model& model) {
  std::optional<double> sum;
  for (const ModelNode& node : model.nodes)
    if (node.mass) sum = sum.value_or(0) + node.mass->mass;
  return sum;
}

void write_model_json(std::ostream& out, const ModelInScene& view, std::span<const Diagnostic> ledger) {
  JsonStream json{out};
  json.begin_object(JsonLayout::Lines);
  json.member("model", view.model.name).member("format", view.model.format);
  json.member("up_axis", to_string(view.model.up_axis)).member("unit_m", view.model.unit_m);
  json.key("total_mass");
  const std::optional<double> mass = total_mass(view.model);
  mass ? json.value(*mass) : json.null();

  json.key("nodes").begin_array(JsonLayout::Lines);
  const std::vector<std::string> paths = view.scene.paths(view.nodes);
  for (std::size_t i = 0; i < view.model.nodes.size(); ++i) write_node(json, view, paths, i);
  json.end_array();

  json.key("clips").begin_array(JsonLayout::Lines);
  for (const Clip& clip : view.model.clips) {
    json.begin_object().member("name", clip.name).member("duration", clip.duration);
    json.member("channels", clip.tracks.size()).end_object();
  }
  json.end_array();
  json.key("ledger");
  write_ledger(json, ledger);
  json.end_object();
}

}  // namespace pantin

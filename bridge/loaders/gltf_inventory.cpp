#include "gltf_inventory.hpp"

#include <algorithm>
#include <span>

namespace pantin::gltf {
namespace {

using Keys = std::span<const std::string_view>;

// What glTF 2.0 knows in its objects, beside `extensions` and `extras`.
constexpr std::array<std::string_view, 17> kRootKeys{"asset",       "extensionsUsed", "extensionsRequired",
                                                     "accessors",   "animations",     "buffers",
                                                     "bufferViews", "cameras",        "images",
                                                     "materials",   "meshes",         "nodes",
                                                     "samplers",    "scene",          "scenes",
                                                     "skins",       "textures"};
constexpr std::array<std::string_view, 4> kAssetKeys{"copyright", "generator", "version", "minVersion"};
constexpr std::array<std::string_view, 10> kAccessorKeys{
    "bufferView", "byteOffset", "componentType", "normalized", "count",
    "type",       "max",        "min",           "sparse",     "name"};
constexpr std::array<std::string_view, 3> kSparseKeys{"count", "indices", "values"};
constexpr std::array<std::string_view, 3> kSparsePartKeys{"bufferView", "byteOffset", "componentType"};
constexpr std::array<std::string_view, 3> kAnimationKeys{"channels", "samplers", "name"};
constexpr std::array<std::string_view, 2> kChannelKeys{"sampler", "target"};
constexpr std::array<std::string_view, 2> kTargetKeys{"node", "path"};
constexpr std::array<std::string_view, 3> kSamplerKeys{"input", "interpolation", "output"};
constexpr std::array<std::string_view, 3> kBufferKeys{"uri", "byteLength", "name"};
constexpr std::array<std::string_view, 6> kViewKeys{"buffer",     "byteOffset", "byteLength",
                                                    "byteStride", "target",     "name"};
constexpr std::array<std::string_view, 3> kMeshKeys{"primitives", "weights", "name"};
constexpr std::array<std::string_view, 5> kPrimitiveKeys{"attributes", "indices", "material", "mode",
                                                         "targets"};
constexpr std::array<std::string_view, 10> kNodeKeys{
    "camera", "children", "skin", "matrix", "mesh", "rotation", "scale", "translation", "weights", "name"};
constexpr std::array<std::string_view, 2> kSceneKeys{"nodes", "name"};
constexpr std::array<std::string_view, 1> kInstancingKeys{"attributes"};

const char* const kAppearance = "not loaded: physics has no use for appearance";

void check(Report& report, const JsonValue& object, Keys known);

void note_extension(Report& report, const JsonValue& at, std::string_view name) {
  const std::string subject = "extension '" + shortened(name) + "'";
  switch (use_of(name)) {
    case ExtensionUse::Read:
      if (name == "EXT_mesh_gpu_instancing") check(report, at, kInstancingKeys);
      return;
    case ExtensionUse::Appearance:
      report.drop(Severity::Note, subject, at, kAppearance, "");
      return;
    case ExtensionUse::Unknown:
      report.drop(Severity::Warning, subject, at, "not known to Pantin: what it says is dropped",
                  "express it in core glTF 2.0 if it matters");
  }
}

/// Tells of the members of an object that are not in `known`.
void check(Report& report, const JsonValue& object, Keys known) {
  report.marks().know(object);
  for (std::size_t i = 0; i < object.size() && object.kind() == JsonKind::Object; ++i) {
    const JsonValue value = object.at(i);
    const std::string_view key = value.key();
    if (std::ranges::find(known, key) != known.end()) continue;
    if (key == "extras") {
      note_extras(report, value);
    } else if (key == "extensions") {
      report.marks().read(value);
      for (std::size_t k = 0; k < value.size() && value.kind() == JsonKind::Object; ++k)
        note_extension(report, value.at(k), value.at(k).key());
    } else {
      report.marks().drop(value, "glTF 2.0 does not know it here");
      report.tally(Severity::Warning, "property '" + shortened(key) + "'", object,
                   "glTF 2.0 does not know it here: dropped", "check its spelling");
    }
  }
}

/// Calls `visit` for each element of an array member, if it is one.
template <class Visit>
void each(const std::optional<JsonValue>& array, const Visit& visit) {
  for (std::size_t i = 0; array && i < array->size(); ++i) visit(array->at(i));
}

void check_accessor(Report& report, const JsonValue& accessor) {
  check(report, accessor, kAccessorKeys);
  const std::optional<JsonValue> sparse = accessor.find("sparse");
  if (!sparse) return;
  check(report, *sparse, kSparseKeys);
  for (const std::string_view part : {"indices", "values"})
    if (const std::optional<JsonValue> found = sparse->find(part)) check(report, *found, kSparsePartKeys);
}

void check_animation(Report& report, const JsonValue& animation) {
  check(report, animation, kAnimationKeys);
  each(animation.find("samplers"), [&](const JsonValue& sampler) { check(report, sampler, kSamplerKeys); });
  each(animation.find("channels"), [&](const JsonValue& channel) {
    check(report, channel, kChannelKeys);
    if (const std::optional<JsonValue> target = channel.find("target")) check(report, *target, kTargetKeys);
  });
}

void check_primitive(Report& report, const JsonValue& primitive) {
  check(report, primitive, kPrimitiveKeys);
  const std::optional<JsonValue> attributes = primitive.find("attributes");
  each(attributes, [&](const JsonValue& attribute) {
    if (attribute.key() != "POSITION")
      report.drop(Severity::Note, "vertex attribute '" + shortened(attribute.key()) + "'", attribute,
                  "not loaded: physics needs positions only", "");
  });
  if (const std::optional<JsonValue> targets = primitive.find("targets"))
    report.drop(Severity::Warning, "morph targets", *targets, "not loaded: the mesh keeps its base shape",
                "");
}

void check_collections(const Document& document) {
  Report& report = document.report();
  const auto all = [&](Collection collection, const auto& visit) {
    for (std::size_t i = 0; i < document.count(collection); ++i) visit(document.item(collection, i));
  };
  const auto plain = [&](Keys keys) {
    return [&report, keys](const JsonValue& item) { check(report, item, keys); };
  };
  all(Collection::Accessors, [&](const JsonValue& accessor) { check_accessor(report, accessor); });
  all(Collection::Animations, [&](const JsonValue& animation) { check_animation(report, animation); });
  all(Collection::Buffers, plain(kBufferKeys));
  all(Collection::BufferViews, plain(kViewKeys));
  all(Collection::Nodes, plain(kNodeKeys));
  all(Collection::Scenes, plain(kSceneKeys));
  all(Collection::Meshes, [&](const JsonValue& mesh) {
    check(report, mesh, kMeshKeys);
    each(mesh.find("primitives"), [&](const JsonValue& primitive) { check_primitive(report, primitive); });
  });
}

/// Whole collections that are left out.
void note_left_out(const Document& document) {
  Report& report = document.report();
  for (const std::string_view name : {"materials", "textures", "images", "samplers", "cameras", "skins"}) {
    const std::optional<JsonValue> items = member(report, document.root(), name, JsonKind::Array);
    if (!items || items->size() == 0) continue;
    const bool deforms = name == "skins";
    report.drop(deforms ? Severity::Warning : Severity::Note, std::string{name}, *items,
                deforms ? "not loaded: skinned meshes keep the shape they have in the file" : kAppearance, "",
                items->size());
  }
}

}  // namespace

void note_extras(Report& report, const JsonValue& extras) {
  report.drop(Severity::Note, "extras", extras, "not read: data of applications", "");
}

void take_inventory(const Document& document) {
  Report& report = document.report();
  check(report, document.root(), kRootKeys);
  if (const std::optional<JsonValue> asset = document.root().find("asset")) check(report, *asset, kAssetKeys);
  check_collections(document);
  note_left_out(document);
  const std::optional<JsonValue> used = member(report, document.root(), "extensionsUsed", JsonKind::Array);
  each(used, [&](const JsonValue& name) {
    note_extension(report, name, expect(report, name, JsonKind::Text).text());
  });
}

}  // namespace pantin::gltf

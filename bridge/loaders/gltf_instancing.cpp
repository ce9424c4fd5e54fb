#include "gltf_instancing.hpp"

#include "gltf_nodes.hpp"

namespace pantin::gltf {
namespace {

std::optional<JsonValue> attributes_of(Report& report, const JsonValue& node) {
  const std::optional<JsonValue> extensions = member(report, node, "extensions", JsonKind::Object);
  if (!extensions) return std::nullopt;
  const std::optional<JsonValue> instancing =
      member(report, *extensions, "EXT_mesh_gpu_instancing", JsonKind::Object);
  if (!instancing) return std::nullopt;
  return expect(report, require(report, *instancing, "attributes"), JsonKind::Object);
}

/// Numbers of one attribute, `count` of them being known once the first is read.
std::optional<AccessorData> read_attribute(const JsonValue& attributes, std::string_view name,
                                           AccessorUse use, const Document& document, Accessors& accessors,
                                           std::optional<std::size_t>& count) {
  const std::optional<JsonValue> accessor = document.referred(attributes, name, Collection::Accessors);
  if (!accessor) return std::nullopt;
  AccessorData data = accessors.read(*accessor, use);
  if (count && *count != data.count) {
    document.report().refuse(*attributes.find(name),
                             "it has " + std::to_string(data.count) +
                                 " instances where another attribute has " + std::to_string(*count),
                             "give all attributes the same number");
  }
  count = data.count;
  return data;
}

}  // namespace

std::optional<std::vector<Affine>> read_instances(const JsonValue& node, const Document& document,
                                                  Accessors& accessors) {
  Report& report = document.report();
  const std::optional<JsonValue> attributes = attributes_of(report, node);
  if (!attributes) return std::nullopt;
  std::optional<std::size_t> count;
  const auto read = [&](std::string_view name, AccessorUse use) {
    return read_attribute(*attributes, name, use, document, accessors, count);
  };
  const std::optional<AccessorData> t = read("TRANSLATION", AccessorUse::Vector);
  const std::optional<AccessorData> r = read("ROTATION", AccessorUse::Rotation);
  const std::optional<AccessorData> s = read("SCALE", AccessorUse::Vector);
  for (std::size_t i = 0; i < attributes->size(); ++i) {
    const std::string_view key = attributes->at(i).key();
    if (key == "TRANSLATION" || key == "ROTATION" || key == "SCALE") continue;
    report.drop(Severity::Note, "instance attribute '" + shortened(key) + "'", attributes->at(i),
                "not loaded: physics needs places only", "");
  }
  std::vector<Affine> instances(count.value_or(0), Affine::Identity());
  accessors.charge(*attributes, 16 * instances.size());
  const auto vector_at = [](const AccessorData& data, std::size_t i) {
    return Vector3{data.numbers[3 * i], data.numbers[3 * i + 1], data.numbers[3 * i + 2]};
  };
  for (std::size_t i = 0; i < instances.size(); ++i) {
    Affine& M = instances[i];
    if (t) M.translation() = vector_at(*t, i);
    if (r) {
      const std::array<double, 4> xyzw{r->numbers[4 * i], r->numbers[4 * i + 1], r->numbers[4 * i + 2],
                                       r->numbers[4 * i + 3]};
      M.linear() =
          unit_quaternion(report, *attributes->find("ROTATION"), xyzw, kUnitTolerance).toRotationMatrix();
    }
    if (s) M.linear() = M.linear() * vector_at(*s, i).asDiagonal();
  }
  return instances;
}

}  // namespace pantin::gltf

#include "gltf_document.hpp"

#include <algorithm>

namespace pantin::gltf {
namespace {

JsonTree parse(const Container& container, Report& report) {
  JsonError error;
  const std::string_view text{container.bytes.data() + container.json.offset, container.json.size};
  if (std::optional<JsonTree> tree = JsonTree::parse(text, error)) return std::move(*tree);
  report.refuse_file("its JSON" + std::string{container.binary ? " chunk" : ""} + " has a " + error.text,
                     "mend the text or export it again", error.line);
}

/// Major and minor number of "2.0"; nothing for anything else.
std::optional<std::array<int, 2>> parse_version(std::string_view text) {
  const std::size_t dot = text.find('.');
  if (dot == std::string_view::npos || dot == 0 || dot > 4 || text.size() - dot < 2 || text.size() - dot > 5)
    return std::nullopt;
  std::array<int, 2> numbers{0, 0};
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (i == dot) continue;
    if (text[i] < '0' || text[i] > '9') return std::nullopt;
    int& number = numbers[i < dot ? 0 : 1];
    number = 10 * number + (text[i] - '0');
  }
  return numbers;
}

std::array<int, 2> version_in(const JsonValue& value, Report& report) {
  const std::string_view text = expect(report, value, JsonKind::Text).text();
  if (const std::optional<std::array<int, 2>> version = parse_version(text)) return *version;
  report.refuse(value, "'" + shortened(text) + "' is no version", "write major.minor, \"2.0\" say");
}

}  // namespace

std::string_view to_string(Collection collection) noexcept {
  constexpr std::array<std::string_view, 7> kNames{"accessors", "animations", "buffers", "bufferViews",
                                                   "meshes",    "nodes",      "scenes"};
  return kNames[static_cast<std::size_t>(collection)];
}

ExtensionUse use_of(std::string_view extension) noexcept {
  constexpr std::array<std::string_view, 4> kRead{"KHR_physics_rigid_bodies", "KHR_implicit_shapes",
                                                  "KHR_mesh_quantization", "EXT_mesh_gpu_instancing"};
  constexpr std::array<std::string_view, 11> kAppearance{
      "KHR_materials_",   "KHR_texture_",     "KHR_lights_",         "KHR_xmp",
      "KHR_audio",        "EXT_texture_",     "EXT_lights_",         "EXT_materials_",
      "MSFT_texture_dds", "ADOBE_materials_", "KHR_techniques_webgl"};
  if (std::ranges::find(kRead, extension) != kRead.end()) return ExtensionUse::Read;
  const auto begins = [&](std::string_view start) { return extension.starts_with(start); };
  return std::ranges::any_of(kAppearance, begins) ? ExtensionUse::Appearance : ExtensionUse::Unknown;
}

Document::Document(const std::filesystem::path& file, Report& report)
    : report_{report},
      folder_{file.has_parent_path() ? file.parent_path() : std::filesystem::path{"."}},
      container_{read_container(file, report)},
      tree_{parse(container_, report)} {
  expect(report_, root(), JsonKind::Object);
  if (const std::optional<JsonValue> twice = tree_.first_duplicate())
    report_.refuse(*twice, "the key stands twice in the same object", "keep one of them");
  check_asset();
  check_required_extensions();
  for (std::size_t i = 0; i < collections_.size(); ++i) {
    const std::string_view name = to_string(static_cast<Collection>(i));
    collections_[i] = member(report_, root(), name, JsonKind::Array);
    for (std::size_t k = 0; collections_[i] && k < collections_[i]->size(); ++k)
      check_kind(report_, collections_[i]->at(k), JsonKind::Object);
  }
}

void Document::check_asset() const {
  const JsonValue asset = require(report_, root(), "asset");
  const JsonValue version = require(report_, asset, "version");
  const std::array<int, 2> numbers = version_in(version, report_);
  if (numbers[0] != 2)
    report_.refuse(version, "the model is glTF " + shortened(version.text()) + "; only glTF 2 is read",
                   "convert it to glTF 2.0");
  if (const std::optional<JsonValue> least = asset.find("minVersion"))
    if (version_in(*least, report_) > std::array<int, 2>{2, 0})
      report_.refuse(*least, "the model needs a reader of glTF " + shortened(least->text()),
                     "export it for glTF 2.0");
  if (numbers[1] > 0)
    report_.tally(Severity::Note, version,
                  "the model is glTF " + shortened(version.text()) + " and is read as glTF 2.0", "");
}

void Document::check_required_extensions() const {
  const std::optional<JsonValue> required = member(report_, root(), "extensionsRequired", JsonKind::Array);
  if (!required) return;
  std::string unknown;
  for (std::size_t i = 0; i < required->size(); ++i) {
    const std::string_view name = expect(report_, required->at(i), JsonKind::Text).text();
    if (use_of(name) == ExtensionUse::Unknown && unknown.size() < 400)
      unknown += (unknown.empty() ? "'" : ", '") + shortened(name) + "'";
  }
  if (!unknown.empty())
    report_.refuse(*required, "the model cannot be read without " + unknown + ", which Pantin does not know",
                   "export it without them");
}

std::size_t Document::count(Collection collection) const {
  const std::optional<JsonValue>& items = collections_[static_cast<std::size_t>(collection)];
  return items ? items->size() : 0;
}

JsonValue Document::item(Collection collection, std::size_t i) const {
  return collections_[static_cast<std::size_t>(collection)].value().at(i);
}

std::size_t Document::index(const JsonValue& value, Collection collection) const {
  const std::uint64_t index = to_size(report_, value);
  if (index >= count(collection))
    report_.refuse(value,
                   "refers to item " + std::to_string(index) + " of '" + std::string{to_string(collection)} +
                       "', which has " + std::to_string(count(collection)),
                   "write an index below that");
  return static_cast<std::size_t>(index);
}

std::optional<JsonValue> Document::referred(const JsonValue& object, std::string_view key,
                                            Collection collection) const {
  const std::optional<JsonValue> value = object.find(key);
  if (!value) return std::nullopt;
  return item(collection, index(*value, collection));
}

bool Document::uses(std::string_view extension) const {
  const std::optional<JsonValue> used = root().find("extensionsUsed");
  if (!used || used->kind() != JsonKind::Array) return false;
  for (std::size_t i = 0; i < used->size(); ++i)
    if (used->at(i).text() == extension) return true;
  return false;
}

}  // namespace pantin::gltf

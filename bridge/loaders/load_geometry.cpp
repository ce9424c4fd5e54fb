#include <pantin/bridge/loaders/load_geometry.hpp>

#include <exception>
#include <utility>

#include <pantin/bridge/input_file.hpp>
#include <pantin/bridge/loaders/geometry_file.hpp>

namespace pantin {
namespace {

using geometry_loader::Content;

constexpr std::uintmax_t kMaxBytes = std::uintmax_t{2} << 30;

/// By extension; a file without one, or with another, that is handed here is PLY.
std::string format_of(const std::filesystem::path& file) {
  return geometry_reads(file) ? lower_extension(file).substr(1) : "ply";
}

Content read(const std::string& format, std::string_view bytes) {
  if (format == "obj") return geometry_loader::read_obj(bytes);
  if (format == "stl") return geometry_loader::read_stl(bytes);
  return geometry_loader::read_ply(bytes);
}

using geometry_loader::Tally;

std::string list_of(const std::map<std::string, Tally>& counted, bool with_lines) {
  std::string text;
  for (const auto& [what, tally] : counted) {
    text += (text.empty() ? "" : ", ") + std::to_string(tally.count) + ' ' + what;
    if (with_lines && tally.line > 0)
      text += (tally.count > 1 ? " (first in line " : " (line ") + std::to_string(tally.line) + ')';
  }
  return text;
}

void add_account(const Content& content, const std::string& place, Account& account) {
  std::size_t vertices = 0, triangles = 0;
  for (const geometry_loader::Part& part : content.parts) {
    vertices += part.mesh.vertices.size();
    triangles += part.mesh.triangles.size();
  }
  const auto add = [&](Fate fate, const std::string& item, const Tally& tally, const char* why) {
    account.push_back({.fate = fate,
                       .place = tally.line > 0 ? place + ':' + std::to_string(tally.line) : place,
                       .subject = "file",
                       .item = item,
                       .why = why,
                       .count = tally.count});
  };
  add(Fate::Read, "vertices", {vertices}, "");
  add(Fate::Read, "triangles", {triangles}, "");
  for (const auto& [what, tally] : content.not_needed)
    add(Fate::Dropped, what, tally, "not needed for physics");
  for (const auto& [what, tally] : content.dropped) add(Fate::Dropped, what, tally, "cannot be kept");
}

void add_notes(const Content& content, UpAxis up, const std::string& place, std::vector<Diagnostic>& notes) {
  notes.push_back({Severity::Note, place, "up axis",
                   "is not stated by the file: " + std::string{to_string(up)} + " is taken", ""});
  notes.push_back({Severity::Note, place, "unit", "is not stated by the file: 1 m is taken", ""});
  if (!content.not_needed.empty()) {
    notes.push_back({Severity::Note, place, "file",
                     "not needed for physics and dropped: " + list_of(content.not_needed, false), ""});
  }
  if (!content.dropped.empty())
    notes.push_back({Severity::Warning, place, "file", "dropped: " + list_of(content.dropped, true), ""});
}

Model model_of(Content content, const std::filesystem::path& file, bool geometry) {
  const std::string format = format_of(file);
  Model model{.name = file.stem().string(),
              .format = format,
              .up_axis = format == "obj" ? UpAxis::Y : UpAxis::Z,
              .unit_m = 1};
  const bool single = content.parts.size() == 1;
  if (!single) model.nodes.push_back({.name = model.name, .place = file.string()});
  for (geometry_loader::Part& part : content.parts) {
    ModelNode node{.name = part.name, .parent = single ? -1 : 0, .place = file.string()};
    if (single && node.name.empty()) node.name = model.name;
    if (geometry) {
      node.meshes.push_back(
          {part.name, std::make_shared<const TriangleMesh>(std::move(part.mesh)), Affine::Identity()});
    }
    model.nodes.push_back(std::move(node));
  }
  return model;
}

Diagnostic failure(std::string place, std::string problem, std::string remedy) {
  return {Severity::Error, std::move(place), "file", std::move(problem), std::move(remedy)};
}

}  // namespace

Loaded<Model> load_geometry(const std::filesystem::path& file, const LoadOptions& options) {
  const std::string place = file.string();
  try {
    Loaded<std::string> bytes = read_file(file, kMaxBytes);
    if (!bytes.value) return {{}, std::move(bytes.notes)};
    Content content = read(format_of(file), *bytes.value);
    if (content.parts.empty()) {
      return {{}, {failure(place, "holds no triangle", "check that it holds a mesh")}};
    }
    Loaded<Model> loaded;
    add_notes(content, format_of(file) == "obj" ? UpAxis::Y : UpAxis::Z, place, loaded.notes);
    if (options.account != nullptr) add_account(content, place, *options.account);
    if (!options.geometry)
      loaded.notes.push_back({Severity::Note, place, "file", "meshes are not kept, as asked for", ""});
    loaded.value = model_of(std::move(content), file, options.geometry);
    return loaded;
  } catch (const geometry_loader::Damage& damage) {
    return {{},
            {failure(damage.line > 0 ? place + ':' + std::to_string(damage.line) : place, damage.problem,
                     "check that the file opens in the program that wrote it")}};
  } catch (const std::exception& e) {
    return {{}, {failure(place, std::string{"cannot be read: "} + e.what(), "")}};
  }
}

bool geometry_reads(const std::filesystem::path& file) {
  const std::string extension = lower_extension(file);
  return extension == ".obj" || extension == ".stl" || extension == ".ply";
}

}  // namespace pantin

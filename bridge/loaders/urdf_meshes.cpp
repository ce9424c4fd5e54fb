#include <pantin/bridge/loaders/urdf_meshes.hpp>

#include <exception>

#include <pantin/bridge/loaders/resolve_package.hpp>

namespace pantin::urdf_loader {

std::shared_ptr<const TriangleMesh> Meshes::find(const std::string& uri, int line,
                                                 const std::string& subject) {
  if (!options_.geometry || !options_.mesh_reader) {
    ledger_.alike(Severity::Note, "meshes not read",
                  {line, subject,
                   options_.geometry ? "meshes are not read: no reader for them is built in"
                                     : "meshes are not read, as asked for",
                   ""});
    return nullptr;
  }
  if (const auto known = by_uri_.find(uri); known != by_uri_.end() && known->second) return known->second;
  const ResolvedFile file = resolve_package(uri, model_, options_.package_paths);
  if (file.path.empty()) {
    const std::string looked = file.tried.empty() ? "" : "; looked for " + tried_text(file);
    const bool by_package = !file.package.empty();
    ledger_.alike(
        Severity::Warning, by_package ? "package " + file.package : "mesh file",
        {line, subject, "mesh '" + uri + "': " + file.problem + looked + "; dropped",
         by_package ? "give the folder that holds the package as a package path" : "check the path"});
    return nullptr;
  }
  return by_uri_[uri] = read(file.path, line, subject);
}

std::shared_ptr<const TriangleMesh> Meshes::read(const std::filesystem::path& file, int line,
                                                 const std::string& subject) {
  const auto [known, is_new] = by_path_.try_emplace(file);
  if (!is_new) return known->second;
  Loaded<std::shared_ptr<const TriangleMesh>> mesh;
  try {
    mesh = options_.mesh_reader(file);
  } catch (const std::exception& e) {
    mesh.notes.push_back({Severity::Error, file.string(), "file", e.what(), ""});
  }
  for (const Diagnostic& note : mesh.notes) {
    const bool lost = note.severity == Severity::Error;
    ledger_.alike(lost ? Severity::Warning : note.severity, "mesh " + note.subject,
                  {line, subject, "mesh '" + file.string() + "': " + note.problem + (lost ? "; dropped" : ""),
                   note.remedy});
  }
  if (mesh.value && !has_error(mesh.notes)) known->second = *mesh.value;
  return known->second;
}

}  // namespace pantin::urdf_loader

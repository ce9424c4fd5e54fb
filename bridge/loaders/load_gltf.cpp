#include <pantin/bridge/loaders/load_gltf.hpp>

#include <exception>

#include "gltf_account.hpp"
#include "gltf_animations.hpp"
#include "gltf_inventory.hpp"
#include "gltf_meshes.hpp"
#include "gltf_motion.hpp"

namespace pantin {
namespace {

Model read_model(const std::filesystem::path& file, const LoadOptions& options, gltf::Report& report) {
  const gltf::Document document{file, report};
  Model model{.name = file.stem().string(),
              .format = document.container().binary ? "glb" : "gltf",
              .up_axis = UpAxis::Y};
  const gltf::SceneNodes nodes = gltf::read_nodes(document, model);
  gltf::Accessors accessors{document};
  if (options.geometry) gltf::read_meshes(document, nodes, accessors, model);
  gltf::read_animations(document, nodes, accessors, model);
  accessors.buffers().note_unused();
  gltf::note_physics_lists(document);
  gltf::take_inventory(document);
  gltf::settle(document, report.has_errors() ? nullptr : options.account);
  return model;
}

}  // namespace

Loaded<Model> load_gltf(const std::filesystem::path& file, const LoadOptions& options) {
  gltf::Report report{file.string()};
  Loaded<Model> loaded;
  std::string failure;
  try {
    loaded.value = read_model(file, options, report);
  } catch (const gltf::Refused&) {  // told of in the report
  } catch (const std::exception& exception) {
    failure = exception.what();  // out of memory, or the file system
  }
  if (report.has_errors()) loaded.value.reset();
  loaded.notes = report.take();
  if (!failure.empty()) {
    loaded.value.reset();
    loaded.notes.push_back({Severity::Error, file.string(), "file", "it cannot be read: " + failure,
                            "check its size and the folder it is in"});
  }
  return loaded;
}

}  // namespace pantin

#pragma once
// Reads a model file of any known format. To add a loader: write load_<format>.{hpp,cpp} and one line in the
// list in load_model.cpp.
#include <filesystem>
#include <functional>
#include <memory>
#include <vector>

#include <pantin/bridge/account.hpp>
#include <pantin/bridge/diagnostic.hpp>
#include <pantin/bridge/loaders/import_settings.hpp>
#include <pantin/bridge/model.hpp>

namespace pantin {

/// Reads one mesh file, as load_mesh does.
using MeshReader = std::function<Loaded<std::shared_ptr<const TriangleMesh>>(const std::filesystem::path&)>;

struct LoadOptions {
  std::vector<std::filesystem::path> package_paths{};  ///< searched first for package:// (URDF)
  bool geometry{true};        ///< read mesh files and mesh data; false = hierarchy only
  MeshReader mesh_reader{};   ///< for mesh files that a model names (URDF); empty = load_model
                              ///< puts load_mesh here, others read none
  ImportSettings import{};    ///< of formats that are parsed in a process of their own
  Account* account{nullptr};  ///< gets an entry for every element and attribute of the file, and of mesh
                              ///< files that it names; null = none is kept
};

/// The format is chosen by file name extension, else by content. Never throws and never aborts for bad input:
/// a file that cannot be used gives no value and at least one error in the notes.
[[nodiscard]] Loaded<Model> load_model(const std::filesystem::path& file, const LoadOptions& options = {});

}  // namespace pantin

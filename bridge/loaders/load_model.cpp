#include <pantin/bridge/loaders/load_model.hpp>

#include <algorithm>
#include <array>
#include <exception>
#include <fstream>
#include <string>
#include <string_view>

#include <pantin/bridge/input_file.hpp>
#include <pantin/bridge/loaders/load_geometry.hpp>
#include <pantin/bridge/loaders/load_mesh.hpp>
#ifdef PANTIN_HAS_LOAD_ASSIMP
#include <pantin/bridge/loaders/load_assimp.hpp>
#endif
#ifdef PANTIN_HAS_LOAD_GLTF
#include <pantin/bridge/loaders/load_gltf.hpp>
#endif
#ifdef PANTIN_HAS_LOAD_URDF
#include <pantin/bridge/loaders/load_urdf.hpp>
#endif

namespace pantin {
namespace {

constexpr std::uintmax_t kMaxBytes = std::uintmax_t{2} << 30;  ///< of any model file

/// How a file looks: its extension in lower case and its first bytes.
struct Look {
  std::string extension;
  std::string head;
};

/// One known format: how to recognise it and, where its component is linked, how to read it.
struct Loader {
  std::string_view component;
  bool (*by_extension)(const std::filesystem::path& file, const Look& look);
  bool (*by_content)(const Look& look);
  Loaded<Model> (*load)(const std::filesystem::path& file, const LoadOptions& options);  ///< null: not linked
};

Loaded<Model> failure(const std::filesystem::path& file, std::string problem, std::string remedy) {
  return {{}, {{Severity::Error, file.string(), "file", std::move(problem), std::move(remedy)}}};
}

#ifdef PANTIN_HAS_LOAD_URDF
Loaded<Model> load_urdf_with_meshes(const std::filesystem::path& file, const LoadOptions& options) {
  LoadOptions complete = options;
  if (!complete.mesh_reader)
    complete.mesh_reader = [&options](const std::filesystem::path& mesh) { return load_mesh(mesh, options); };
  return load_urdf(file, complete);
}
constexpr auto kLoadUrdf = &load_urdf_with_meshes;
#else
constexpr auto kLoadUrdf = nullptr;
#endif
#ifdef PANTIN_HAS_LOAD_GLTF
constexpr auto kLoadGltf = &load_gltf;
#else
constexpr auto kLoadGltf = nullptr;
#endif
#ifdef PANTIN_HAS_LOAD_ASSIMP
constexpr auto kLoadAssimp = &load_assimp;
bool foreign(const std::filesystem::path& file, const Look&) { return assimp_reads(file); }
#else
constexpr auto kLoadAssimp = nullptr;
bool foreign(const std::filesystem::path&, const Look&) { return false; }
#endif

Loaded<Model> refuse_xacro(const std::filesystem::path& file, const LoadOptions&) {
  return failure(file, "is a xacro file, not a robot description yet",
                 "expand it first: xacro FILE > robot.urdf");
}

/// All loaders, in the order in which they are asked. A new one is a line here.
constexpr std::array kLoaders{
    Loader{"load-urdf", [](const auto&, const Look& look) { return look.extension == ".urdf"; },
           [](const Look& look) { return look.head.find("<robot") != std::string::npos; }, kLoadUrdf},
    Loader{"load-urdf", [](const auto&, const Look& look) { return look.extension == ".xacro"; },
           [](const Look&) { return false; }, &refuse_xacro},
    Loader{
        "load-gltf",
        [](const auto&, const Look& look) { return look.extension == ".gltf" || look.extension == ".glb"; },
        [](const Look& look) {
          return look.head.starts_with("glTF") ||
                 (look.head.find_first_not_of(" \t\r\n") == look.head.find('{') &&
                  look.head.find('{') != std::string::npos &&
                  look.head.find("\"asset\"") != std::string::npos);
        },
        kLoadGltf},
    Loader{
        "load-geometry", [](const auto& file, const Look&) { return geometry_reads(file); },
        [](const Look& look) { return look.head.starts_with("ply\n") || look.head.starts_with("ply\r\n"); },
        &load_geometry},
    Loader{"load-assimp", &foreign, [](const Look&) { return true; }, kLoadAssimp},
};

Look look_at(const std::filesystem::path& file) {
  Look look{.extension = lower_extension(file), .head = std::string(4096, '\0')};
  std::ifstream stream{file, std::ios::binary};
  stream.read(look.head.data(), static_cast<std::streamsize>(look.head.size()));
  look.head.resize(static_cast<std::size_t>(std::max<std::streamsize>(stream.gcount(), 0)));
  return look;
}

/// The loader for a file: by its extension, else by its first bytes; the last one takes what no other does.
const Loader& loader_for(const std::filesystem::path& file) {
  const Look look = look_at(file);
  for (const Loader& loader : kLoaders) {
    if (loader.by_extension(file, look)) return loader;
  }
  return *std::find_if(kLoaders.begin(), kLoaders.end(), [&](const Loader& l) { return l.by_content(look); });
}

}  // namespace

Loaded<Model> load_model(const std::filesystem::path& file, const LoadOptions& options) {
  try {
    if (auto problem = problem_with_file(file, kMaxBytes)) return {{}, {*std::move(problem)}};
    const Loader& loader = loader_for(file);
    if (loader.load == nullptr) {
      return failure(file, "needs component " + std::string{loader.component} + ", which is not built in",
                     "build Pantin with it, or convert the file");
    }
    const std::size_t before = options.account != nullptr ? options.account->size() : 0;
    Loaded<Model> loaded = loader.load(file, options);
    if (has_error(loaded.notes)) loaded.value.reset();
    if (!loaded.value && options.account != nullptr) options.account->resize(before);
    return loaded;
  } catch (const std::exception& e) {
    return failure(file, std::string{"cannot be read: "} + e.what(), "");
  }
}

}  // namespace pantin

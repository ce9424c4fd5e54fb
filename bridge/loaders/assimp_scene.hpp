#pragma once
// One file read by assimp: the scene, what physics does not need counted and removed, and the frame and unit
// of the file told apart from its content.
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <pantin/bridge/diagnostic.hpp>
#include <pantin/bridge/model.hpp>

struct aiScene;
namespace Assimp {
class Importer;
}

namespace pantin::assimp_loader {

/// Up axis and unit of a file, and what of them assimp had worked into the top node.
struct FileFrame {
  UpAxis up_axis{UpAxis::Y};
  double unit_m{1};       ///< metres per unit of the file
  bool states_up{false};  ///< the format says it; else the customary one was taken
  bool states_unit{false};
  bool top_is_correction{false};  ///< the top node's matrix is nothing but a turn and a scale made by assimp
};

/// What a scene held beside hierarchy, triangles and animation.
struct LeftOut {
  std::string text{};  ///< "3 materials, 1 camera"; empty if nothing
};

struct ReadScene {
  std::shared_ptr<Assimp::Importer> importer{};  ///< owns the scene
  const aiScene* scene{nullptr};                 ///< null where reading failed
  std::string extension{};                       ///< lower case, without the point
  FileFrame frame{};
  LeftOut left_out{};
  std::vector<Diagnostic> notes{};  ///< an error where reading failed
};

/// Reads a file. Polygons become triangles and equal vertices one where `geometry` is wanted. Exceptions of
/// assimp end here; its crashes do not.
[[nodiscard]] ReadScene read_scene(const std::filesystem::path& file, bool geometry);

}  // namespace pantin::assimp_loader

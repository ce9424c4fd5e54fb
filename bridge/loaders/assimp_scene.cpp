#include <pantin/bridge/loaders/assimp_scene.hpp>

#include <assimp/config.h>
#include <assimp/importerdesc.h>
#include <assimp/material.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <algorithm>
#include <assimp/Importer.hpp>
#include <exception>

#include <pantin/bridge/input_file.hpp>
#include <pantin/bridge/loaders/assimp_frame.hpp>

namespace pantin::assimp_loader {
namespace {

constexpr std::uintmax_t kMaxBytes = std::uintmax_t{2} << 30;

/// What physics does not need (materials, textures, normals, colours, bones' weights, cameras, lights).
constexpr int kNotNeeded = aiComponent_NORMALS | aiComponent_TANGENTS_AND_BITANGENTS | aiComponent_COLORS |
                           aiComponent_TEXCOORDS | aiComponent_BONEWEIGHTS | aiComponent_TEXTURES |
                           aiComponent_LIGHTS | aiComponent_CAMERAS | aiComponent_MATERIALS;

void count(std::string& text, std::size_t number, const char* what) {
  if (number == 0) return;
  text += (text.empty() ? "" : ", ") + std::to_string(number) + ' ' + what + (number == 1 ? "" : "s");
}

/// What programs wrote beside nodes, loops instead of recursion. What concerns the file as a whole is
/// assimp's own or was read into the frame.
std::size_t metadata_of(const aiScene& scene) {
  std::size_t pieces = 0;
  std::vector<const aiNode*> open{scene.mRootNode};
  while (!open.empty()) {
    const aiNode* node = open.back();
    open.pop_back();
    if (node->mMetaData != nullptr) pieces += node->mMetaData->mNumProperties;
    open.insert(open.end(), node->mChildren, node->mChildren + node->mNumChildren);
  }
  return pieces;
}

LeftOut left_out_of(const aiScene& scene) {
  std::size_t materials = 0;
  for (unsigned i = 0; i < scene.mNumMaterials; ++i) {
    aiString name;
    scene.mMaterials[i]->Get(AI_MATKEY_NAME, name);
    if (name.length > 0 && name != aiString{AI_DEFAULT_MATERIAL_NAME}) ++materials;  // assimp adds such
  }
  std::size_t bones = 0;
  std::size_t targets = 0;
  std::size_t looks = 0;
  for (unsigned i = 0; i < scene.mNumMeshes; ++i) {
    bones += scene.mMeshes[i]->mNumBones;
    targets += scene.mMeshes[i]->mNumAnimMeshes;
    const aiMesh& mesh = *scene.mMeshes[i];
    looks += std::size_t{mesh.HasNormals()} + mesh.HasTangentsAndBitangents() + mesh.GetNumUVChannels() +
             mesh.GetNumColorChannels();
  }
  LeftOut left_out;
  count(left_out.text, materials, "material");
  count(left_out.text, scene.mNumTextures, "texture");
  count(left_out.text, scene.mNumCameras, "camera");
  count(left_out.text, scene.mNumLights, "light");
  count(left_out.text, bones, "bone weighting");
  count(left_out.text, targets, "morph target");
  count(left_out.text, looks, "vertex attribute");
  count(left_out.text, metadata_of(scene), "metadata value");
  return left_out;
}

/// Extension of the file, or the first one of the importer that recognised its content.
std::string extension_of(const std::filesystem::path& file, const Assimp::Importer& importer) {
  std::string extension = lower_extension(file);
  if (extension.size() < 2) {
    const int index = importer.GetPropertyInteger("importerIndex", -1);
    const aiImporterDesc* about =
        index >= 0 ? importer.GetImporterInfo(static_cast<std::size_t>(index)) : nullptr;
    const std::string all = about != nullptr ? about->mFileExtensions : "unknown";
    extension = '.' + all.substr(0, all.find(' '));
  }
  return extension.substr(1);
}

void fail(ReadScene& read, const std::filesystem::path& file, std::string why) {
  read.scene = nullptr;
  std::replace(why.begin(), why.end(), '\n', ' ');
  read.notes.push_back({Severity::Error, file.string(), "file", "cannot be read by assimp: " + why,
                        "check that the file opens in the program that wrote it"});
}

}  // namespace

ReadScene read_scene(const std::filesystem::path& file, bool geometry) {
  ReadScene read;
  if (auto problem = problem_with_file(file, kMaxBytes)) {
    read.notes.push_back(*std::move(problem));
    return read;
  }
  try {
    read.importer = std::make_shared<Assimp::Importer>();
    Assimp::Importer& importer = *read.importer;
    importer.SetPropertyBool(AI_CONFIG_IMPORT_FBX_PRESERVE_PIVOTS, false);  // no $AssimpFbx$ nodes
    importer.SetPropertyBool(AI_CONFIG_IMPORT_NO_SKELETON_MESHES,
                             true);  // made up by assimp where a file has none
    importer.SetPropertyInteger(AI_CONFIG_PP_RVC_FLAGS, kNotNeeded);
    read.scene = importer.ReadFile(file.string(), 0);
    if (read.scene == nullptr || read.scene->mRootNode == nullptr) {
      fail(read, file, read.scene == nullptr ? importer.GetErrorString() : "it has no top node");
      return read;
    }
    read.extension = extension_of(file, importer);
    read.left_out = left_out_of(*read.scene);
    read.frame = frame_of(*read.scene, read.extension);
    // Normals and the like go before equal vertices are joined, or they would keep them apart.
    if (geometry) {
      read.scene = importer.ApplyPostProcessing(aiProcess_RemoveComponent | aiProcess_Triangulate |
                                                aiProcess_JoinIdenticalVertices);
      if (read.scene == nullptr) fail(read, file, importer.GetErrorString());
    }
  } catch (const std::exception& e) {
    fail(read, file, e.what());
  } catch (...) {
    fail(read, file, "an exception of unknown type");
  }
  return read;
}

}  // namespace pantin::assimp_loader

#pragma once
// The mesh files that a robot names, each read once.
#include <filesystem>
#include <map>
#include <memory>
#include <string>

#include <pantin/bridge/loaders/load_model.hpp>
#include <pantin/bridge/loaders/urdf_ledger.hpp>

namespace pantin::urdf_loader {

class Meshes {
 public:
  /// `model` is the robot's file, which relative names start from.
  Meshes(std::filesystem::path model, const LoadOptions& options, Ledger& ledger)
      : model_{std::move(model)}, options_{options}, ledger_{ledger} {}

  /// The mesh called `uri` in the robot's file; null with a finding about `subject` where it cannot be had.
  [[nodiscard]] std::shared_ptr<const TriangleMesh> find(const std::string& uri, int line,
                                                         const std::string& subject);

 private:
  [[nodiscard]] std::shared_ptr<const TriangleMesh> read(const std::filesystem::path& file, int line,
                                                         const std::string& subject);

  std::filesystem::path model_;
  const LoadOptions& options_;
  Ledger& ledger_;
  std::map<std::string, std::shared_ptr<const TriangleMesh>> by_uri_{};
  std::map<std::filesystem::path, std::shared_ptr<const TriangleMesh>> by_path_{};
};

}  // namespace pantin::urdf_loader

#pragma once
// The outermost layer of a glTF model: the bytes of the file, either JSON text or a GLB that wraps JSON text
// and one binary buffer. glTF 2.0 chapter 4, "GLB File Format".
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>

#include "gltf_report.hpp"

namespace pantin::gltf {

/// Where something lies in the bytes of a file.
struct ByteRange {
  std::size_t offset{0};
  std::size_t size{0};
};

struct Container {
  std::string bytes{};  ///< the whole file
  bool binary{false};   ///< GLB
  ByteRange json{};
  std::optional<ByteRange> buffer{};  ///< the BIN chunk, with its padding
};

/// Reads a .gltf or .glb; which of them it is the first bytes say. Refuses what cannot be read.
[[nodiscard]] Container read_container(const std::filesystem::path& file, Report& report);

}  // namespace pantin::gltf

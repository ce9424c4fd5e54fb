#pragma once
// Small glTF files for tests: numbers are packed by hand here, independently of the loader that reads them.
#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include <pantin/bridge/loaders/load_gltf.hpp>

#include "support/temporary_folder.hpp"

namespace pantin::test {

/// The numbers as bytes, in their own type.
template <class T>
std::string packed(const std::vector<T>& numbers) {
  return {reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(T)};
}

/// RFC 4648, section 4.
inline std::string base64(const std::string& bytes) {
  const std::string alphabet = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t bits = 0;
    for (std::size_t k = 0; k < 3; ++k)
      bits = bits << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0U);
    for (std::size_t k = 0; k < 4; ++k)
      text += i + k <= bytes.size() ? alphabet[bits >> (18 - 6 * k) & 63U] : '=';
  }
  return text;
}

inline std::string word(std::uint32_t value) { return packed<std::uint32_t>({value}); }

/// One chunk of a GLB, padded.
inline std::string chunk(const std::string& type, std::string data) {
  data.resize((data.size() + 3) / 4 * 4, type == "JSON" ? ' ' : '\0');
  return word(static_cast<std::uint32_t>(data.size())) + type + data;
}

inline std::string glb(const std::string& chunks) {
  return "glTF" + word(2) + word(static_cast<std::uint32_t>(12 + chunks.size())) + chunks;
}

/// Gathers the bytes of accessors and writes the document around them.
class GltfText {
 public:
  /// A view of its own for these bytes; `members` as ", \"byteStride\": 16", say.
  std::size_t view(const std::string& bytes, const std::string& members = "") {
    views_ += (views_.empty() ? "" : ", ") +
              ("{\"buffer\": 0, \"byteOffset\": " + std::to_string(bytes_.size())) +
              ", \"byteLength\": " + std::to_string(bytes.size()) + members + "}";
    bytes_ += bytes;
    bytes_.resize((bytes_.size() + 3) / 4 * 4, '\0');
    return view_count_++;
  }
  std::size_t accessor(const std::string& members) {
    accessors_ += (accessors_.empty() ? "{" : ", {") + members + "}";
    return accessor_count_++;
  }
  /// A tightly packed accessor in a view of its own.
  std::size_t accessor(const std::string& bytes, int component_type, const std::string& type,
                       std::size_t count, const std::string& members = "") {
    return accessor("\"bufferView\": " + std::to_string(view(bytes)) +
                    ", \"componentType\": " + std::to_string(component_type) + ", \"type\": \"" + type +
                    "\", \"count\": " + std::to_string(count) + members);
  }
  std::size_t floats(const std::vector<float>& numbers, const std::string& type) {
    const std::size_t width = type == "SCALAR" ? 1 : type == "VEC3" ? 3 : 4;
    return accessor(packed(numbers), 5126, type, numbers.size() / width);
  }

  [[nodiscard]] const std::string& bytes() const { return bytes_; }
  /// `content` as "\"nodes\": [{}]"; `uri` as "\"uri\": \"a.bin\", " or empty for the chunk of a GLB.
  [[nodiscard]] std::string document(const std::string& content, const std::string& uri) const {
    std::string text = "{\"asset\": {\"version\": \"2.0\"}, " + content;
    if (accessor_count_ > 0) text += ", \"accessors\": [" + accessors_ + "]";
    if (view_count_ > 0)
      text += ", \"bufferViews\": [" + views_ + "], \"buffers\": [{" + uri +
              "\"byteLength\": " + std::to_string(bytes_.size()) + "}]";
    return text + "}";
  }
  [[nodiscard]] std::string embedded(const std::string& content) const {
    return document(content, "\"uri\": \"data:application/octet-stream;base64," + base64(bytes_) + "\", ");
  }

 private:
  std::string bytes_, views_, accessors_;
  std::size_t view_count_{0}, accessor_count_{0};
};

inline Loaded<Model> load_text(const std::string& text, const LoadOptions& options = {}) {
  const TemporaryFolder folder;
  return load_gltf(folder.write("model.gltf", text), options);
}

/// The whole ledger, one finding a line, file names reduced to their last part.
inline std::string ledger(const Loaded<Model>& loaded) {
  std::string text;
  for (Diagnostic finding : loaded.notes) {
    const std::size_t file_end = finding.place.find('#');
    const std::size_t slash = finding.place.substr(0, file_end).rfind('/');
    if (slash != std::string::npos) finding.place.erase(0, slash + 1);
    text += to_string(finding) + '\n';
  }
  return text;
}

/// The model, which must have loaded with nothing to say but what glTF knows and physics does not need.
inline Model sound(Loaded<Model> loaded) {
  std::erase_if(loaded.notes, [](const Diagnostic& note) {
    return note.severity == Severity::Note &&
           note.problem.starts_with("not needed for physics and dropped: ");
  });
  EXPECT_EQ(ledger(loaded), "");
  EXPECT_TRUE(loaded.value.has_value());
  return loaded.value.value_or(Model{});
}

}  // namespace pantin::test

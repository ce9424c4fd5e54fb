#pragma once
// The bytes of a document's buffers, read when first asked for: a buffer that only textures use is never
// touched.
#include <span>

#include "gltf_document.hpp"

namespace pantin::gltf {

class Buffers {
 public:
  explicit Buffers(const Document& document);

  /// The bytes of a view, all of them in its buffer. Refuses views and buffers that cannot be had.
  [[nodiscard]] std::span<const char> bytes_of(const JsonValue& view);
  /// Notes parts of the document's own binary data that no buffer uses.
  void note_unused() const;

 private:
  struct Buffer {
    enum class State { Unread, Read, Refused } state{State::Unread};
    std::string owned{};
    std::span<const char> bytes{};
  };
  std::span<const char> buffer(std::size_t i);
  void read(const JsonValue& item, std::size_t i, Buffer& buffer);
  [[nodiscard]] std::string read_uri(const JsonValue& uri);

  const Document& document_;
  Report& report_;
  std::vector<Buffer> buffers_;
  std::uint64_t read_{0};  // bytes of files
};

}  // namespace pantin::gltf

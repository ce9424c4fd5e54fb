#include "gltf_buffers.hpp"

#include <pantin/bridge/input_file.hpp>

#include "gltf_uri.hpp"

namespace pantin::gltf {
namespace {

constexpr std::uint64_t kGreatestBuffer = std::uint64_t{1} << 32;  // all files of a model together as well

}  // namespace

Buffers::Buffers(const Document& document)
    : document_{document}, report_{document.report()}, buffers_(document.count(Collection::Buffers)) {}

std::span<const char> Buffers::bytes_of(const JsonValue& view) {
  const std::size_t i = document_.index(require(report_, view, "buffer"), Collection::Buffers);
  const std::uint64_t offset = size_or(report_, view, "byteOffset", 0);
  const JsonValue length_value = require(report_, view, "byteLength");
  const std::uint64_t length = to_size(report_, length_value);
  const std::span<const char> bytes = buffer(i);
  if (offset > bytes.size() || length > bytes.size() - offset)
    report_.refuse(view,
                   "its bytes " + std::to_string(offset) + " to " + std::to_string(offset + length) +
                       " leave buffer " + std::to_string(i) + " of " + std::to_string(bytes.size()),
                   "export the model again");
  return bytes.subspan(static_cast<std::size_t>(offset), static_cast<std::size_t>(length));
}

std::span<const char> Buffers::buffer(std::size_t i) {
  Buffer& buffer = buffers_.at(i);
  if (buffer.state == Buffer::State::Unread) {
    buffer.state = Buffer::State::Refused;
    read(document_.item(Collection::Buffers, i), i, buffer);
    buffer.state = Buffer::State::Read;
  }
  if (buffer.state == Buffer::State::Refused) throw Refused{};  // told of when it was first asked for
  return buffer.bytes;
}

void Buffers::read(const JsonValue& item, std::size_t i, Buffer& buffer) {
  const JsonValue length_value = require(report_, item, "byteLength");
  const std::uint64_t length = to_size(report_, length_value);
  if (length < 1 || length > kGreatestBuffer)
    report_.refuse(length_value, "the buffer has " + std::to_string(length) + " bytes",
                   "write its true length, 1 to 2^32");
  const Container& container = document_.container();
  if (const std::optional<JsonValue> uri = member(report_, item, "uri", JsonKind::Text)) {
    buffer.owned = read_uri(*uri);
    if (buffer.owned.size() > length) {
      buffer.owned.resize(static_cast<std::size_t>(length));
      buffer.owned.shrink_to_fit();
    }
    buffer.bytes = buffer.owned;
  } else if (i == 0 && container.buffer) {
    buffer.bytes = std::span{container.bytes}.subspan(container.buffer->offset, container.buffer->size);
  } else {
    report_.refuse(item, "it has no uri and is not the binary chunk of a GLB", "give it a uri");
  }
  if (buffer.bytes.size() < length)
    report_.refuse(length_value,
                   "the buffer should have " + std::to_string(length) + " bytes, its data has " +
                       std::to_string(buffer.bytes.size()),
                   "export or copy the model again");
  buffer.bytes = buffer.bytes.first(static_cast<std::size_t>(length));
}

std::string Buffers::read_uri(const JsonValue& uri) {
  const std::string scheme = scheme_of(uri.text());
  std::string problem;
  if (scheme == "data") {
    std::optional<std::string> data = decode_data_uri(uri.text(), problem);
    if (!data) report_.refuse(uri, problem, "write data:application/octet-stream;base64,...");
    return std::move(*data);
  }
  if (!scheme.empty())
    report_.refuse(uri, "its uri has the scheme '" + shortened(scheme) + "', which is not read",
                   "download the buffer into the model's folder");
  const std::optional<std::filesystem::path> path =
      resolve_in_folder(uri.text(), document_.folder(), problem);
  if (!path)
    report_.refuse(uri, problem + ": '" + shortened(uri.text()) + "'",
                   "put the buffer beside the model and name it relative to it");
  Loaded<std::string> bytes = read_file(*path, kGreatestBuffer - read_);
  if (!bytes.value) {
    const Diagnostic& reason = bytes.notes.front();
    report_.refuse(uri, "buffer file '" + shortened(uri.text()) + "': " + reason.problem, reason.remedy);
  }
  read_ += bytes.value->size();
  return std::move(*bytes.value);
}

void Buffers::note_unused() const {
  const Container& container = document_.container();
  if (!container.buffer) return;
  const bool has_buffer = document_.count(Collection::Buffers) > 0;
  if (has_buffer && !document_.item(Collection::Buffers, 0).find("uri")) return;
  report_.mention(Severity::Warning, "file",
                  "the binary chunk of the GLB belongs to no buffer and is not read",
                  "leave 'uri' out of buffer 0");
}

}  // namespace pantin::gltf

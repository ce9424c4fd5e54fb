#include "gltf_container.hpp"

#include <bit>
#include <cstring>

#include <pantin/bridge/input_file.hpp>

namespace pantin::gltf {
namespace {

static_assert(std::endian::native == std::endian::little, "glTF is little-endian and is copied as it lies");

constexpr std::uintmax_t kGreatestFile = 0xFFFFFFFFU;        // GLB counts its bytes in 32 bits
constexpr std::size_t kGreatestJson = std::size_t{1} << 28;  // bounds the memory that the parsed text takes
constexpr std::uint32_t kMagic = 0x46546C67U;                // "glTF"
constexpr std::uint32_t kJsonChunk = 0x4E4F534AU;            // "JSON"
constexpr std::uint32_t kBinaryChunk = 0x004E4942U;          // "BIN"
constexpr std::size_t kHeaderSize = 12;
constexpr std::size_t kChunkHeaderSize = 8;

std::uint32_t word_at(const std::string& bytes, std::size_t offset) {
  std::uint32_t word = 0;
  std::memcpy(&word, bytes.data() + offset, sizeof word);
  return word;
}

bool is_glb(const std::string& bytes) { return bytes.size() >= sizeof kMagic && word_at(bytes, 0) == kMagic; }

/// The end of the GLB as its header says.
std::size_t check_header(const std::string& bytes, Report& report) {
  if (bytes.size() < kHeaderSize + kChunkHeaderSize)
    report.refuse_file("the GLB ends after " + std::to_string(bytes.size()) + " bytes, within its header",
                       "export or copy it again");
  const std::uint32_t version = word_at(bytes, 4);
  if (version != 2)
    report.refuse_file("the GLB is of version " + std::to_string(version) + "; only version 2 is read",
                       "export it as glTF 2.0");
  const std::size_t length = word_at(bytes, 8);
  if (length > bytes.size() || length < kHeaderSize + kChunkHeaderSize)
    report.refuse_file("the GLB header says " + std::to_string(length) + " bytes, the file has " +
                           std::to_string(bytes.size()),
                       "export or copy it again");
  if (length < bytes.size())
    report.mention(Severity::Warning, "file",
                   std::to_string(bytes.size() - length) + " bytes after the end of the GLB are not read",
                   "export it again");
  return length;
}

void note_chunk(std::uint32_t type, std::size_t offset, Report& report) {
  if (type == kJsonChunk || type == kBinaryChunk)
    report.mention(Severity::Warning, "file",
                   "a second chunk of type " + std::string{type == kJsonChunk ? "JSON" : "BIN"} +
                       " at byte " + std::to_string(offset) + " is not read",
                   "export it again");
  else
    report.mention(Severity::Note, "file",
                   "the chunk of unknown type " + std::to_string(type) + " at byte " +
                       std::to_string(offset) + " is not read",
                   "");
}

void split_chunks(Container& container, Report& report) {
  const std::string& bytes = container.bytes;
  const std::size_t end = check_header(bytes, report);
  bool is_first = true;
  for (std::size_t offset = kHeaderSize; offset < end;) {
    if (end - offset < kChunkHeaderSize)
      report.refuse_file("the GLB ends within the header of the chunk at byte " + std::to_string(offset),
                         "export or copy it again");
    const std::size_t size = word_at(bytes, offset);
    const std::uint32_t type = word_at(bytes, offset + 4);
    const std::size_t start = offset + kChunkHeaderSize;
    if (size > end - start)
      report.refuse_file("the chunk at byte " + std::to_string(offset) + " says " + std::to_string(size) +
                             " bytes, " + std::to_string(end - start) + " are left",
                         "export or copy it again");
    if (is_first && type != kJsonChunk)
      report.refuse_file("the first chunk of the GLB is not JSON", "export it again");
    if (size % 4 != 0)
      report.mention(Severity::Warning, "file",
                     "the chunk at byte " + std::to_string(offset) + " is not padded to 4 bytes",
                     "export it again");
    if (is_first) container.json = {start, size};
    else if (type == kBinaryChunk && !container.buffer) container.buffer = ByteRange{start, size};
    else note_chunk(type, offset, report);
    is_first = false;
    offset = start + size;
  }
  // Some writers pad the text with zero bytes instead of blanks.
  while (container.json.size > 0 && bytes[container.json.offset + container.json.size - 1] == '\0')
    --container.json.size;
}

}  // namespace

Container read_container(const std::filesystem::path& file, Report& report) {
  Loaded<std::string> bytes = read_file(file, kGreatestFile);
  if (!bytes.value) report.refuse_with(std::move(bytes.notes.front()));
  Container container{.bytes = std::move(*bytes.value)};
  container.binary = is_glb(container.bytes);
  if (container.binary) {
    split_chunks(container, report);
  } else if (file.extension() == ".glb" && (container.bytes.empty() || container.bytes.front() != '{')) {
    report.refuse_file("it does not begin as a GLB does", "export or copy it again");
  } else {
    container.json = {0, container.bytes.size()};
  }
  if (container.json.size > kGreatestJson)
    report.refuse_file("its JSON has " + std::to_string(container.json.size) + " bytes, more than " +
                           std::to_string(kGreatestJson),
                       "move its data into a .bin file");
  return container;
}

}  // namespace pantin::gltf

#pragma once
// What a buffer's uri may be: data written into the uri itself, or a file in the model's folder. Anything
// else, and any path that leads out of that folder, is refused with the reason.
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace pantin::gltf {

/// The scheme of a URI in lower case ("data", "http"), empty for a relative reference. RFC 3986, 3.1.
[[nodiscard]] std::string scheme_of(std::string_view uri);

/// The bytes of a data: URI (RFC 2397), base64 (RFC 4648, 4: strict, with padding) or percent-encoded; or
/// nothing, and `problem` says why.
[[nodiscard]] std::optional<std::string> decode_data_uri(std::string_view uri, std::string& problem);

/// The text with %XX replaced by bytes; or nothing, and `problem` says why.
[[nodiscard]] std::optional<std::string> percent_decoded(std::string_view text, std::string& problem);

/// The file a relative uri means, symbolic links resolved, if it lies in `folder` or below it; or nothing,
/// and `problem` says why.
[[nodiscard]] std::optional<std::filesystem::path> resolve_in_folder(std::string_view uri,
                                                                     const std::filesystem::path& folder,
                                                                     std::string& problem);

}  // namespace pantin::gltf

#include "gltf_uri.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <system_error>

namespace pantin::gltf {
namespace {

bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }
bool is_digit(char c) { return c >= '0' && c <= '9'; }

int hex_digit(char c) {
  if (is_digit(c)) return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  return -1;
}

constexpr std::uint8_t kNoDigit = 0xFF;

constexpr std::array<std::uint8_t, 256> base64_digits() {
  constexpr std::string_view kAlphabet = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::array<std::uint8_t, 256> digits{};
  digits.fill(kNoDigit);
  for (std::size_t i = 0; i < kAlphabet.size(); ++i)
    digits[static_cast<unsigned char>(kAlphabet[i])] = static_cast<std::uint8_t>(i);
  return digits;
}

std::optional<std::string> decode_base64(std::string_view text, std::string& problem) {
  static constexpr std::array<std::uint8_t, 256> kDigits = base64_digits();
  if (text.size() % 4 != 0) {
    problem = "its base64 text has " + std::to_string(text.size()) + " characters, not a multiple of 4";
    return std::nullopt;
  }
  const std::size_t padding = text.ends_with("==") ? 2 : text.ends_with('=') ? 1 : 0;
  const std::string_view digits = text.substr(0, text.size() - padding);
  std::string bytes;
  bytes.reserve(text.size() / 4 * 3);
  std::uint32_t bits = 0;
  int held = 0;
  for (std::size_t i = 0; i < digits.size(); ++i) {
    const std::uint8_t digit = kDigits[static_cast<unsigned char>(digits[i])];
    if (digit == kNoDigit) {
      problem = "character " + std::to_string(i) + " of its base64 text is not one of base64";
      return std::nullopt;
    }
    bits = (bits << 6U) | digit;
    held += 6;
    if (held < 8) continue;
    held -= 8;
    bytes.push_back(static_cast<char>((bits >> static_cast<unsigned>(held)) & 0xFFU));
  }
  if ((bits & ((1U << static_cast<unsigned>(held)) - 1U)) != 0) {
    problem = "its base64 text ends within a byte";
    return std::nullopt;
  }
  return bytes;
}

/// Whether the path lies at or below the folder; both canonical.
bool is_within(const std::filesystem::path& path, const std::filesystem::path& folder) {
  const auto [in_folder, in_path] = std::mismatch(folder.begin(), folder.end(), path.begin(), path.end());
  return in_folder == folder.end();
}

}  // namespace

std::string scheme_of(std::string_view uri) {
  std::string scheme;
  for (const char c : uri) {
    if (c == ':') return scheme;
    const bool fits = is_letter(c) || (!scheme.empty() && (is_digit(c) || c == '+' || c == '-' || c == '.'));
    if (!fits) break;
    scheme += c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  }
  return {};
}

std::optional<std::string> decode_data_uri(std::string_view uri, std::string& problem) {
  const std::size_t colon = uri.find(':');
  const std::size_t comma = uri.find(',');
  if (comma == std::string_view::npos || comma < colon) {
    problem = "its data: uri has no comma before the data";
    return std::nullopt;
  }
  const std::string_view media_type = uri.substr(colon + 1, comma - colon - 1);
  const std::string_view data = uri.substr(comma + 1);
  if (media_type.ends_with(";base64")) return decode_base64(data, problem);
  const std::optional<std::string> decoded = percent_decoded(data, problem);
  if (!decoded) return std::nullopt;
  return decoded;
}

std::optional<std::string> percent_decoded(std::string_view text, std::string& problem) {
  std::string result;
  result.reserve(text.size());
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '%') {
      result += text[i];
      continue;
    }
    const int high = i + 2 < text.size() ? hex_digit(text[i + 1]) : -1;
    const int low = i + 2 < text.size() ? hex_digit(text[i + 2]) : -1;
    if (high < 0 || low < 0) {
      problem =
          "the % at character " + std::to_string(i) + " of its uri is not followed by two hexadecimal digits";
      return std::nullopt;
    }
    result += static_cast<char>(16 * high + low);
    i += 2;
  }
  return result;
}

std::optional<std::filesystem::path> resolve_in_folder(std::string_view uri,
                                                       const std::filesystem::path& folder,
                                                       std::string& problem) {
  const std::optional<std::string> decoded = percent_decoded(uri, problem);
  if (!decoded) return std::nullopt;
  if (decoded->empty() || decoded->find('\0') != std::string::npos) {
    problem = "its uri names no file";
    return std::nullopt;
  }
  const std::filesystem::path relative{*decoded};
  if (relative.is_absolute()) {
    problem = "its uri is an absolute path";
    return std::nullopt;
  }
  std::error_code error;
  const std::filesystem::path base = std::filesystem::canonical(folder, error);
  const std::filesystem::path path =
      error ? std::filesystem::path{} : std::filesystem::weakly_canonical(base / relative, error);
  if (error) {
    problem = "its uri cannot be resolved: " + error.message();
    return std::nullopt;
  }
  if (!is_within(path, base)) {
    problem = "its uri leads out of the model's folder";
    return std::nullopt;
  }
  return path;
}

}  // namespace pantin::gltf

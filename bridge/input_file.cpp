#include <pantin/bridge/input_file.hpp>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <system_error>

namespace pantin {
namespace {

Diagnostic file_error(const std::filesystem::path& file, std::string problem, std::string remedy) {
  return {Severity::Error, file.string(), "file", std::move(problem), std::move(remedy)};
}

Diagnostic too_large(const std::filesystem::path& file, std::uintmax_t max_bytes) {
  return file_error(file, "is larger than the " + std::to_string(max_bytes >> 20) + " MiB that are read",
                    "split the model or leave out what is not needed");
}

}  // namespace

std::optional<Diagnostic> problem_with_file(const std::filesystem::path& file, std::uintmax_t max_bytes) {
  std::error_code code;
  const std::filesystem::file_status status = std::filesystem::status(file, code);
  if (status.type() == std::filesystem::file_type::not_found) {
    return file_error(file, "does not exist", "check the path");
  }
  if (status.type() == std::filesystem::file_type::none) {
    return file_error(file, "cannot be examined: " + code.message(), "check the path and its permissions");
  }
  if (std::filesystem::is_directory(status)) {
    return file_error(file, "is a folder", "name the model file inside it");
  }
  if (!std::filesystem::is_regular_file(status)) {
    return file_error(file, "is not a regular file", "copy its content into a file");
  }
  const std::uintmax_t size = std::filesystem::file_size(file, code);
  if (code) return file_error(file, "cannot be examined: " + code.message(), "check its permissions");
  if (size == 0) return file_error(file, "is empty", "check that it was written completely");
  if (size > max_bytes) return too_large(file, max_bytes);
  return std::nullopt;
}

Loaded<std::string> read_file(const std::filesystem::path& file, std::uintmax_t max_bytes) {
  if (auto problem = problem_with_file(file, max_bytes)) return {{}, {*std::move(problem)}};
  errno = 0;
  std::ifstream stream{file, std::ios::binary};
  if (!stream) {
    const std::string why = errno != 0 ? std::strerror(errno) : "no reason given";
    return {{}, {file_error(file, "cannot be opened: " + why, "check its permissions")}};
  }
  std::error_code code;
  const std::uintmax_t size = std::filesystem::file_size(file, code);
  if (code) return {{}, {file_error(file, "cannot be examined: " + code.message(), "try again")}};
  if (size > max_bytes) return {{}, {too_large(file, max_bytes)}};  // grew meanwhile
  std::string text(static_cast<std::size_t>(size), '\0');
  stream.read(text.data(), static_cast<std::streamsize>(text.size()));
  text.resize(static_cast<std::size_t>(stream.gcount()));
  return {std::move(text), {}};
}

std::string lower_extension(const std::filesystem::path& file) {
  std::string extension = file.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  return extension;
}

}  // namespace pantin

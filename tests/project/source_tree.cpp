#include "source_tree.hpp"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <regex>
#include <sstream>

namespace pantin::test {
namespace fs = std::filesystem;

std::vector<SourceFile> files_in(const std::vector<std::string>& folders,
                                 const std::vector<std::string>& extensions) {
  const fs::path top{PANTIN_SOURCE_DIR};
  std::vector<SourceFile> files;
  for (const std::string& folder : folders) {
    if (!fs::exists(top / folder)) continue;
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator{top / folder}) {
      const bool wanted =
          std::find(extensions.begin(), extensions.end(), entry.path().extension()) != extensions.end();
      if (!wanted || !entry.is_regular_file()) continue;
      std::ifstream stream{entry.path(), std::ios::binary};
      files.push_back({fs::relative(entry.path(), top).generic_string(),
                       std::string{std::istreambuf_iterator<char>{stream}, {}}});
    }
  }
  std::sort(files.begin(), files.end(), [](const auto& a, const auto& b) { return a.path < b.path; });
  return files;
}

std::vector<std::string> lines_of(std::string_view text) {
  std::istringstream stream{std::string{text}};
  std::vector<std::string> lines;
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

std::vector<Include> includes_of(std::string_view text) {
  static const std::regex kInclude{R"(^\s*#\s*include\s*([<"])([^>"]+)[>"].*$)"};
  std::vector<Include> found;
  for (const std::string& line : lines_of(text)) {
    std::smatch match;
    if (std::regex_match(line, match, kInclude)) found.push_back({match[2], match[1] == "\""});
  }
  return found;
}

std::vector<std::string> conditions_of(std::string_view text) {
  static const std::regex kCondition{R"(^\s*#\s*(if|ifdef|ifndef|elif)\b.*$)"};
  std::vector<std::string> found;
  for (const std::string& line : lines_of(text)) {
    if (std::regex_match(line, kCondition)) found.push_back(line);
  }
  return found;
}

namespace {

bool any_prefix(const std::string& name, std::initializer_list<const char*> prefixes) {
  return std::any_of(prefixes.begin(), prefixes.end(),
                     [&](const char* prefix) { return name.starts_with(prefix); });
}

/// <vector>, <cmath>: the names of the standard library have neither a folder nor an ending; <immintrin.h>
/// and its like come with the compiler.
bool is_standard(const std::string& name) {
  return name.find_first_of("/.") == std::string::npos || name.ends_with("intrin.h");
}

std::optional<std::string> broken_core_rule(const std::string& module, const Include& include) {
  const std::string& name = include.name;
  if (include.quoted) {
    if (name.find("..") == std::string::npos && !name.starts_with("pantin/")) return std::nullopt;
    return module + " includes its own headers by name or as <pantin/...>";
  }
  if (is_standard(name) || name.starts_with("Eigen/") || name.starts_with("pantin/" + module + '/'))
    return std::nullopt;
  return module + " includes only std, Eigen and itself";
}

}  // namespace

std::optional<std::string> broken_rule(const std::string& path, const Include& include) {
  const std::string& name = include.name;
  const bool source = path.ends_with(".cpp");
  if (name.starts_with("fcl/")) {
    if (path.starts_with("physics/collision/fcl_") && source) return std::nullopt;
    return "only physics/collision/fcl_*.cpp includes FCL";
  }
  for (const char* module : {"scenegraph", "physics"}) {
    if (path.starts_with(std::string{module} + '/')) return broken_core_rule(module, include);
  }
  if (!path.starts_with("bridge/")) return std::nullopt;  // tests may include what they like
  if (any_prefix(name, {"assimp/", "urdf_parser/", "urdf_model/", "urdf_world/", "urdf_sensor/", "tinyxml",
                        "console_bridge/"}) &&
      !(source && path.starts_with("bridge/loaders/"))) {
    return "assimp, urdfdom and tinyxml2 stay in bridge/loaders/*.cpp";
  }
  if (name.starts_with("nlohmann/") &&
      !(source && any_prefix(path, {"bridge/loaders/", "bridge/writers/", "bridge/problems/"}))) {
    return "nlohmann-json stays in .cpp files of bridge/loaders, bridge/writers and bridge/problems";
  }
  if (name.starts_with("CLI/") && !path.starts_with("bridge/cli/")) return "CLI11 stays in bridge/cli";
  if (name.starts_with("pantin/bridge/cli/") && !path.starts_with("bridge/cli/")) {
    return "nothing includes the program";
  }
  if (any_prefix(name, {"gtest/", "gmock/"})) return "GoogleTest stays in tests";
  return std::nullopt;
}

}  // namespace pantin::test

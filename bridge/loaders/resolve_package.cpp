#include <pantin/bridge/loaders/resolve_package.hpp>

#include <tinyxml2.h>

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <exception>
#include <system_error>

namespace pantin {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kPackage = "package://";
constexpr std::string_view kFile = "file://";

bool is_file(const fs::path& path) {
  std::error_code ignored;
  return fs::is_regular_file(path, ignored);
}

std::string percent_decoded(std::string_view text) {
  std::string out;
  for (std::size_t i = 0; i < text.size(); ++i) {
    unsigned code = 0;
    if (text[i] == '%' && i + 2 < text.size() &&
        std::from_chars(&text[i + 1], &text[i + 1] + 2, code, 16).ptr == &text[i + 1] + 2 && code != 0) {
      out += static_cast<char>(code);
      i += 2;
    } else {
      out += text[i];
    }
  }
  return out;
}

std::vector<fs::path> folders_of(const char* variable) {
  std::vector<fs::path> folders;
  const char* value = std::getenv(variable);
  std::string_view rest = value != nullptr ? value : "";
  while (!rest.empty()) {
    const std::size_t colon = rest.find(':');
    if (colon != 0) folders.emplace_back(rest.substr(0, colon));
    rest.remove_prefix(colon == std::string_view::npos ? rest.size() : colon + 1);
  }
  return folders;
}

/// Whether a folder is the root of a package, by its own name or by the <name> in its package.xml.
bool is_package(const fs::path& folder, const std::string& package) {
  const fs::path normal = folder.lexically_normal();
  if ((normal.has_filename() ? normal : normal.parent_path()).filename() == package)
    return true;  // "p/" is p
  const fs::path manifest = folder / "package.xml";
  tinyxml2::XMLDocument document;
  if (!is_file(manifest) || document.LoadFile(manifest.c_str()) != tinyxml2::XML_SUCCESS) return false;
  const tinyxml2::XMLElement* root = document.FirstChildElement("package");
  const tinyxml2::XMLElement* name = root != nullptr ? root->FirstChildElement("name") : nullptr;
  return name != nullptr && name->GetText() != nullptr && package == name->GetText();
}

/// Tries candidates until one is a file.
class Search {
 public:
  Search(ResolvedFile& result, fs::path rest) : result_{result}, rest_{std::move(rest)} {}

  /// Whether the search is over.
  bool try_folder(const fs::path& package_folder) {
    const fs::path candidate = (package_folder / rest_).lexically_normal();
    std::vector<fs::path>& tried = result_.tried;
    if (std::find(tried.begin(), tried.end(), candidate) != tried.end()) return false;
    if (is_file(candidate)) {
      result_.path = candidate;
      return true;
    }
    tried.push_back(candidate);
    return false;
  }
  /// `folder` is the package or holds it.
  bool try_in(const fs::path& folder) {
    return (is_package(folder, result_.package) && try_folder(folder)) ||
           try_folder(folder / result_.package);
  }

 private:
  ResolvedFile& result_;
  fs::path rest_;
};

void search_package(std::string_view name, const fs::path& model, std::span<const fs::path> package_paths,
                    ResolvedFile& result) {
  name.remove_prefix(
      std::min(name.find_first_not_of('/'), name.size()));  // "package:///NAME/..." is met in the wild
  const std::size_t slash = name.find('/');
  result.package = name.substr(0, slash);
  if (result.package.empty() || slash == std::string_view::npos) {
    result.problem = "names no file in a package";
    return;
  }
  Search search{result, fs::path{name.substr(slash + 1)}.relative_path()};
  for (const fs::path& folder : package_paths) {
    if (search.try_in(folder)) return;
  }
  for (const fs::path& folder : folders_of("ROS_PACKAGE_PATH")) {
    if (search.try_in(folder)) return;
  }
  for (const fs::path& prefix : folders_of("AMENT_PREFIX_PATH")) {
    if (search.try_folder(prefix / "share" / result.package)) return;
  }
  for (fs::path folder = fs::absolute(model).lexically_normal().parent_path();;
       folder = folder.parent_path()) {
    if (search.try_in(folder)) return;
    if (folder == folder.parent_path()) break;
  }
  result.problem = "package '" + result.package + "' or the file in it was not found";
}

}  // namespace

ResolvedFile resolve_package(std::string_view uri, const fs::path& model,
                             std::span<const fs::path> package_paths) {
  ResolvedFile result;
  try {
    if (uri.starts_with(kPackage)) {
      search_package(uri.substr(kPackage.size()), model, package_paths, result);
      return result;
    }
    const bool is_file_uri = uri.starts_with(kFile);
    if (!is_file_uri && uri.find("://") != std::string_view::npos) {
      result.problem = "'" + std::string{uri.substr(0, uri.find("://") + 3)} + "' is not followed";
      return result;
    }
    const fs::path named = is_file_uri ? percent_decoded(uri.substr(kFile.size())) : std::string{uri};
    const fs::path candidate = (model.parent_path() / named).lexically_normal();
    if (is_file(candidate)) {
      result.path = candidate;
    } else {
      result.tried.push_back(candidate);
      result.problem = "does not exist or is no file";
    }
  } catch (const std::exception& e) {
    result.path.clear();
    result.problem = e.what();
  }
  return result;
}

std::string tried_text(const ResolvedFile& file) {
  constexpr std::size_t kMost = 3;
  std::string text;
  for (std::size_t i = 0; i < std::min(kMost, file.tried.size()); ++i) {
    text += (i > 0 ? ", " : "") + file.tried[i].string();
  }
  if (file.tried.size() > kMost) text += " and " + std::to_string(file.tried.size() - kMost) + " more places";
  return text;
}

}  // namespace pantin

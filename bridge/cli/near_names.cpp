#include <pantin/bridge/cli/near_names.hpp>

#include <algorithm>
#include <numeric>
#include <span>
#include <utility>

namespace pantin::cli {
namespace {

constexpr std::size_t kSuggestions = 3;

/// Levenshtein distance: insertions, deletions and replacements of single bytes.
std::size_t edits_between(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = std::exchange(row[0], i + 1);
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t replaced = diagonal + (a[i] == b[j] ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({replaced, row[j] + 1, row[j + 1] + 1});
    }
  }
  return row.back();
}

std::string quoted_list(const std::vector<std::string>& names) {
  std::string out;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (i > 0) out += i + 1 == names.size() ? " or " : ", ";
    out += "'" + names[i] + "'";
  }
  return out;
}

}  // namespace

std::vector<std::string> near_names(std::string_view wanted, const std::vector<std::string>& candidates) {
  struct Near {
    std::size_t edits{0};
    const std::string* name{nullptr};
  };
  const std::string ending = "/" + std::string{wanted};
  std::vector<Near> near;
  for (const std::string& candidate : candidates) {
    if (candidate.ends_with(ending)) {
      near.push_back({0, &candidate});
      continue;
    }
    // More edits than a third of the letters are no typing slip; longer differences need not be counted.
    const std::size_t allowed = std::max(wanted.size(), candidate.size()) / 3 + 1;
    const std::size_t lengths_apart =
        std::max(wanted.size(), candidate.size()) - std::min(wanted.size(), candidate.size());
    if (lengths_apart > allowed) continue;
    const std::size_t edits = edits_between(wanted, candidate);
    if (edits <= allowed) near.push_back({edits, &candidate});
  }
  std::stable_sort(near.begin(), near.end(), [](const Near& a, const Near& b) { return a.edits < b.edits; });
  std::vector<std::string> names;
  for (std::size_t i = 0; i < std::min(near.size(), kSuggestions); ++i) names.push_back(*near[i].name);
  return names;
}

std::string suggestion(std::string_view wanted, const std::vector<std::string>& candidates) {
  if (candidates.empty()) return "leave it out: there is none here";
  const std::vector<std::string> near = near_names(wanted, candidates);
  if (!near.empty()) return "did you mean " + quoted_list(near) + "?";
  const auto shown = static_cast<std::ptrdiff_t>(std::min(candidates.size(), kSuggestions));
  const std::vector<std::string> first(candidates.begin(), candidates.begin() + shown);
  const std::string rest = candidates.size() > first.size() ? ", ..." : "";
  return "there is " + quoted_list(first) + rest + "; `pantin info` lists all";
}

std::vector<std::string> all_paths(const Scene& scene) {
  const std::vector<NodeId> nodes = scene.subtree(scene.root());
  return scene.paths(std::span{nodes}.subspan(1));  // all but the root
}

Diagnostic argument_error(std::string_view option, std::string_view argument, std::string problem,
                          std::string remedy) {
  return {Severity::Error, "command line", std::string{option} + " '" + std::string{argument} + "'",
          std::move(problem), std::move(remedy)};
}

Diagnostic unknown_path(const Scene& scene, std::string_view option, std::string_view path) {
  return argument_error(option, path, "no node has the path '" + std::string{path} + "'",
                        suggestion(path, all_paths(scene)));
}

}  // namespace pantin::cli

// The pre-flight over the whole: names, mimics, and whether links and joints make one tree. Loops instead of
// recursion: a chain may have any length.
#include <algorithm>
#include <string_view>
#include <tuple>
#include <unordered_map>

#include <pantin/bridge/loaders/urdf_survey.hpp>

namespace pantin::urdf_loader {
namespace {

using Names = std::unordered_map<std::string_view, std::size_t>;

/// Position of each name; a second one of the same name is an error. Nameless ones are left out.
template <class Entry>
Names positions(const std::vector<Entry>& entries, const char* what, Ledger& ledger) {
  Names names;
  for (std::size_t i = 0; i < entries.size(); ++i) {
    if (entries[i].name.empty()) continue;
    const auto [first, is_new] = names.emplace(entries[i].name, i);
    if (is_new) continue;
    ledger.error({entries[i].line, std::string{what} + " '" + entries[i].name + "'",
                  std::string{"is the second "} + what + " of this name; the first is in line " +
                      std::to_string(entries[first->second].line),
                  "rename one of them"});
  }
  return names;
}

std::string joint_subject(const JointEntry& joint) { return "joint '" + joint.name + '\''; }

/// "'a', 'b', 'c' and 12 more"
std::string list(const std::vector<std::string_view>& names, const char* between) {
  constexpr std::size_t kMost = 6;
  std::string text;
  for (std::size_t i = 0; i < std::min(names.size(), kMost); ++i) {
    text += (i > 0 ? between : "") + ('\'' + std::string{names[i]} + '\'');
  }
  if (names.size() > kMost) text += " and " + std::to_string(names.size() - kMost) + " more";
  return text;
}

/// Joints by which each link hangs on its parent; -1 = none.
struct Tree {
  bool complete{true};  ///< no joint had to be left out
  std::vector<std::int64_t> joint_above;
  std::vector<std::size_t> parent;  ///< link; valid where joint_above >= 0
  std::vector<std::vector<std::size_t>> joints_below;
};

Tree hang(const Survey& survey, const Names& links, Ledger& ledger) {
  Tree tree{.complete = true,
            .joint_above = std::vector<std::int64_t>(survey.links.size(), -1),
            .parent = std::vector<std::size_t>(survey.links.size()),
            .joints_below = std::vector<std::vector<std::size_t>>(survey.links.size())};
  for (std::size_t j = 0; j < survey.joints.size(); ++j) {
    const JointEntry& joint = survey.joints[j];
    const auto parent = links.find(joint.parent);
    const auto child = links.find(joint.child);
    for (const auto& [found, name, end] :
         {std::tuple{parent, &joint.parent, "parent"}, std::tuple{child, &joint.child, "child"}}) {
      if (found != links.end() || name->empty()) continue;
      ledger.error({joint.line, joint_subject(joint),
                    std::string{end} + " link '" + *name + "' does not exist", "name an existing link"});
    }
    std::int64_t* above = child != links.end() ? &tree.joint_above[child->second] : nullptr;
    const bool usable = parent != links.end() && above != nullptr && parent != child && *above < 0;
    tree.complete = tree.complete && usable;
    if (usable) {
      *above = static_cast<std::int64_t>(j);
      tree.parent[child->second] = parent->second;
      tree.joints_below[parent->second].push_back(j);
    } else if (above != nullptr && parent == child) {
      ledger.error({joint.line, joint_subject(joint), "joins link '" + joint.child + "' to itself",
                    "name two different links"});
    } else if (above != nullptr && *above >= 0) {
      const JointEntry& first = survey.joints[static_cast<std::size_t>(*above)];
      ledger.error({joint.line, joint_subject(joint),
                    "closes a loop: link '" + joint.child + "' is already the child of joint '" + first.name +
                        "' (line " + std::to_string(first.line) + ')',
                    "URDF describes trees: leave this joint out and close the loop after loading"});
    }
  }
  return tree;
}

/// One error for every cycle: links that hang on each other and on no root.
void report_cycles(const Survey& survey, const Tree& tree, Ledger& ledger) {
  enum class Mark : char { New, OnPath, Done };
  std::vector<Mark> marks(survey.links.size(), Mark::New);
  std::vector<std::size_t> path;
  for (std::size_t start = 0; start < survey.links.size(); ++start) {
    path.clear();
    std::size_t link = start;
    while (marks[link] == Mark::New) {
      marks[link] = Mark::OnPath;
      path.push_back(link);
      if (tree.joint_above[link] < 0) break;
      link = tree.parent[link];
    }
    if (tree.joint_above[link] >= 0 && marks[link] == Mark::OnPath) {
      std::vector<std::string_view> names;
      for (auto i = path.rbegin(); i != path.rend(); ++i) {
        names.push_back(survey.links[*i].name);
        if (*i == link) break;
      }
      // The walk went from child to parent, so the names stand parent first and end where they began.
      std::rotate(names.begin(), names.end() - 1, names.end());
      const std::string circle = list(names, " -> ");
      ledger.error({survey.joints[static_cast<std::size_t>(tree.joint_above[link])].line,
                    "link '" + survey.links[link].name + '\'', "hangs on itself: " + circle + " -> back",
                    "cut the circle at one joint"});
    }
    for (const std::size_t i : path) marks[i] = Mark::Done;
  }
}

void lay_out(Survey& survey, const Tree& tree, const Names& links, std::size_t root) {
  std::vector<TreeEntry> open{{.link = root}};
  while (!open.empty()) {
    const TreeEntry entry = open.back();
    open.pop_back();
    const auto position = static_cast<std::int32_t>(survey.tree.size());
    survey.tree.push_back(entry);
    const std::vector<std::size_t>& below = tree.joints_below[entry.link];
    for (auto j = below.rbegin(); j != below.rend(); ++j) {
      open.push_back({links.find(survey.joints[*j].child)->second, static_cast<std::int64_t>(*j), position});
    }
  }
}

/// Mimics that lead back to where they began; one error each. A joint that mimics itself is another message.
void report_mimic_circles(const Survey& survey, const Names& names, Ledger& ledger) {
  std::vector<bool> done(survey.joints.size(), false);
  std::vector<std::size_t> path;
  for (std::size_t start = 0; start < survey.joints.size(); ++start) {
    path.clear();
    std::size_t at = start;
    while (!done[at]) {
      done[at] = true;
      path.push_back(at);
      const auto leader = names.find(survey.joints[at].mimic);
      if (survey.joints[at].mimic.empty() || leader == names.end()) break;
      at = leader->second;
    }
    const auto again = std::find(path.begin(), path.end(), at);
    if (again == path.end() || again + 1 == path.end()) continue;
    std::vector<std::string_view> circle;
    for (auto i = again; i != path.end(); ++i) circle.push_back(survey.joints[*i].name);
    ledger.error({survey.joints[at].mimic_line, joint_subject(survey.joints[at]),
                  "mimics lead in a circle: " + list(circle, " -> ") + " -> back", "let one of them lead"});
  }
}

}  // namespace

void check_mimics(const Survey& survey, Ledger& ledger) {
  Names names;
  for (std::size_t i = 0; i < survey.joints.size(); ++i) names.emplace(survey.joints[i].name, i);
  for (std::size_t i = 0; i < survey.joints.size(); ++i) {
    const JointEntry& joint = survey.joints[i];
    if (joint.mimic.empty()) continue;
    const auto leader = names.find(joint.mimic);
    const auto error = [&](std::string problem, std::string remedy) {
      ledger.error({joint.mimic_line, joint_subject(joint), std::move(problem), std::move(remedy)});
    };
    if (leader == names.end()) {
      error("mimic names '" + joint.mimic + "', which does not exist", "name an existing joint");
    } else if (leader->second == i) {
      error("mimics itself", "name another joint");
    } else if (!has_value(survey.joints[leader->second].type)) {
      error("mimic names '" + joint.mimic + "', which has no value to follow",
            "name a revolute, continuous or prismatic joint");
    }
  }
  report_mimic_circles(survey, names, ledger);
}

void check_graph(Survey& survey, Ledger& ledger) {
  const Names links = positions(survey.links, "link", ledger);
  positions(survey.joints, "joint", ledger);
  if (survey.links.empty()) {
    ledger.error({0, "robot '" + survey.robot + '\'', "has no link", "a robot has at least one"});
    return;
  }
  const Tree tree = hang(survey, links, ledger);
  report_cycles(survey, tree, ledger);
  // Where a joint is left out or a name is given twice, links without parent are no news.
  if (!tree.complete || links.size() < survey.links.size()) return;
  std::vector<std::string_view> roots;
  std::size_t root = 0;
  int line = 0;
  for (std::size_t i = 0; i < survey.links.size(); ++i) {
    if (tree.joint_above[i] >= 0) continue;
    if (roots.empty()) root = i;
    if (roots.size() == 1) line = survey.links[i].line;
    roots.push_back(survey.links[i].name);
  }
  if (roots.size() > 1) {
    ledger.error({line, "robot '" + survey.robot + '\'',
                  std::to_string(roots.size()) + " links have no parent: " + list(roots, ", "),
                  "join them, so that one link is the root"});
  }
  if (!ledger.has_error()) lay_out(survey, tree, links, root);
}

}  // namespace pantin::urdf_loader

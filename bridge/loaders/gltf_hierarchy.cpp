#include "gltf_hierarchy.hpp"

#include <algorithm>

namespace pantin::gltf {
namespace {

/// The children of node i are children[first[i]] to children[first[i + 1]].
struct ChildLists {
  std::vector<std::size_t> first{0};
  std::vector<std::uint32_t> children{};
};

ChildLists read_children(const Document& document, std::vector<std::int32_t>& parents) {
  Report& report = document.report();
  ChildLists lists;
  for (std::size_t i = 0; i < parents.size(); ++i) {
    report.try_part([&] {
      const std::optional<JsonValue> children =
          member(report, document.item(Collection::Nodes, i), "children", JsonKind::Array);
      for (std::size_t k = 0; children && k < children->size(); ++k) {
        const std::size_t child = document.index(children->at(k), Collection::Nodes);
        if (parents[child] >= 0)
          report.refuse(children->at(k),
                        "lists node " + std::to_string(child) + ", which is already a child of node " +
                            std::to_string(parents[child]),
                        "a node has one parent: leave it out of one list");
        parents[child] = static_cast<std::int32_t>(i);
        lists.children.push_back(static_cast<std::uint32_t>(child));
      }
    });
    lists.first.push_back(lists.children.size());
  }
  report.stop_at_errors();
  return lists;
}

/// Without recursion: a chain may be as long as memory allows.
std::vector<std::uint32_t> depth_first(const ChildLists& lists, std::vector<std::uint32_t> roots) {
  std::vector<std::uint32_t> order;
  std::ranges::reverse(roots);
  std::vector<std::uint32_t>& stack = roots;
  while (!stack.empty()) {
    const std::uint32_t node = stack.back();
    stack.pop_back();
    order.push_back(node);
    for (std::size_t k = lists.first[node + 1]; k > lists.first[node]; --k)
      stack.push_back(lists.children[k - 1]);
  }
  return order;
}

std::vector<std::uint32_t> nodes_without_parent(const std::vector<std::int32_t>& parents) {
  std::vector<std::uint32_t> roots;
  for (std::size_t i = 0; i < parents.size(); ++i)
    if (parents[i] < 0) roots.push_back(static_cast<std::uint32_t>(i));
  return roots;
}

/// As each node has at most one parent, the nodes that no root leads to are those of cycles and what hangs on
/// them.
void refuse_cycles(const Document& document, const Hierarchy& hierarchy, const ChildLists& lists) {
  const std::vector<std::uint32_t> reached = depth_first(lists, nodes_without_parent(hierarchy.parents));
  if (reached.size() == hierarchy.parents.size()) return;
  std::vector<bool> is_reached(hierarchy.parents.size(), false);
  for (const std::uint32_t node : reached) is_reached[node] = true;
  const auto first = std::ranges::find(is_reached, false) - is_reached.begin();
  auto node = static_cast<std::size_t>(first);
  for (std::size_t i = 0; i < hierarchy.parents.size(); ++i)  // up as far as it takes to be in the cycle
    node = static_cast<std::size_t>(hierarchy.parents[node]);
  document.report().refuse(document.item(Collection::Nodes, node), "the node is its own ancestor",
                           "take it out of the children of node " + std::to_string(hierarchy.parents[node]));
}

/// The scene to load, or nothing where the document has none.
std::optional<JsonValue> chosen_scene(const Document& document) {
  Report& report = document.report();
  const std::size_t count = document.count(Collection::Scenes);
  const std::optional<JsonValue> named = document.referred(document.root(), "scene", Collection::Scenes);
  if (count == 0) return std::nullopt;
  const JsonValue scene = named ? *named : document.item(Collection::Scenes, 0);
  for (std::size_t i = 0; i < count; ++i) {
    const JsonValue other = document.item(Collection::Scenes, i);
    if (other.index() != scene.index()) report.marks().drop(other, "another scene is loaded");
  }
  if (count > 1)
    report.tally(Severity::Note, "scenes", scene,
                 "of " + std::to_string(count) + " scenes the " + (named ? "default" : "first") + " one, " +
                     subject_of(scene) + ", is loaded",
                 "");
  return scene;
}

std::vector<std::uint32_t> roots_of(const Document& document, const JsonValue& scene,
                                    const std::vector<std::int32_t>& parents) {
  Report& report = document.report();
  const std::optional<JsonValue> nodes = member(report, scene, "nodes", JsonKind::Array);
  std::vector<std::uint32_t> roots;
  std::vector<bool> is_listed(parents.size(), false);
  for (std::size_t i = 0; nodes && i < nodes->size(); ++i) {
    const std::size_t node = document.index(nodes->at(i), Collection::Nodes);
    if (parents[node] >= 0)
      report.refuse(nodes->at(i),
                    "lists node " + std::to_string(node) + ", which is a child of node " +
                        std::to_string(parents[node]),
                    "list the top nodes only");
    if (is_listed[node])
      report.refuse(nodes->at(i), "lists node " + std::to_string(node) + " twice", "list it once");
    is_listed[node] = true;
    roots.push_back(static_cast<std::uint32_t>(node));
  }
  return roots;
}

void note_nodes_outside(const Document& document, const Hierarchy& hierarchy) {
  const std::size_t outside = hierarchy.positions.size() - hierarchy.order.size();
  if (outside == 0) return;
  for (std::size_t i = 0; i < hierarchy.positions.size(); ++i)
    if (hierarchy.positions[i] < 0)
      document.report().marks().drop(document.item(Collection::Nodes, i), "not in the scene: not loaded");
  const auto first = std::ranges::find(hierarchy.positions, -1) - hierarchy.positions.begin();
  document.report().tally(Severity::Note, "nodes",
                          document.item(Collection::Nodes, static_cast<std::size_t>(first)),
                          "not in the scene: not loaded", "add them to the scene", outside);
}

}  // namespace

Hierarchy read_hierarchy(const Document& document) {
  Report& report = document.report();
  Hierarchy hierarchy;
  hierarchy.parents.assign(document.count(Collection::Nodes), -1);
  const ChildLists lists = read_children(document, hierarchy.parents);
  refuse_cycles(document, hierarchy, lists);
  if (const std::optional<JsonValue> scene = chosen_scene(document)) {
    hierarchy.order = depth_first(lists, roots_of(document, *scene, hierarchy.parents));
  } else {
    hierarchy.order = depth_first(lists, nodes_without_parent(hierarchy.parents));
    if (!hierarchy.order.empty())
      report.mention(Severity::Note, "scene", "the model has no scene: all its nodes are loaded", "");
  }
  if (hierarchy.order.empty())
    report.refuse(document.root(), "there is no node to load", "put nodes into the default scene");
  hierarchy.positions.assign(hierarchy.parents.size(), -1);
  for (std::size_t i = 0; i < hierarchy.order.size(); ++i)
    hierarchy.positions[hierarchy.order[i]] = static_cast<std::int32_t>(i);
  note_nodes_outside(document, hierarchy);
  return hierarchy;
}

}  // namespace pantin::gltf

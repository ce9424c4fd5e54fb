#pragma once
// The plainest scene there is, to compare the real one with: a map of nodes with lists of children, nothing
// stored that can be computed.
#include <algorithm>
#include <map>
#include <string>
#include <vector>

#include <pantin/scenegraph/scene.hpp>

namespace pantin::test {

class ReferenceScene {
 public:
  struct Node {
    NodeId parent{};
    std::vector<NodeId> children{};
    std::string name{};
    Affine M_PN{Affine::Identity()};
  };

  explicit ReferenceScene(NodeId root) : root_{root} { nodes_[root] = {}; }

  [[nodiscard]] NodeId root() const { return root_; }
  [[nodiscard]] const std::map<NodeId, Node>& nodes() const { return nodes_; }
  [[nodiscard]] Node& at(NodeId id) { return nodes_.at(id); }
  [[nodiscard]] const Node& at(NodeId id) const { return nodes_.at(id); }

  void create(NodeId id, NodeId parent, const std::string& name, const Affine& M_PN) {
    nodes_[id] = {parent, {}, name, M_PN};
    at(parent).children.push_back(id);
  }

  void remove(NodeId id) {
    for (const NodeId below : subtree(id))
      if (below != id) nodes_.erase(below);
    leave_parent(id);
    nodes_.erase(id);
  }

  void set_parent(NodeId child, NodeId parent) {
    leave_parent(child);
    at(child).parent = parent;
    at(parent).children.push_back(child);
  }

  /// Depth-first, children in order.
  [[nodiscard]] std::vector<NodeId> subtree(NodeId id) const {
    std::vector<NodeId> out;
    std::vector<NodeId> rest{id};
    while (!rest.empty()) {
      out.push_back(rest.back());
      rest.pop_back();
      const std::vector<NodeId>& children = at(out.back()).children;
      rest.insert(rest.end(), children.rbegin(), children.rend());
    }
    return out;
  }

  [[nodiscard]] bool is_above(NodeId ancestor, NodeId id) const {
    for (; id; id = at(id).parent)
      if (id == ancestor) return true;
    return false;
  }

  [[nodiscard]] Affine world(NodeId id) const {
    Affine M = Affine::Identity();
    for (; id; id = at(id).parent) M = at(id).M_PN * M;
    return M;
  }

 private:
  void leave_parent(NodeId id) {
    std::vector<NodeId>& siblings = at(at(id).parent).children;
    siblings.erase(std::find(siblings.begin(), siblings.end(), id));
  }

  NodeId root_;
  std::map<NodeId, Node> nodes_{};
};

}  // namespace pantin::test

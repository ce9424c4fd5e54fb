// Which nodes a verb acts on.
#include <pantin/bridge/bridge_impl.hpp>

namespace pantin {
namespace {

bool has_geometry(const NodeBody& body) { return !body.shapes.empty() || !body.meshes.empty(); }

/// What is said about one node.
struct Facts {
  const Link* link{nullptr};
  const NodeBody* body{nullptr};

  [[nodiscard]] bool is_body_by_itself() const {
    const bool moves = link != nullptr && link->kind != LinkKind::Fixed;
    return moves || (body != nullptr && body->mass && body->mass->mass > 0);
  }
  [[nodiscard]] bool says_anything() const {
    return link != nullptr || (body != nullptr && (body->mass || has_geometry(*body)));
  }
};

}  // namespace

// A given node of which nothing is known is left out where nodes below it are bodies (it only places them);
// where there is none, it stands for the geometry below it.
std::vector<NodeId> Bridge::Impl::selected(NodeId id, Scope scope) const {
  if (scope == Scope::Node) return id == scene.root() ? std::vector<NodeId>{} : std::vector<NodeId>{id};
  const auto facts = [this](NodeId node) {
    const auto body = node_bodies.find(node);
    return Facts{scene.link(node), body == node_bodies.end() ? nullptr : &body->second};
  };
  const std::vector<NodeId> tops = id == scene.root() ? scene.children(id) : std::vector<NodeId>{id};
  std::vector<NodeId> nodes;
  for (const NodeId top : tops) {
    const std::vector<NodeId> subtree = scene.subtree(top);
    const std::size_t first = nodes.size();
    bool any_geometry = false;
    for (std::size_t k = 0; k < subtree.size(); ++k) {
      const Facts known = facts(subtree[k]);
      any_geometry =
          any_geometry || (known.body != nullptr && (has_geometry(*known.body) || known.body->mass));
      if (known.is_body_by_itself() || (k == 0 && known.says_anything())) nodes.push_back(subtree[k]);
    }
    const bool stands_for_all = nodes.size() == first && (any_geometry || id != scene.root());
    if (stands_for_all) nodes.push_back(top);
  }
  return nodes;
}

std::vector<Binding*> Bridge::Impl::bound_in(NodeId id, Scope scope) const {
  if (scope == Scope::Subtree) return below({&id, 1});
  Binding* binding = find(id);
  return binding == nullptr ? std::vector<Binding*>{} : std::vector<Binding*>{binding};
}

}  // namespace pantin

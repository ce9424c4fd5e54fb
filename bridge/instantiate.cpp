// A model becomes nodes.
#include <pantin/bridge/bridge_impl.hpp>
#include <pantin/scenegraph/expects.hpp>

namespace pantin {
namespace {

/// Per node: whether it or something below it has a link.
std::vector<bool> carries_links(const Model& model) {
  std::vector<bool> carries(model.nodes.size());
  for (std::size_t k = model.nodes.size(); k-- > 0;) {
    const ModelNode& node = model.nodes[k];
    carries[k] = carries[k] || node.link.has_value();
    if (node.parent >= 0 && carries[k]) carries[static_cast<std::size_t>(node.parent)] = true;
  }
  return carries;
}

/// How the top of a linked model stands in the world: welded where it is, or free.
Link base_link(const ModelNode& top, Base base) {
  Link link;
  link.kind = base == Base::Fixed ? LinkKind::Fixed : LinkKind::Free;
  link.name = base == Base::Fixed ? "fixed_base" : "floating_base";
  link.M_PJ = top.M_PN;
  link.value = zero_value(link.kind);
  return link;
}

NodeBody body_of_model(const ModelNode& node) {
  NodeBody body{node.mass, node.shapes, node.meshes};
  if (node.dynamics)
    body.joint_damping = node.dynamics->damping, body.joint_friction = node.dynamics->friction;
  return body;
}

}  // namespace

Instance Bridge::instantiate(const Model& model, NodeId parent, const InstantiateSettings& settings) {
  Impl& bridge = *impl_;
  Scene& scene = bridge.scene;
  bridge.expect_alive(parent, "instantiate");
  PANTIN_EXPECTS(!settings.prefix.empty() || settings.M_PM.matrix().isIdentity(0),
                 "instantiate: a placement M_PM needs a prefix, the name of the node that carries it");
  Instance instance;
  NodeId above = parent;
  if (!settings.prefix.empty()) above = scene.create(parent, settings.prefix, settings.M_PM);
  const std::vector<bool> linked = carries_links(model);
  std::size_t tops = 0;
  for (std::size_t k = 0; k < model.nodes.size(); ++k) {
    const ModelNode& node = model.nodes[k];
    const bool top = node.parent < 0;
    PANTIN_EXPECTS(node.parent < static_cast<std::int32_t>(k),
                   "instantiate: node '" + node.name + "' stands before its parent; parents come first");
    const NodeId id = scene.create(top ? above : instance.nodes[static_cast<std::size_t>(node.parent)],
                                   node.name, node.M_PN);
    instance.nodes.push_back(id);
    if (node.link) scene.set_link(id, *node.link);
    else if (top && linked[k]) scene.set_link(id, base_link(node, settings.base));
    if (node.mass || !node.shapes.empty() || !node.meshes.empty() || node.dynamics)
      set_node_body(id, body_of_model(node));
    if (top) instance.root = id, ++tops;
  }
  add_followers(scene, instance.nodes, bridge.followers);
  if (!settings.prefix.empty() || tops != 1) instance.root = above;
  return instance;
}

}  // namespace pantin

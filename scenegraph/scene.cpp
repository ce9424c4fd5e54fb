#include <algorithm>

#include <pantin/scenegraph/expects.hpp>
#include <pantin/scenegraph/scene_impl.hpp>

namespace pantin {

Scene::Scene() : impl_{std::make_unique<Impl>()} { impl_->mark(0); }
Scene::~Scene() = default;
Scene::Scene(Scene&&) noexcept = default;
Scene& Scene::operator=(Scene&&) noexcept = default;

std::uint32_t Scene::Impl::at(NodeId id) const {
  PANTIN_EXPECTS(nodes.contains(id),
                 "node id (index " + std::to_string(id.index) + ", generation " +
                     std::to_string(id.generation) +
                     ") is null or was removed; drop ids with their nodes or ask contains() first");
  return nodes.position(id);
}

void Scene::Impl::mark(std::uint32_t at) {
  dirty.grow(nodes.end());
  if (dirty.mark(at)) ++pending;
}

NodeId Scene::root() const noexcept { return impl_->id(0); }
std::size_t Scene::size() const noexcept { return impl_->nodes.alive(); }
bool Scene::contains(NodeId id) const noexcept { return impl_->nodes.contains(id); }

NodeId Scene::create(NodeId parent, std::string_view name, const Affine& M_PN) {
  const std::uint32_t above = impl_->at(parent);
  PANTIN_EXPECTS(M_PN.affine().allFinite(), "local matrix of the new node '" + std::string{name} +
                                                "' under " + impl_->called(above) +
                                                " has an entry that is not finite");
  const NodeId id = impl_->nodes.append(above, Matrix34::from(M_PN));
  if (impl_->names.size() <= id.index) impl_->names.resize(id.index + std::size_t{1});
  impl_->names[id.index] = name;
  impl_->mark(impl_->nodes.position(id));
  return id;
}

void Scene::remove(NodeId id) {
  const std::uint32_t top = impl_->at(id);
  PANTIN_EXPECTS(top != 0, "the root cannot be removed; remove its children or drop the scene");
  std::vector<std::uint32_t>& positions = impl_->scratch;
  positions.clear();
  impl_->nodes.collect(top, positions);
  for (const std::uint32_t at : positions) {
    const std::uint32_t index = impl_->id(at).index;
    impl_->names[index] = std::string{};
    if (!impl_->links.empty()) impl_->links.erase(index);
    impl_->dirty.clean(at, at + 1);
  }
  impl_->nodes.remove(top, positions);
  ++impl_->pending;
  impl_->compact_if_mostly_holes();
}

const std::string& Scene::name(NodeId id) const { return impl_->name(impl_->at(id)); }

void Scene::rename(NodeId id, std::string_view name) {
  const std::uint32_t at = impl_->at(id);
  PANTIN_EXPECTS(at != 0, "the root has no name; name a child of it");
  impl_->names[id.index] = name;
}

void Scene::Impl::set_local(std::uint32_t at, const Affine& M_PN) {
  PANTIN_EXPECTS(M_PN.affine().allFinite(),
                 "local matrix of " + called(at) + " has an entry that is not finite");
  nodes.locals()[at] = Matrix34::from(M_PN);
  mark(at);
}

Affine Scene::local(NodeId id) const { return impl_->nodes.locals()[impl_->at(id)].affine(); }
void Scene::set_local(NodeId id, const Affine& M_PN) { impl_->set_local(impl_->at(id), M_PN); }

void Scene::set_locals(std::span<const NodeLocal> locals) {
  for (const NodeLocal& local : locals) impl_->set_local(impl_->at(local.node), local.M_PN);
}

}  // namespace pantin

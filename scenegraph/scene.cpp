#include <algorithm>
#include <array>

#include <pantin/scenegraph/expects.hpp>
#include <pantin/scenegraph/scene_impl.hpp>

namespace pantin {

Scene::Scene() : Scene{InstructionSet::Best} {}
Scene::Scene(InstructionSet set) : impl_{std::make_unique<Impl>()} {
  PANTIN_EXPECTS(runs_here(set), "instruction set " + std::string{to_string(set)} +
                                     " is not in this build or not in this processor; use Best");
  impl_->kernel = sweep_kernel(set);
  impl_->mark(0);
}
Scene::~Scene() = default;
Scene::Scene(Scene&&) noexcept = default;
Scene& Scene::operator=(Scene&&) noexcept = default;

void Scene::Impl::reject(NodeId id) const {
  PANTIN_EXPECTS(nodes.contains(id),
                 "node id (index " + std::to_string(id.index) + ", generation " +
                     std::to_string(id.generation) +
                     ") is null or was removed; drop ids with their nodes or ask contains() first");
}

NodeId Scene::root() const noexcept { return impl_->id(0); }
std::size_t Scene::size() const noexcept { return impl_->nodes.alive(); }
bool Scene::contains(NodeId id) const noexcept { return impl_->nodes.contains(id); }
InstructionSet Scene::instruction_set() const noexcept { return impl_->kernel.set; }

void Scene::reserve(std::size_t nodes) {
  impl_->nodes.reserve(nodes);
  impl_->names.reserve(nodes);
  impl_->dirty.grow(nodes);
}

NodeId Scene::create(NodeId parent, std::string_view name, const Affine& M_PN) {
  const std::uint32_t above = impl_->at(parent);
  const Matrix34 local = Matrix34::from(M_PN);
  PANTIN_EXPECTS(local.is_finite(), "local matrix of the new node '" + std::string{name} + "' under " +
                                        impl_->called(above) + " has an entry that is not finite");
  const NodeId id = impl_->nodes.append(above, local);
  if (impl_->names.size() <= id.index) impl_->names.resize(id.index + std::size_t{1});
  impl_->names[id.index] = name;
  ++impl_->shape;
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
  ++impl_->shape;
  impl_->nodes.remove(top, positions);
  ++impl_->pending;
  impl_->compact_if_mostly_holes();
}

const std::string& Scene::name(NodeId id) const { return impl_->name(impl_->at(id)); }

void Scene::rename(NodeId id, std::string_view name) {
  const std::uint32_t at = impl_->at(id);
  PANTIN_EXPECTS(at != 0, "the root has no name; name a child of it");
  ++impl_->shape;
  impl_->names[id.index] = name;
}

void Scene::Impl::set_local(std::uint32_t at, const Matrix34& M_PN) {
  PANTIN_EXPECTS(M_PN.is_finite(), "local matrix of " + called(at) + " has an entry that is not finite");
  nodes.locals()[at] = M_PN;
  mark(at);
}

Affine Scene::local(NodeId id) const { return impl_->nodes.locals()[impl_->at(id)].affine(); }
std::span<const Matrix34> Scene::locals() const noexcept { return impl_->nodes.locals(); }
void Scene::set_local(NodeId id, const Affine& M_PN) { impl_->set_local(impl_->at(id), M_PN); }

void Scene::set_locals(std::span<const NodeLocal> locals) {
  for (const NodeLocal& local : locals) impl_->set_local(impl_->at(local.node), local.M_PN);
}

void Scene::set_locals(std::span<const NodeId> ids, std::span<const Matrix34> locals) {
  PANTIN_EXPECTS(ids.size() == locals.size(), "set_locals: " + std::to_string(ids.size()) + " ids with " +
                                                  std::to_string(locals.size()) +
                                                  " matrices; give one matrix for each id");
  // The nodes lie anywhere: where the first of a block is still being waited for, the others are asked for.
  std::array<std::uint32_t, 32> at{};
  for (std::size_t from = 0; from < ids.size(); from += at.size()) {
    const std::size_t count = std::min(at.size(), ids.size() - from);
    for (std::size_t k = 0; k < count; ++k) {
      at[k] = impl_->at(ids[from + k]);
      __builtin_prefetch(&impl_->nodes.locals()[at[k]], 1);
      __builtin_prefetch(&impl_->nodes.locals()[at[k]].m[11], 1);
    }
    for (std::size_t k = 0; k < count; ++k) impl_->set_local(at[k], locals[from + k]);
  }
}

SceneMemory Scene::memory() const {
  // What lies on the heap for a string of this capacity; a short one lies in itself.
  const auto text = [](const std::string& s) {
    return s.capacity() > std::string{}.capacity() ? s.capacity() + 1 : std::size_t{0};
  };
  SceneMemory memory;
  impl_->nodes.add_bytes(memory);
  memory.topology += impl_->dirty.bytes();
  memory.names = impl_->names.capacity() * sizeof(std::string);
  for (const std::string& name : impl_->names) memory.names += text(name);
  if (impl_->links.empty()) return memory;
  // A node of the table is a pointer and the entry; the hash of an integer is not stored.
  constexpr std::size_t kEntry = sizeof(void*) + sizeof(std::pair<const std::uint32_t, Link>);
  memory.links = impl_->links.bucket_count() * sizeof(void*) + impl_->links.size() * kEntry;
  for (const auto& [index, link] : impl_->links)
    memory.links += text(link.name) + (link.mimic ? text(link.mimic->source) : 0);
  return memory;
}

}  // namespace pantin

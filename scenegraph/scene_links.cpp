#include <pantin/scenegraph/expects.hpp>
#include <pantin/scenegraph/scene_impl.hpp>

namespace pantin {

const Link* Scene::link(NodeId id) const {
  static_cast<void>(impl_->at(id));
  const auto found = impl_->links.find(id.index);
  return found == impl_->links.end() ? nullptr : &found->second;
}

void Scene::set_link(NodeId id, Link link) {
  const std::uint32_t at = impl_->at(id);
  PANTIN_EXPECTS(at != 0, "the root has no parent to be linked to; give the link to a child of it");
  const std::string problem = problem_with(link);
  PANTIN_EXPECTS(problem.empty(), "link of " + impl_->called(at) + ": " + problem);
  impl_->set_local(at, local_matrix(link, link.value));
  impl_->links.insert_or_assign(id.index, std::move(link));
}

void Scene::clear_link(NodeId id) {
  static_cast<void>(impl_->at(id));
  impl_->links.erase(id.index);
}

void Scene::set_link_value(NodeId id, const LinkValue& value) {
  note_link_value(id, value);
  impl_->set_local(impl_->at(id), local_matrix(impl_->links.at(id.index), value));
}

void Scene::note_link_value(NodeId id, const LinkValue& value) {
  const std::uint32_t at = impl_->at(id);
  const auto found = impl_->links.find(id.index);
  PANTIN_EXPECTS(found != impl_->links.end(),
                 impl_->called(at) + " has no link to give a value to; set_link first");
  const std::string problem = problem_with(found->second.kind, value);
  PANTIN_EXPECTS(problem.empty(), "value for the link of " + impl_->called(at) + ": " + problem);
  found->second.value = value;
}

}  // namespace pantin

#include "use_model.hpp"

#include <pantin/pantin.hpp>

namespace pantin::test {

std::string problem_with_ledger(bool has_value, const std::vector<Diagnostic>& notes,
                                const std::string& file) {
  if (has_value == has_error(notes)) return has_value ? "a value beside an error" : "neither value nor error";
  for (const Diagnostic& note : notes) {
    if (note.severity != Severity::Error) continue;
    if (note.problem.empty()) return "an error without problem";
    if (!note.place.starts_with(file)) return "an error at another place: " + to_string(note);
  }
  return {};
}

std::string use(const Model& model) {
  if (model.nodes.empty()) return "a model without nodes";
  for (std::size_t i = 0; i < model.nodes.size(); ++i) {
    const ModelNode& node = model.nodes[i];
    if (node.parent >= static_cast<std::int32_t>(i) || node.parent < -1) return "a node before its parent";
    if (!node.M_PN.matrix().allFinite()) return "a matrix that is not finite";
    if (node.link && !problem_with(*node.link).empty()) return "a link that is unusable";
    for (const Shape& shape : node.shapes)
      if (problem_with(shape)) return "a shape that is unusable: " + problem_with(shape)->text;
    for (const ModelMesh& mesh : node.meshes)
      if (problem_with(Shape{MeshShape{mesh.mesh}})) return "a mesh that is unusable";
  }
  Scene scene;
  PhysicsManager physics;
  Bridge bridge{scene, physics};
  const Instance instance = bridge.instantiate(model, scene.root());
  for (const Clip& clip : model.clips) {
    for (const Track& track : clip.tracks) {
      if (track.target >= model.nodes.size()) return "a track without target";
      if (const std::string problem = problem_with(track); !problem.empty()) return "a track: " + problem;
      (void)sample(track, clip.duration / 2);
    }
    (void)bridge.play(clip, instance.nodes);
  }
  if (instance.root != scene.root()) (void)bridge.hand_over(instance.root, Scope::Subtree);
  scene.update();
  return {};
}

}  // namespace pantin::test

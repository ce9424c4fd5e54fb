#include <pantin/bridge/cli/clips.hpp>

#include <pantin/bridge/cli/near_names.hpp>

namespace pantin::cli {

std::optional<std::size_t> find_clip(const Model& model, std::string_view name) {
  for (std::size_t i = 0; i < model.clips.size(); ++i)
    if (model.clips[i].name == name) return i;
  for (std::size_t i = 0; i < model.clips.size(); ++i)
    if ("[" + std::to_string(i) + "]" == name) return i;
  return std::nullopt;
}

Diagnostic unknown_clip(const Model& model, std::string_view option, std::string_view name) {
  std::vector<std::string> names;
  for (const Clip& clip : model.clips) names.push_back(clip.name);
  return argument_error(option, name, "the model has no clip '" + std::string{name} + "'",
                        suggestion(name, names));
}

}  // namespace pantin::cli

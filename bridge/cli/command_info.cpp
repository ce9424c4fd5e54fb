#include <pantin/bridge/cli/command.hpp>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <iostream>

#include <pantin/bridge/bridge.hpp>
#include <pantin/bridge/cli/arguments.hpp>
#include <pantin/bridge/cli/clips.hpp>
#include <pantin/bridge/cli/common_options.hpp>
#include <pantin/bridge/cli/configure_links.hpp>
#include <pantin/bridge/cli/ledger_text.hpp>
#include <pantin/bridge/cli/model_text.hpp>
#include <pantin/bridge/writers/model_json.hpp>

namespace pantin::cli {
namespace {

struct InfoOptions {
  CommonOptions common{};
  std::string file{};
  std::vector<std::string> joints{};
  std::optional<std::string> clip{};
  double time{0};
};

/// Poses the scene as the clip has it at a time; held before its first and after its last key.
std::vector<Diagnostic> pose_by_clip(Scene& scene, const Model& model, const std::vector<NodeId>& nodes,
                                     const std::string& name, double time) {
  const std::optional<std::size_t> index = find_clip(model, name);
  if (!index) return {unknown_clip(model, "--clip", name)};
  const Clip& clip = model.clips[*index];
  const std::string problem = problem_with(scene, clip, nodes);
  if (!problem.empty())
    return {{Severity::Error, model.name, "clip '" + clip.name + "'", problem, "mend the clip in the file"}};
  Player player{scene, clip, nodes, {.loop = Loop::Once}};
  player.set_time(time);
  player.apply(scene);
  return {};
}

ExitCode run_info(const InfoOptions& options) {
  Ledger ledger{options.common.strict};
  const Loaded<Model> loaded = load(options.file, options.common);
  ledger.add(loaded.notes);
  if (!loaded.value) return fail(options.common, ledger);
  const Model& model = *loaded.value;

  Scene scene;
  PhysicsManager physics;
  Bridge bridge{scene, physics};
  const Instance instance = bridge.instantiate(model, scene.root());
  ledger.add(configure_links(scene, options.joints, {instance.nodes}));
  if (options.clip && !ledger.has_error())
    ledger.add(pose_by_clip(scene, model, instance.nodes, *options.clip, options.time));
  if (ledger.has_error()) return fail(options.common, ledger);
  scene.update();

  const ModelInScene view{model, scene, instance.nodes};
  if (options.common.json) write_model_json(std::cout, view, ledger.notes());
  else print_model(std::cout, options.file, view, ledger.notes());
  return ExitCode::Fine;
}

}  // namespace

void add_info_command(CLI::App& program, Command& chosen) {
  const auto options = std::make_shared<InfoOptions>();
  CLI::App* app =
      program.add_subcommand("info", "Print what a model file holds: nodes, links, masses, clips, ledger");
  app->add_option("MODEL", options->file, "Model file: URDF, glTF, GLB, or anything assimp reads")
      ->required();
  app->add_option("--joint", options->joints,
                  "Show the configuration with this joint value [rad or m]; a ball takes "
                  "w,x,y,z (repeatable)")
      ->type_name("NAME=VALUE")
      ->check(complaint_about_joint)
      ->allow_extra_args(false);
  CLI::Option* clip =
      app->add_option("--clip", options->clip, "Show the pose of this clip (name, or [k] for the k-th)")
          ->type_name("NAME");
  app->add_option_function<std::string>(
         "--time", [options](const std::string& text) { options->time = parse_number(text).value_or(0); },
         "Time in the clip [s], default 0")
      ->type_name("T")
      ->check(complaint_about_number)
      ->needs(clip);
  add_common_options(*app, options->common);
  app->callback([options, &chosen] { chosen = [options] { return run_info(*options); }; });
}

}  // namespace pantin::cli

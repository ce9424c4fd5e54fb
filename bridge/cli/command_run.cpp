#include <CLI/CLI.hpp>

#include <pantin/bridge/cli/command.hpp>
#include <pantin/bridge/cli/run_options.hpp>

namespace pantin::cli {
namespace {

using Complaint = std::string (*)(const std::string&);

/// An option of one argument that `complaint` has checked before `take` receives it.
CLI::Option* add_checked(CLI::App& app, const std::string& name, Complaint complaint,
                         std::function<void(const std::string&)> take, const std::string& help) {
  return app.add_option_function<std::string>(name, std::move(take), help)->check(complaint);
}

void add_what(CLI::App& app, RunOptions& options) {
  app.add_option("MODEL", options.models, "Model files; several are told apart by a node named like the file")
      ->required();
  app.add_option("--simulate", options.simulate,
                 "Hand this node and all below it to physics; 'all' for everything "
                 "(repeatable)")
      ->type_name("PATH|all")
      ->allow_extra_args(false);
  app.add_option(
         "--animate", options.animate,
         "Play a clip on this node and all below it, by default the first one; 'all' or 'none' instead of a "
         "path (repeatable). Without it, each model plays its first clip")
      ->type_name("PATH[=CLIP]")
      ->allow_extra_args(false);
  app.add_option_function<std::vector<std::string>>(
         "--toggle",
         [&options](const std::vector<std::string>& texts) {
           for (const std::string& text : texts)
             if (const std::optional<ToggleArgument> toggle = parse_toggle(text))
               options.toggles.push_back(*toggle);
         },
         "Change who moves a node and all below it at time T [s] (repeatable)")
      ->type_name("T:PATH=simulated|animated")
      ->check(complaint_about_toggle)
      ->allow_extra_args(false);
  app.add_option("--joint", options.joints,
                 "Begin with this joint value [rad or m]; a ball takes w,x,y,z (repeatable)")
      ->type_name("NAME=VALUE")
      ->check(complaint_about_joint)
      ->allow_extra_args(false);
}

void add_time(CLI::App& app, RunOptions& options) {
  const auto number = [](double& target) {
    return [&target](const std::string& text) { target = parse_number(text).value_or(target); };
  };
  add_checked(app, "--duration", complaint_about_positive, number(options.duration),
              "Time to simulate [s], default 5")
      ->type_name("T");
  add_checked(app, "--step", complaint_about_positive, number(options.step),
              "Step of physics [s], default 1/240")
      ->type_name("DT");
  add_checked(app, "--every", complaint_about_positive, number(options.every),
              "Time between samples [s], default 1/60; steps are shortened to land on samples")
      ->type_name("DT");
  app.add_option("--integrator", options.integrator, "Integrator, default rk4")
      ->check(CLI::IsMember(integrator_names()));
  add_checked(app, "--tolerance", complaint_about_positive, number(options.tolerance),
              "Error that dormand-prince, gauss8, gauss16 or radau may make a second [m] and [rad], "
              "default 1e-9")
      ->type_name("TOL");
  app.add_flag("--unwatched", options.unwatched,
               "take every step as asked for, also where the integrator does not bear it");
  app.add_flag("--adaptive", options.adaptive,
               "Go from sample to sample in one update, which such an integrator cuts as the motion needs; "
               "--step then counts for scheduling alone");
}

void add_world(CLI::App& app, RunOptions& options) {
  add_checked(
      app, "--up", complaint_about_up_axis,
      [&options](const std::string& text) { options.up = parse_up_axis(text); },
      "Up axis of the scene, default the first model's; models with another are rotated")
      ->type_name("X|Y|Z");
  add_checked(
      app, "--gravity", complaint_about_vector,
      [&options](const std::string& text) {
        if (const auto g = parse_numbers(text)) options.gravity = Vector3{(*g)[0], (*g)[1], (*g)[2]};
      },
      "Gravity [m/s^2], default 9.81 against the up axis")
      ->type_name("X,Y,Z");
  CLI::Option* fixed = app.add_flag_callback(
      "--fixed-base", [&options] { options.base = Base::Fixed; },
      "Fix the top of models with links (default)");
  app.add_flag_callback(
         "--floating-base", [&options] { options.base = Base::Floating; },
         "Let the top of models with links move freely")
      ->excludes(fixed);
  app.add_flag("--free-joints", options.free_joints,
               "Leave out limits and dry friction of joints; damping stays");
}

}  // namespace

void add_run_command(CLI::App& program, Command& chosen) {
  const auto options = std::make_shared<RunOptions>();
  CLI::App* app = program.add_subcommand(
      "run", "Simulate some nodes of models while others stay animated, and write what happens");
  add_what(*app, *options);
  add_time(*app, *options);
  add_world(*app, *options);
  app->add_option("--out", options->out, "Write the trajectory to this file (repeatable)")
      ->type_name("FILE.csv|.json")
      ->check(complaint_about_trajectory_file)
      ->allow_extra_args(false);
  add_common_options(*app, options->common);
  app->callback([app, options, &chosen] {
    for (const ToggleArgument& toggle : options->toggles)
      if (toggle.time > options->duration)
        throw CLI::ValidationError("--toggle",
                                   "the toggle of '" + toggle.path + "' lies beyond the duration");
    if (app->count("--tolerance") > 0 && make_integrator(options->integrator, options->tolerance) == nullptr)
      throw CLI::ValidationError(
          "--tolerance",
          "only dormand-prince, gauss8, gauss16 and radau have a tolerance, not " + options->integrator);
    if (options->adaptive && make_integrator(options->integrator, options->tolerance) == nullptr)
      throw CLI::ValidationError(
          "--adaptive",
          "needs --integrator dormand-prince, gauss8, gauss16 or radau, not " + options->integrator);
    chosen = [options] { return run(*options); };
  });
}

}  // namespace pantin::cli

// `pantin solve FILE...`: reference problems, with errors beside cost.
#include <CLI/CLI.hpp>
#include <iostream>

#include <pantin/bridge/cli/arguments.hpp>
#include <pantin/bridge/cli/command.hpp>
#include <pantin/bridge/cli/ledger_text.hpp>
#include <pantin/bridge/cli/text_table.hpp>
#include <pantin/bridge/problems/rigid_ref.hpp>
#include <pantin/bridge/problems/solve.hpp>
#include <pantin/bridge/writers/json_stream.hpp>

namespace pantin::cli {
namespace {

struct SolveOptions {
  std::vector<std::string> files{};
  SolveSettings settings{};
  bool json{false};
  bool states{false};
  bool strict{false};  ///< warnings are errors
};

SolveResult refused(const std::string& file, const std::vector<Diagnostic>& notes,
                    const SolveOptions& options) {
  SolveResult result{.problem = std::filesystem::path{file}.stem().string(),
                     .status = SolveStatus::Refused,
                     .integrator = options.settings.integrator};
  for (const Diagnostic& note : notes) {
    if (note.severity == Severity::Error) result.messages.push_back(to_string(note));
  }
  return result;
}

void number_or_null(JsonStream& json, std::string_view name, const std::optional<double>& number) {
  json.key(name);
  if (number) json.value(*number);
  else json.null();
}

void write_states(JsonStream& json, const std::vector<SolvedState>& states) {
  json.key("states").begin_array();
  for (const SolvedState& state : states) {
    json.begin_object().member("t", state.t).key("bodies").begin_object();
    for (const reference::Body& body : state.bodies) {
      json.key(body.name).begin_object();
      json.member("position_cog", body.X_WB.p).member("quaternion_wxyz", body.X_WB.q);
      json.member("velocity_cog", body.v_WBcm).member("angular_velocity_world", body.w_WB).end_object();
    }
    json.end_object().key("particles").begin_object();
    for (const reference::Particle& particle : state.particles) {
      json.key(particle.name).begin_object();
      json.member("position", particle.p_W).member("velocity", particle.v_W).end_object();
    }
    json.end_object().end_object();
  }
  json.end_array();
}

/// One object on a line of its own.
void write_json(const SolveResult& result, const SolveOptions& options) {
  JsonStream json{std::cout};
  json.begin_object();
  json.member("problem", result.problem).member("status", to_string(result.status));
  json.member("integrator", result.integrator);
  if (options.settings.step) json.member("step", *options.settings.step);
  else json.member("tolerance", options.settings.tolerance);
  number_or_null(json, "position_error_m", result.position_error);
  number_or_null(json, "attitude_error_rad", result.attitude_error);
  number_or_null(json, "velocity_error_mps", result.velocity_error);
  number_or_null(json, "energy_drift_relative", result.energy_drift);
  json.member("joint_drift_m", result.joint_drift);
  json.member("steps", static_cast<std::int64_t>(result.steps));
  json.member("evaluations", static_cast<std::int64_t>(result.evaluations));
  json.member("cpu_seconds", result.cpu_seconds);
  json.key("islands").begin_array();
  for (const IslandChoice& island : result.islands) {
    json.begin_object().key("bodies").begin_array();
    for (const std::string& name : island.bodies) json.value(name);
    json.end_array().member("solver", island.solver).member("reason", island.reason);
    json.member("shares_steps", island.shares_steps).end_object();
  }
  json.end_array().key("messages").begin_array();
  for (const std::string& message : result.messages) json.value(message);
  json.end_array();
  if (options.states) write_states(json, result.states);
  json.end_object();
  std::cout.flush();
}

std::string cell(const std::optional<double>& number) { return number ? short_number(*number) : "-"; }

void print_states(const SolveResult& result) {
  TextTable table;
  table.add(
      {"t [s]", "name", "position [m]", "quaternion w,x,y,z", "velocity [m/s]", "angular velocity [rad/s]"});
  const auto numbers = [](std::initializer_list<double> xs) {
    std::string text;
    for (const double x : xs) text += (text.empty() ? "" : ",") + short_number(x);
    return text;
  };
  const auto vector = [&](const Vector3& v) { return numbers({v.x(), v.y(), v.z()}); };
  for (const SolvedState& state : result.states) {
    for (const reference::Body& body : state.bodies) {
      const Quaternion& q = body.X_WB.q;
      table.add({short_number(state.t), body.name, vector(body.X_WB.p), numbers({q.w(), q.x(), q.y(), q.z()}),
                 vector(body.v_WBcm), vector(body.w_WB)});
    }
    for (const reference::Particle& particle : state.particles) {
      table.add({short_number(state.t), particle.name, vector(particle.p_W), "", vector(particle.v_W), ""});
    }
  }
  table.print(std::cout, "  ");
}

void print(const SolveResult& result, const SolveOptions& options) {
  std::cout << printable(result.problem) << ": " << to_string(result.status);
  if (result.status != SolveStatus::Refused) std::cout << ", " << result.integrator;
  std::cout << '\n';
  if (result.status != SolveStatus::Refused) {
    TextTable table;
    table.add({"position error [m]", cell(result.position_error)});
    table.add({"attitude error [rad]", cell(result.attitude_error)});
    table.add({"velocity error [m/s]", cell(result.velocity_error)});
    table.add({"energy drift, relative", cell(result.energy_drift)});
    table.add({"joint drift [m]", short_number(result.joint_drift)});
    table.add({"steps", std::to_string(result.steps)});
    table.add({"evaluations", std::to_string(result.evaluations)});
    table.add({"processor time [s]", short_number(result.cpu_seconds)});
    for (const IslandChoice& island : result.islands) {
      table.add(
          {"island of " + counted(island.bodies.size(), "body", "bodies") + " from " + island.bodies.front(),
           island.solver + ": " + island.reason});
    }
    table.print(std::cout, "  ");
  }
  if (options.states) print_states(result);
  for (const std::string& message : result.messages) std::cerr << printable(message) << '\n';
  std::cout.flush();
}

ExitCode run_solve(const SolveOptions& options) {
  ExitCode code = ExitCode::Fine;
  for (const std::string& file : options.files) {
    Loaded<ReferenceProblem> problem = load_rigid_ref(file);
    if (options.strict) make_strict(problem.notes);
    const bool is_usable = problem.value && !has_error(problem.notes);
    SolveResult result =
        is_usable ? solve(*problem.value, options.settings) : refused(file, problem.notes, options);
    for (const Diagnostic& note : problem.notes)
      if (note.severity == Severity::Warning) result.messages.push_back(to_string(note));
    if (options.json) write_json(result, options);
    else print(result, options);
    if (result.status == SolveStatus::Refused && code == ExitCode::Fine) code = ExitCode::BadInput;
    if (result.status == SolveStatus::Failed) code = ExitCode::NumericalFailure;
  }
  return code;
}

}  // namespace

void add_solve_command(CLI::App& program, Command& chosen) {
  const auto options = std::make_shared<SolveOptions>();
  CLI::App* app = program.add_subcommand(
      "solve", "Solve reference problems (schema rigid-ref/1) and say how far off and at what cost");
  SolveSettings& settings = options->settings;
  app->add_option("FILE", options->files, "Problem files")->required();
  std::vector<std::string> names = integrator_names();
  names.insert(names.begin(), "auto");
  app->add_option("--integrator", settings.integrator, "Integrator, default auto")
      ->check(CLI::IsMember(names));
  CLI::Option* step = app->add_option_function<std::string>(
      "--step", [&settings](const std::string& text) { settings.step = parse_number(text); },
      "Take steps of this length [s], shortened to land on samples");
  step->check(complaint_about_positive)->type_name("DT");
  app->add_option_function<std::string>(
         "--tolerance",
         [&settings](const std::string& text) {
           settings.tolerance = parse_number(text).value_or(settings.tolerance);
         },
         "Error that may be made a second [m] and [rad], default 1e-9")
      ->check(complaint_about_positive)
      ->type_name("TOL")
      ->excludes(step);
  app->add_option("--repeats", settings.repeats, "Runs to take the least time of, default 1")
      ->check(CLI::Range(1, 1000000));
  app->add_flag("--strict", options->strict, "Treat warnings about the file as errors");
  app->add_flag("--states", options->states, "Give the full state at every sample time");
  app->add_flag("--json", options->json, "One JSON object a problem, each on a line");
  app->callback([options, &chosen] {
    if (const auto problem = problem_with(options->settings))
      throw CLI::ValidationError("--integrator", problem->text + "; " + problem->remedy);
    chosen = [options] { return run_solve(*options); };
  });
}

}  // namespace pantin::cli

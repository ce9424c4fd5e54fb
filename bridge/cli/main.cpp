// The program `pantin`: picks the command and turns whatever happens into an exit code. Nothing is thrown out
// of it.
#include <poll.h>
#include <unistd.h>
#include <CLI/CLI.hpp>
#include <csignal>
#include <exception>
#include <iostream>
#include <stdexcept>

#include <pantin/bridge/cli/command.hpp>
#include <pantin/bridge/diagnostic.hpp>
#include <pantin/bridge/writers/output_file.hpp>
#include <pantin/scenegraph/expects.hpp>

namespace pantin::cli {
namespace {

constexpr const char* kFooter =
    "Exit codes: 0 fine, 1 bad input, 2 bad usage, 3 numerical failure.\n"
    "SI units and radians everywhere; quaternions are w,x,y,z.";

void describe(CLI::App& program, Command& chosen) {
  program.name("pantin");
  program.description("Loads models, hands their nodes to physics and back, and writes what happens.");
  program.footer(kFooter);
  program.set_version_flag("--version", "pantin " PANTIN_VERSION);
  program.require_subcommand(1);
  program.failure_message([](const CLI::App* app, const CLI::Error& error) {
    const std::vector<std::string> rest = app->remaining();
    const bool no_command = app->get_subcommands().empty() && !rest.empty();
    return "pantin: error: " +
           (no_command ? "'" + printable(rest.front()) + "' is no command" : error.what()) + "\nRun '" +
           app->get_name() + " --help' for what can be said here.\n";
  });
  add_info_command(program, chosen);
  add_check_command(program, chosen);
  add_run_command(program, chosen);
#ifdef PANTIN_HAS_PROBLEMS
  add_solve_command(program, chosen);
#endif
}

bool reader_went_away() {
  pollfd output{.fd = STDOUT_FILENO, .events = POLLOUT, .revents = 0};
  return poll(&output, 1, 0) == 1 && (output.revents & POLLERR) != 0;
}

/// A reader of our output that went away has seen enough; any other failure to write is an error.
ExitCode with_output_written(ExitCode code) {
  std::cout.flush();
  if (std::cout || reader_went_away()) return code;
  std::cerr << "pantin: error: standard output could not be written completely" << std::endl;
  return code == ExitCode::Fine ? ExitCode::BadInput : code;
}

/// A broken contract is a mistake of this program: it is reported like one, not by a core dump.
void throw_on_violation(const ContractViolation& violation) {
  throw std::logic_error{violation.what + " [" + violation.expression + "]"};
}

/// Files appear whole or not at all, also where the user breaks off; then the signal does what it always
/// does.
void end_without_traces(int signal) {
  remove_unfinished_files();
  std::signal(signal, SIG_DFL);
  std::raise(signal);
}

ExitCode run(int argc, char** argv) {
  contract_handler() = &throw_on_violation;
  std::signal(SIGPIPE, SIG_IGN);                      // writing to a closed pipe fails like any other write
  for (const int signal : {SIGINT, SIGTERM, SIGHUP})  // not where the caller has them ignored, as nohup does
    if (std::signal(signal, &end_without_traces) == SIG_IGN) std::signal(signal, SIG_IGN);
  std::ios::sync_with_stdio(false);
  CLI::App program;
  Command chosen;
  describe(program, chosen);
  try {
    program.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    const bool is_answer = program.exit(error, std::cout, std::cerr) == 0;  // help or version
    return with_output_written(is_answer ? ExitCode::Fine : ExitCode::BadUsage);
  }
  return with_output_written(chosen());
}

}  // namespace
}  // namespace pantin::cli

int main(int argc, char** argv) {
  try {
    return static_cast<int>(pantin::cli::run(argc, argv));
  } catch (const std::exception& error) {
    std::cerr << "pantin: internal error: " << error.what() << std::endl;
  } catch (...) {
    std::cerr << "pantin: internal error" << std::endl;
  }
  return static_cast<int>(pantin::cli::ExitCode::BadInput);
}

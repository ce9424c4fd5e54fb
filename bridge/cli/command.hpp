#pragma once
// What the commands of the program have in common: each adds itself to the parser and, if it is the one that
// was given, puts itself into `chosen`, to be run when parsing is over.
#include <functional>

#include <pantin/bridge/cli/exit_code.hpp>

namespace CLI {
class App;
}

namespace pantin::cli {

using Command = std::function<ExitCode()>;

/// `pantin info MODEL`: what a model file holds, in the file's own frame.
void add_info_command(CLI::App& program, Command& chosen);
/// `pantin check MODEL...`: whether files can be used, and what had to be changed or left out.
void add_check_command(CLI::App& program, Command& chosen);
/// `pantin run MODEL...`: simulates some nodes, animates others, and writes what happens.
void add_run_command(CLI::App& program, Command& chosen);
/// `pantin solve FILE...`: runs reference problems and measures errors beside cost.
void add_solve_command(CLI::App& program, Command& chosen);

}  // namespace pantin::cli

#include <CLI/CLI.hpp>
#include <algorithm>
#include <iostream>

#include <pantin/bridge/cli/command.hpp>
#include <pantin/bridge/cli/common_options.hpp>
#include <pantin/bridge/cli/ledger_text.hpp>
#include <pantin/bridge/cli/text_table.hpp>
#include <pantin/bridge/loaders/load_model.hpp>
#include <pantin/bridge/writers/ledger_json.hpp>

namespace pantin::cli {
namespace {

struct CheckOptions {
  CommonOptions common{};
  std::vector<std::string> files{};
};

CheckedFile check(const std::string& file, const CommonOptions& options) {
  Loaded<Model> loaded = load(file, options);
  return {.file = file, .ok = loaded.value.has_value(), .ledger = std::move(loaded.notes)};
}

void print_line(const CheckedFile& checked) {
  const auto count = [&](Severity severity) {
    return static_cast<std::size_t>(
        std::count_if(checked.ledger.begin(), checked.ledger.end(),
                      [=](const Diagnostic& note) { return note.severity == severity; }));
  };
  std::cout << printable(checked.file) << ": " << (checked.ok ? "ok" : "failed");
  if (const std::size_t n = count(Severity::Error)) std::cout << ", " << counted(n, "error", "errors");
  if (const std::size_t n = count(Severity::Warning)) std::cout << ", " << counted(n, "warning", "warnings");
  if (const std::size_t n = count(Severity::Note)) std::cout << ", " << counted(n, "note", "notes");
  std::cout << '\n';
  print_remarks(std::cout, checked.ledger);
  std::cout.flush();
}

ExitCode run_check(const CheckOptions& options) {
  std::vector<CheckedFile> results;
  for (const std::string& file : options.files) {
    results.push_back(check(file, options.common));
    if (!options.common.json) print_line(results.back());
    print_errors(results.back().ledger);
  }
  if (options.common.json) write_check_json(std::cout, results);
  const bool all_ok =
      std::all_of(results.begin(), results.end(), [](const CheckedFile& file) { return file.ok; });
  return all_ok ? ExitCode::Fine : ExitCode::BadInput;
}

}  // namespace

void add_check_command(CLI::App& program, Command& chosen) {
  const auto options = std::make_shared<CheckOptions>();
  CLI::App* app = program.add_subcommand(
      "check", "Load files and say whether each can be used, and what was changed or left out on reading");
  app->add_option("MODEL", options->files, "Model files")->required();
  add_common_options(*app, options->common);
  app->callback([options, &chosen] { chosen = [options] { return run_check(*options); }; });
}

}  // namespace pantin::cli

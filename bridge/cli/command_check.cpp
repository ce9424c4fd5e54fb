#include <CLI/CLI.hpp>
#include <algorithm>
#include <fstream>
#include <iostream>

#include <pantin/bridge/cli/command.hpp>
#include <pantin/bridge/cli/common_options.hpp>
#include <pantin/bridge/cli/ledger_text.hpp>
#include <pantin/bridge/cli/text_table.hpp>
#include <pantin/bridge/input_file.hpp>
#include <pantin/bridge/loaders/load_model.hpp>
#ifdef PANTIN_HAS_PROBLEMS
#include <pantin/bridge/problems/rigid_ref.hpp>
#endif
#include <pantin/bridge/writers/ledger_json.hpp>

namespace pantin::cli {
namespace {

struct CheckOptions {
  CommonOptions common{};
  std::vector<std::string> files{};
  bool verbose{false};  ///< every element and attribute
};

#ifdef PANTIN_HAS_PROBLEMS
/// Problems are JSON that names its schema near the beginning; a model in a file of that name is glTF.
bool is_problem(const std::string& file) {
  if (lower_extension(file) != ".json") return false;
  std::string head(4096, '\0');
  std::ifstream stream{file, std::ios::binary};
  stream.read(head.data(), static_cast<std::streamsize>(head.size()));
  return head.find("\"rigid-ref/") != std::string::npos;
}
#endif

CheckedFile check(const std::string& file, const CommonOptions& options) {
  CheckedFile checked{.file = file};
#ifdef PANTIN_HAS_PROBLEMS
  if (is_problem(file)) {
    const Loaded<ReferenceProblem> problem = load_rigid_ref(file, &checked.account);
    checked.ledger = problem.notes;
    if (options.strict) make_strict(checked.ledger);
    checked.ok = problem.value && !has_error(checked.ledger);
    return checked;
  }
#endif
  Loaded<Model> loaded = load(file, options, &checked.account);
  checked.ok = loaded.value.has_value();
  checked.ledger = std::move(loaded.notes);
  return checked;
}

/// A file of which all is in the model needs no words, unless every entry is asked for.
void print_account(const Account& account, bool every) {
  const std::array<std::size_t, kFates> counts = count_fates(account);
  std::size_t all = 0;
  std::string list;
  for (std::size_t i = 0; i < kFates; ++i) {
    all += counts[i];
    if (counts[i] == 0) continue;
    list += (list.empty() ? ": " : ", ") + std::to_string(counts[i]) + ' ' +
            std::string{to_string(static_cast<Fate>(i))};
  }
  if (all == 0 || (!every && counts[static_cast<std::size_t>(Fate::Read)] == all)) return;
  std::cout << "  " << counted(all, "element or attribute", "elements and attributes") << list << '\n';
  if (!every) return;
  for (const AccountEntry& entry : account) std::cout << "    " << to_string(entry) << '\n';
}

void print_line(const CheckedFile& checked, bool verbose) {
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
  print_account(checked.account, verbose);
  std::cout.flush();
}

ExitCode run_check(const CheckOptions& options) {
  std::vector<CheckedFile> results;
  for (const std::string& file : options.files) {
    results.push_back(check(file, options.common));
    if (!options.common.json) print_line(results.back(), options.verbose);
    print_errors(results.back().ledger);
  }
  if (options.common.json)
    write_check_json(std::cout, results, options.verbose ? AccountDetail::Every : AccountDetail::Counts);
  const bool all_ok =
      std::all_of(results.begin(), results.end(), [](const CheckedFile& file) { return file.ok; });
  return all_ok ? ExitCode::Fine : ExitCode::BadInput;
}

}  // namespace

void add_check_command(CLI::App& program, Command& chosen) {
  const auto options = std::make_shared<CheckOptions>();
  CLI::App* app = program.add_subcommand(
      "check", "Load files and say whether each can be used, and what was changed or left out on reading");
  app->add_option("FILE", options->files, "Model files, or problem files of schema rigid-ref/1")->required();
  app->add_flag("--verbose", options->verbose, "List what became of every element and attribute");
  add_common_options(*app, options->common);
  app->callback([options, &chosen] { chosen = [options] { return run_check(*options); }; });
}

}  // namespace pantin::cli

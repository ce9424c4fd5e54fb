#include <pantin/bridge/cli/common_options.hpp>

#include <CLI/CLI.hpp>
#include <iostream>

#include <pantin/bridge/loaders/load_model.hpp>
#include <pantin/bridge/writers/ledger_json.hpp>

namespace pantin::cli {

void add_common_options(CLI::App& app, CommonOptions& options) {
  app.add_flag("--json", options.json,
               "Print the result as JSON on standard output; errors stay on standard error");
  app.add_flag("--strict", options.strict, "Treat warnings as errors");
  app.add_option("--package-path", options.package_paths,
                 "Folder to search first for package:// (repeatable)")
      ->type_name("DIR")
      ->allow_extra_args(false);
}

Loaded<Model> load(const std::string& file, const CommonOptions& options, Account* account) {
  LoadOptions load_options{.account = account};
  for (const std::string& path : options.package_paths) load_options.package_paths.emplace_back(path);
  Loaded<Model> loaded = load_model(file, load_options);
  if (options.strict) make_strict(loaded.notes);
  if (has_error(loaded.notes)) loaded.value.reset();
  return loaded;
}

ExitCode fail(const CommonOptions& options, const Ledger& ledger) {
  print_errors(ledger.notes());
  if (options.json) write_failure_json(std::cout, ledger.notes());
  return ExitCode::BadInput;
}

}  // namespace pantin::cli

#pragma once
// What every command has: --json, --strict, --package-path; and loading as they say.
#include <string>
#include <vector>

#include <pantin/bridge/account.hpp>
#include <pantin/bridge/cli/exit_code.hpp>
#include <pantin/bridge/cli/ledger_text.hpp>
#include <pantin/bridge/diagnostic.hpp>
#include <pantin/bridge/model.hpp>

namespace CLI {
class App;
}

namespace pantin::cli {

struct CommonOptions {
  bool json{false};                          ///< results as JSON on standard output
  bool strict{false};                        ///< warnings are errors
  std::vector<std::string> package_paths{};  ///< where package:// is looked up first
};

void add_common_options(CLI::App& app, CommonOptions& options);

/// load_model, with warnings made errors where asked for; a model with an error is no value. `account` gets
/// what became of every element and attribute; it may be null.
[[nodiscard]] Loaded<Model> load(const std::string& file, const CommonOptions& options,
                                 Account* account = nullptr);

/// Says what went wrong, as JSON on standard output too where that was asked for: {"ledger": [...]}.
[[nodiscard]] ExitCode fail(const CommonOptions& options, const Ledger& ledger);

}  // namespace pantin::cli

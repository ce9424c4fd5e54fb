// Damages the shipped models, thousands of times for each format, and loads the results in one process:
//
//     pantin_mutations [--count N] [--first K] [--seed S] [FORMAT...]
//
// Prints a table and ends with 1 where anything was not as promised: a model beside an error, an error
// without place, a model that cannot be used, a load of more than 5 s. A crash or a leak (under the address
// sanitizer) ends the process by itself, and damaged.FORMAT in the working folder is then the file that did
// it; --first K --count 1 with the same seed makes it anew.
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <map>
#include <optional>
#include <vector>

#include <pantin/bridge/loaders/load_model.hpp>
#ifdef PANTIN_HAS_PROBLEMS
#include <pantin/bridge/problems/rigid_ref.hpp>
#endif

#include "mutation.hpp"
#include "use_model.hpp"

namespace {

namespace fs = std::filesystem;
using pantin::Diagnostic;

constexpr double kHang = 5;  ///< [s]

struct Options {
  std::uint64_t count{200};
  std::uint64_t first{0};
  std::uint64_t seed{1};
  std::vector<std::string> formats{};
};

/// The outcome of one load; `problem` is empty where all is as promised.
struct Outcome {
  bool loaded{false};
  std::string problem{};
};

Outcome load_one(const fs::path& file) {
  // Processes are cut off well before what counts as a hang.
  pantin::Account account;
  const pantin::Loaded<pantin::Model> loaded =
      pantin::load_model(file, {.package_paths = {PANTIN_SOURCE_DIR "/assets"},
                                .import = {.cpu_s = 1, .wall_s = 0.6 * kHang},
                                .account = &account});
  Outcome outcome{loaded.value.has_value(),
                  pantin::test::problem_with_ledger(loaded.value.has_value(), loaded.notes, file.string())};
  if (account.empty() == outcome.loaded)
    outcome.problem += outcome.loaded ? "no account" : "an account of nothing";
  if (outcome.problem.empty() && loaded.value) outcome.problem = pantin::test::use(*loaded.value);
  return outcome;
}

Outcome load_problem([[maybe_unused]] const fs::path& file) {
#ifdef PANTIN_HAS_PROBLEMS
  pantin::Account account;
  const auto loaded = pantin::load_rigid_ref(file, &account);
  Outcome outcome{loaded.value.has_value(),
                  pantin::test::problem_with_ledger(loaded.value.has_value(), loaded.notes, file.string())};
  if (account.empty() == outcome.loaded)
    outcome.problem += outcome.loaded ? "no account" : "an account of nothing";
  if (outcome.problem.empty() && loaded.value) {
    pantin::PhysicsManager physics;
    (void)pantin::instantiate(*loaded.value, physics);
  }
  return outcome;
#else
  return {};
#endif
}

/// Shipped models by format.
std::map<std::string, std::vector<fs::path>> seeds() {
  std::map<std::string, std::vector<fs::path>> all;
  for (const char* folder : {"assets", "assets/meshes", "assets/problems", "tests/loaders/data"}) {
    for (const auto& entry : fs::directory_iterator{fs::path{PANTIN_SOURCE_DIR} / folder}) {
      std::string format = entry.path().extension().string();
      if (entry.is_regular_file() && format.size() > 1) all[format.substr(1)].push_back(entry.path());
    }
  }
  for (const char* other : {"md", "py", "txt"}) all.erase(other);
#ifndef PANTIN_HAS_PROBLEMS
  all.erase("json");
#endif
  for (auto& [format, files] : all) std::sort(files.begin(), files.end());
  return all;
}

std::string content_of(const fs::path& file) {
  std::ifstream stream{file, std::ios::binary};
  return {std::istreambuf_iterator<char>{stream}, {}};
}

/// Says which input hangs for good.
extern "C" void hang(int) {
  constexpr std::string_view kText = "a load does not end; its file is left as damaged.FORMAT\n";
  (void)!write(STDERR_FILENO, kText.data(), kText.size());
  _exit(1);
}

struct Sums {
  std::uint64_t loaded{0};
  std::uint64_t refused{0};
  std::uint64_t wrong{0};
  double longest{0};  ///< [s]
};

Sums run_format(const std::string& format, const std::vector<fs::path>& files, const Options& options) {
  std::vector<std::string> contents;
  for (const fs::path& file : files) contents.push_back(content_of(file));
  const fs::path damaged = fs::current_path() / ("damaged." + format);
  Sums sums;
  for (std::uint64_t i = options.first; i < options.first + options.count; ++i) {
    std::mt19937_64 random{options.seed * 1'000'003 + i};
    std::ofstream{damaged, std::ios::binary}
        << pantin::test::mutated(contents[static_cast<std::size_t>(random() % contents.size())], random);
    alarm(60);
    const auto begin = std::chrono::steady_clock::now();
    Outcome outcome = format == "json" ? load_problem(damaged) : load_one(damaged);
    const double took = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    alarm(0);
    sums.longest = std::max(sums.longest, took);
    ++(outcome.loaded ? sums.loaded : sums.refused);
    if (outcome.problem.empty() && took > kHang) outcome.problem = "took " + std::to_string(took) + " s";
    if (outcome.problem.empty()) continue;
    ++sums.wrong;
    std::printf("%s, damage %llu of seed %llu: %s\n", format.c_str(), static_cast<unsigned long long>(i),
                static_cast<unsigned long long>(options.seed), outcome.problem.c_str());
  }
  fs::remove(damaged);
  return sums;
}

std::optional<Options> options_of(int argc, char** argv) {
  Options options;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    std::uint64_t* number = word == "--count"   ? &options.count
                            : word == "--first" ? &options.first
                            : word == "--seed"  ? &options.seed
                                                : nullptr;
    if (number == nullptr) {
      options.formats.push_back(word);
    } else if (++i == argc ||
               std::from_chars(argv[i], argv[i] + std::strlen(argv[i]), *number).ec != std::errc{}) {
      return std::nullopt;
    }
  }
  return options;
}

}  // namespace

int main(int argc, char** argv) {
  const std::optional<Options> options = options_of(argc, argv);
  const auto all = seeds();
  bool known = options.has_value();
  for (const std::string& format : options ? options->formats : std::vector<std::string>{})
    known = known && all.contains(format);
  if (!known) {
    std::fputs("usage: pantin_mutations [--count N] [--first K] [--seed S] [FORMAT...]; formats:", stderr);
    for (const auto& [format, files] : all) std::fprintf(stderr, " %s", format.c_str());
    std::fputs("\n", stderr);
    return 2;
  }
  std::signal(SIGALRM, hang);
  std::printf(
      "| format | damaged files | loaded | refused | not as promised | longest [s] "
      "|\n|---|---|---|---|---|---|\n");
  std::uint64_t wrong = 0;
  for (const auto& [format, files] : all) {
    const auto& chosen = options->formats;
    if (!chosen.empty() && std::find(chosen.begin(), chosen.end(), format) == chosen.end()) continue;
    const Sums sums = run_format(format, files, *options);
    wrong += sums.wrong;
    std::printf("| %s | %llu | %llu | %llu | %llu | %.2f |\n", format.c_str(),
                static_cast<unsigned long long>(options->count), static_cast<unsigned long long>(sums.loaded),
                static_cast<unsigned long long>(sums.refused), static_cast<unsigned long long>(sums.wrong),
                sums.longest);
    std::fflush(stdout);
  }
  return wrong == 0 ? 0 : 1;
}

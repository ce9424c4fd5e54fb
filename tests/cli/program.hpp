#pragma once
// Runs the built program as its users do, and makes the small models that tests run it on.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>
#include <csignal>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "support/temporary_folder.hpp"

namespace pantin::test {

using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

/// How a run of the program ended.
struct Ran {
  int code{-1};   ///< exit code; -1 where it did not exit by itself
  int signal{0};  ///< that ended it; 0 = none
  std::string out{};
  std::string err{};

  [[nodiscard]] Json json() const {
    const Json parsed = Json::parse(out, nullptr, false);
    EXPECT_FALSE(parsed.is_discarded()) << "not JSON: " << out.substr(0, 500) << "\nstderr: " << err;
    return parsed;
  }
  [[nodiscard]] bool says(const std::string& text) const { return err.find(text) != std::string::npos; }
};

/// A run of build/.../bin/pantin that goes on by itself.
class Running {
 public:
  /// Standard output goes to `out_file` where it is given.
  explicit Running(std::vector<std::string> arguments, const std::string& out_file = "")
      : out_{out_file.empty() ? folder_.path("out") : out_file}, is_read_{out_file.empty()} {
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    const std::string err = folder_.path("err");
    posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, out_.c_str(), O_WRONLY | O_CREAT, 0600);
    posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, err.c_str(), O_WRONLY | O_CREAT, 0600);
    std::string program = PANTIN_BINARY_DIR "/bin/pantin";
    std::vector<char*> argv{program.data()};
    for (std::string& argument : arguments) argv.push_back(argument.data());
    argv.push_back(nullptr);
    // Whoever started the tests may have signals ignored, as nohup does; the program shall meet them afresh.
    sigset_t afresh;
    sigemptyset(&afresh);
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) sigaddset(&afresh, signal);
    posix_spawnattr_t attributes;
    posix_spawnattr_init(&attributes);
    posix_spawnattr_setsigdefault(&attributes, &afresh);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGDEF);
    if (posix_spawn(&child_, program.c_str(), &actions, &attributes, argv.data(), environ) != 0) child_ = 0;
    posix_spawnattr_destroy(&attributes);
    posix_spawn_file_actions_destroy(&actions);
  }

  void send(int signal) const {
    if (child_ > 0) kill(child_, signal);
  }
  /// Waits for its end.
  Ran ended() {
    Ran ran;
    int status = 0;
    if (child_ > 0 && waitpid(std::exchange(child_, 0), &status, 0) > 0) {
      if (WIFEXITED(status)) ran.code = WEXITSTATUS(status);
      if (WIFSIGNALED(status)) ran.signal = WTERMSIG(status);
    }
    if (is_read_) ran.out = content_of(out_);
    ran.err = content_of(folder_.path("err"));
    return ran;
  }

 private:
  TemporaryFolder folder_{};
  std::string out_;
  bool is_read_;
  pid_t child_{0};
};

/// Runs the program to its end.
inline Ran pantin(std::vector<std::string> arguments, const std::string& out_file = "") {
  return Running{std::move(arguments), out_file}.ended();
}

}  // namespace pantin::test

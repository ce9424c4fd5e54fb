#include <pantin/bridge/loaders/import_process.hpp>

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <vector>

namespace pantin {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int kResultDescriptor = 3;
constexpr int kLowest = 10;  ///< of our own descriptors, out of the way of those that the program gets

/// One end of a pipe; closed with its owner.
class Descriptor {
 public:
  Descriptor() = default;
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor() { reset(); }
  /// Takes over `fd`, moved up to where it collides with nothing; false where there is no room for it.
  bool take(int fd) {
    reset();
    fd_ = fcntl(fd, F_DUPFD_CLOEXEC, kLowest);
    const int problem = errno;
    close(fd);
    errno = problem;
    return fd_ >= 0;
  }
  void reset() {
    if (fd_ >= 0) close(fd_);
    fd_ = -1;
  }
  [[nodiscard]] int get() const { return fd_; }

 private:
  int fd_{-1};
};

struct Pipe {
  Descriptor read;
  Descriptor write;
  /// 0 or errno.
  int open() {
    std::array<int, 2> ends{};
    if (pipe2(ends.data(), O_CLOEXEC) != 0) return errno;
    const bool first = read.take(ends[0]);
    const int problem = first ? 0 : errno;
    return write.take(ends[1]) && first ? 0 : (problem != 0 ? problem : errno);
  }
};

/// Ends and reaps the program unless it was waited for.
class Child {
 public:
  explicit Child(pid_t pid) : pid_{pid} {}
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;
  ~Child() {
    if (!kill_and_wait_) return;
    kill(pid_, SIGKILL);
    int status = 0;
    while (waitpid(pid_, &status, 0) < 0 && errno == EINTR) {
    }
  }
  /// Whether it has ended by now; then `end` and `detail` are filled.
  bool has_ended(ProcessResult& into) {
    int status = 0;
    const pid_t got = waitpid(pid_, &status, WNOHANG);
    if (got == 0 || (got < 0 && errno == EINTR)) return false;
    kill_and_wait_ = false;
    if (got < 0) {
      into.end = ProcessEnd::Unseen;
    } else if (WIFSIGNALED(status)) {
      into.end = ProcessEnd::Signalled;
      into.detail = WTERMSIG(status);
    } else {
      into.end = ProcessEnd::Exited;
      into.detail = WEXITSTATUS(status);
    }
    return true;
  }

 private:
  pid_t pid_;
  bool kill_and_wait_{true};
};

/// Starts the program; 0 or errno.
int start(const std::filesystem::path& program, std::span<const std::string> arguments, int noise, int result,
          pid_t& pid) {
  const std::string name = program.string();
  std::vector<char*> argv{const_cast<char*>(name.c_str())};  // posix_spawn takes them so, and changes nothing
  for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
  argv.push_back(nullptr);

  posix_spawn_file_actions_t files;
  if (const int problem = posix_spawn_file_actions_init(&files)) return problem;
  posix_spawnattr_t attributes;
  if (const int problem = posix_spawnattr_init(&attributes)) {
    posix_spawn_file_actions_destroy(&files);
    return problem;
  }
  sigset_t none;
  sigset_t usual;  // a host may ignore these; the program must die of them
  sigemptyset(&none);
  sigemptyset(&usual);
  for (const int signal : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGPIPE, SIGXCPU, SIGXFSZ, SIGTERM})
    sigaddset(&usual, signal);
  int problem = 0;
  const auto then = [&problem](int outcome) { problem = problem != 0 ? problem : outcome; };
  then(posix_spawnattr_setsigmask(&attributes, &none));
  then(posix_spawnattr_setsigdefault(&attributes, &usual));
  then(posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF));
  then(posix_spawn_file_actions_addopen(&files, 0, "/dev/null", O_RDONLY, 0));
  then(posix_spawn_file_actions_adddup2(&files, noise, 1));
  then(posix_spawn_file_actions_adddup2(&files, noise, 2));
  then(posix_spawn_file_actions_adddup2(&files, result, kResultDescriptor));
  then(posix_spawn_file_actions_addclosefrom_np(&files, kResultDescriptor + 1));
  if (problem == 0) problem = posix_spawn(&pid, name.c_str(), &files, &attributes, argv.data(), environ);
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&files);
  return problem;
}

/// Milliseconds until `end`, rounded up, for poll.
int until(Clock::time_point end) {
  const auto left = std::chrono::ceil<std::chrono::milliseconds>(end - Clock::now()).count();
  return static_cast<int>(std::clamp<std::int64_t>(left, 0, 60'000));
}

/// Reads what is there; whether the other end is closed.
bool read_some(int fd, std::string& into, std::size_t most) {
  std::array<char, 1 << 16> buffer;  // NOLINT: filled by read
  const ssize_t got = read(fd, buffer.data(), buffer.size());
  if (got < 0) return errno != EINTR && errno != EAGAIN;
  into.append(buffer.data(), std::min(static_cast<std::size_t>(got), most - std::min(most, into.size())));
  return got == 0;
}

/// Collects both pipes until they are closed; false where a limit was met, which `into` then says.
bool collect(Descriptor& result, Descriptor& noise, const ProcessLimits& limits, Clock::time_point end,
             ProcessResult& into) {
  while (result.get() >= 0 || noise.get() >= 0) {
    std::array<pollfd, 2> open{{{result.get(), POLLIN, 0}, {noise.get(), POLLIN, 0}}};  // poll skips -1
    if (poll(open.data(), open.size(), until(end)) > 0) {
      if (open[0].revents != 0 && read_some(result.get(), into.result, limits.result_bytes + 1))
        result.reset();
      if (open[1].revents != 0 && read_some(noise.get(), into.noise, limits.noise_bytes)) noise.reset();
    }
    if (into.result.size() > limits.result_bytes) {
      into.end = ProcessEnd::TooMuch;
      return false;
    }
    if (Clock::now() >= end) {
      into.end = ProcessEnd::TimedOut;
      return false;
    }
  }
  return true;
}

/// A program whose pipes are closed ends at once; one that does not is ended.
void wait_for(Child& child, Clock::time_point end, ProcessResult& into) {
  timespec pause{0, 50'000};
  while (!child.has_ended(into)) {
    if (Clock::now() >= end) {
      into.end = ProcessEnd::TimedOut;
      return;
    }
    nanosleep(&pause, nullptr);
    pause.tv_nsec = std::min<decltype(pause.tv_nsec)>(pause.tv_nsec * 2, 10'000'000);
  }
}

}  // namespace

ProcessResult run_process(const std::filesystem::path& program, std::span<const std::string> arguments,
                          const ProcessLimits& limits) {
  ProcessResult into;
  Pipe result;
  Pipe noise;
  into.detail = result.open();
  if (into.detail == 0) into.detail = noise.open();
  pid_t pid = -1;
  if (into.detail == 0) into.detail = start(program, arguments, noise.write.get(), result.write.get(), pid);
  if (into.detail != 0) return into;
  Child child{pid};
  result.write.reset();
  noise.write.reset();
  const auto end = Clock::now() +
                   std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>{limits.wall_s});
  if (collect(result.read, noise.read, limits, end, into)) wait_for(child, end, into);
  return into;
}

}  // namespace pantin

// pantin-import: parses one file by assimp within limits and writes the answer (import_wire.hpp) to
// descriptor 3. The library starts it (load_assimp.cpp) and lives on where this process does not.
#include <sys/prctl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <assimp/Importer.hpp>
#include <cerrno>
#include <charconv>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <new>
#include <optional>
#include <string>
#include <string_view>

#include <pantin/bridge/loaders/assimp_log.hpp>
#include <pantin/bridge/loaders/assimp_model.hpp>
#include <pantin/bridge/loaders/import_wire.hpp>

namespace {

constexpr int kAnswer = 3;

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool kSanitized = true;  // their shadow memory takes terabytes of address space
#elif defined(__has_feature)
constexpr bool kSanitized = __has_feature(address_sanitizer) || __has_feature(thread_sanitizer);
#else
constexpr bool kSanitized = false;
#endif

/// What the command line asks for: FILE CPU_SECONDS MEMORY_BYTES geometry|hierarchy.
struct Job {
  std::string file;
  std::uint64_t cpu_s{0};
  std::uint64_t memory_bytes{0};
  bool geometry{true};
};

bool read_number(std::string_view text, std::uint64_t& into) {
  const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), into);
  return problem == std::errc{} && end == text.data() + text.size() && into > 0;
}

std::optional<Job> job_of(int argc, char** argv) {
  if (argc != 5) return std::nullopt;
  Job job{.file = argv[1], .geometry = std::string_view{argv[4]} == "geometry"};
  if (!read_number(argv[2], job.cpu_s) || !read_number(argv[3], job.memory_bytes)) return std::nullopt;
  if (!job.geometry && std::string_view{argv[4]} != "hierarchy") return std::nullopt;
  return job;
}

/// CPU time, memory, no core file; and the end of the program that started this one is the end of this one.
void limit(const Job& job) {
  const auto set = [](auto what, rlim_t soft, rlim_t hard) {
    const rlimit wanted{soft, hard};
    if (setrlimit(what, &wanted) != 0) std::perror("pantin-import: setrlimit");
  };
  set(RLIMIT_CORE, 0, 0);
  set(RLIMIT_CPU, job.cpu_s, job.cpu_s + 1);
  if (!kSanitized) set(RLIMIT_AS, job.memory_bytes, job.memory_bytes);
  prctl(PR_SET_PDEATHSIG, SIGKILL);
}

bool write_all(std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = write(kAnswer, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return false;
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
  return true;
}

int print_extensions() {
  std::string all;
  Assimp::Importer{}.GetExtensionList(all);  // "*.3ds;*.obj;..."
  std::puts(all.c_str());
  return 0;
}

/// assimp answers a lack of memory as it answers damage: with a text.
void name_memory_limit(const Job& job, std::vector<pantin::Diagnostic>& notes) {
  for (pantin::Diagnostic& note : notes) {
    if (note.severity != pantin::Severity::Error || note.problem.find("bad_alloc") == std::string::npos)
      continue;
    note.problem = "its parser met the limit of " + std::to_string(job.memory_bytes >> 20) + " MiB of memory";
    note.remedy = "check that the file opens in the program that wrote it; or allow it more (ImportSettings)";
  }
}

/// The bytes to write; a model for which the memory does not suffice twice is an error too.
std::string answer(pantin::Loaded<pantin::Model>& loaded, const Job& job) {
  name_memory_limit(job, loaded.notes);
  try {
    return pantin::encode(loaded);
  } catch (const std::bad_alloc& e) {
    loaded = {{}, {{pantin::Severity::Error, job.file, "file", e.what(), ""}}};
    name_memory_limit(job, loaded.notes);
    return pantin::encode(loaded);
  }
}

}  // namespace

/// Under sanitizers a crash stays a signal, and what assimp forgets to free is its own.
extern "C" const char* __asan_default_options();   // NOLINT: the sanitizer's name
extern "C" const char* __asan_default_options() {  // NOLINT
  return "handle_segv=0:handle_sigbus=0:handle_sigfpe=0:handle_abort=0:abort_on_error=1:detect_leaks=0";
}
extern "C" const char* __tsan_default_options();   // NOLINT
extern "C" const char* __tsan_default_options() {  // NOLINT
  return "handle_segv=0:handle_sigbus=0:handle_sigfpe=0:handle_abort=0";
}

int main(int argc, char** argv) {
  if (argc == 2 && std::string_view{argv[1]} == "--extensions") return print_extensions();
  const std::optional<Job> job = job_of(argc, argv);
  if (!job) {
    std::fputs(
        "usage: pantin-import FILE CPU_SECONDS MEMORY_BYTES geometry|hierarchy 3>ANSWER\n"
        "       pantin-import --extensions\n"
        "Part of the library pantin, which starts it to read a file of a foreign format.\n",
        stderr);
    return 2;
  }
  limit(*job);
  const pantin::assimp_loader::LogCapture log;
  pantin::Loaded<pantin::Model> loaded = pantin::assimp_loader::read_model(job->file, job->geometry);
  log.append_to(loaded.notes, job->file);
  const bool written = write_all(answer(loaded, *job));
  std::fflush(nullptr);
  std::_Exit(written ? 0 : 1);  // the system frees all at once; destructors of a damaged scene may crash
}

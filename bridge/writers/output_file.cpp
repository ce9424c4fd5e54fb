#include <pantin/bridge/writers/output_file.hpp>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>
#include <array>
#include <atomic>
#include <cerrno>
#include <cstring>

namespace pantin {
namespace fs = std::filesystem;
namespace {

// The temporary files that are open now, for the handler of a signal, which gets no argument and may not
// wait for a lock: hence the one list for the process, and of limited length. Beyond it a file is written all
// the same, and left behind where the process is killed.
std::array<std::atomic<const char*>, 64> unfinished{};

std::atomic<const char*>* enlist(const char* file) noexcept {
  for (std::atomic<const char*>& place : unfinished) {
    const char* none = nullptr;
    if (place.compare_exchange_strong(none, file)) return &place;
  }
  return nullptr;
}

}  // namespace

void remove_unfinished_files() noexcept {
  for (const std::atomic<const char*>& place : unfinished) {
    if (const char* file = place.load()) ::unlink(file);
  }
}

struct OutputFile::Impl {
  fs::path named{};      ///< as the user said it
  fs::path target{};     ///< what the name stands for
  fs::path temporary{};  ///< empty once committed
  std::ofstream stream{};
  std::atomic<const char*>* enlisted{nullptr};  ///< holds the characters of `temporary`

  ~Impl() {
    if (temporary.empty()) return;
    stream.close();
    std::error_code ignored;
    fs::remove(temporary, ignored);
    forget();
  }
  /// The temporary file is gone.
  void forget() {
    if (enlisted != nullptr) enlisted->store(nullptr);
    enlisted = nullptr;
    temporary.clear();
  }
};

namespace {

Diagnostic cannot_write(const fs::path& file, const std::string& why) {
  return {Severity::Error, file.string(), "output file", why,
          "name a file in a folder that can be written to"};
}

/// Makes an empty file of a new name beside `target` with the permissions of any new file; 0 or the error.
int create_beside(const fs::path& target, fs::path& temporary) {
  for (int attempt = 0; attempt < 1000; ++attempt) {
    temporary = target;
    temporary += ".part" + std::to_string(getpid()) + (attempt == 0 ? "" : "-" + std::to_string(attempt));
    const int handle = ::open(temporary.c_str(), O_CREAT | O_EXCL | O_WRONLY | O_CLOEXEC, 0666);
    if (handle >= 0) {
      ::close(handle);
      return 0;
    }
    if (errno != EEXIST) return errno;
  }
  return EEXIST;
}

}  // namespace

OutputFile::OutputFile(std::unique_ptr<Impl> impl) : impl_{std::move(impl)} {}
OutputFile::OutputFile(OutputFile&&) noexcept = default;
OutputFile& OutputFile::operator=(OutputFile&&) noexcept = default;
OutputFile::~OutputFile() = default;

std::ostream& OutputFile::stream() noexcept { return impl_->stream; }

Loaded<OutputFile> OutputFile::open(const fs::path& file) {
  auto impl = std::make_unique<Impl>();
  impl->named = file;
  std::error_code error;
  impl->target = fs::is_symlink(file, error) ? fs::weakly_canonical(file, error) : file;
  const fs::file_status status = fs::status(impl->target, error);
  if (fs::is_directory(status)) return {{}, {cannot_write(file, "is a folder")}};
  if (fs::exists(status) && !fs::is_regular_file(status))
    return {{}, {cannot_write(file, "exists and is not a regular file")}};

  fs::path temporary;
  if (const int code = create_beside(impl->target, temporary); code != 0)
    return {{}, {cannot_write(file, std::string{"cannot be created: "} + std::strerror(code))}};
  impl->temporary = std::move(temporary);
  impl->enlisted = enlist(impl->temporary.c_str());
  impl->stream.open(impl->temporary, std::ios::binary | std::ios::trunc);
  if (!impl->stream) return {{}, {cannot_write(file, "cannot be opened for writing")}};
  return {OutputFile{std::move(impl)}, {}};
}

std::optional<Diagnostic> OutputFile::commit() {
  errno = 0;
  impl_->stream.close();
  if (!impl_->stream)
    return cannot_write(impl_->named, std::string{"could not be written completely"} +
                                          (errno != 0 ? std::string{": "} + std::strerror(errno) : ""));
  std::error_code error;
  fs::rename(impl_->temporary, impl_->target, error);
  if (error) return cannot_write(impl_->named, "could not be put in place: " + error.message());
  impl_->forget();
  return std::nullopt;
}

}  // namespace pantin

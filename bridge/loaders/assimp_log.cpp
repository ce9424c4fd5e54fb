#include <pantin/bridge/loaders/assimp_log.hpp>

#include <algorithm>
#include <assimp/DefaultLogger.hpp>
#include <assimp/LogStream.hpp>
#include <utility>

namespace pantin::assimp_loader {
namespace {

constexpr std::size_t kMostKept = 10'000;  ///< a damaged file may complain without end
constexpr std::size_t kMostShown = 5;

class Listener final : public Assimp::LogStream {
 public:
  explicit Listener(std::shared_ptr<std::vector<std::string>> lines) : lines_{std::move(lines)} {}
  void write(const char* message) override {
    if (lines_->size() >= kMostKept) return;
    std::string line{message};
    while (!line.empty() && (line.back() == '\n' || line.back() == ' ')) line.pop_back();
    // assimp writes "Warn,  T0: text".
    if (const std::size_t at = line.find(": "); at != std::string::npos && at < 12) line.erase(0, at + 2);
    lines_->push_back(std::move(line));
  }

 private:
  std::shared_ptr<std::vector<std::string>> lines_;
};

}  // namespace

LogCapture::LogCapture() : lines_{std::make_shared<std::vector<std::string>>()} {
  Assimp::DefaultLogger::create(nullptr, Assimp::Logger::NORMAL, 0);
  auto listener = std::make_unique<Listener>(lines_);
  if (Assimp::DefaultLogger::get()->attachStream(listener.get(), Assimp::Logger::Warn | Assimp::Logger::Err))
    listener.release();  // NOLINT: the logger owns it now
}

LogCapture::~LogCapture() { Assimp::DefaultLogger::kill(); }

void LogCapture::append_to(std::vector<Diagnostic>& notes, const std::string& place) const {
  std::size_t shown = 0;
  std::size_t more = 0;
  for (const std::string& line : *lines_) {
    const bool known = std::any_of(notes.begin(), notes.end(), [&](const Diagnostic& note) {
      return note.problem.find(line) !=
             std::string::npos;  // the error that made it give up, or the same again
    });
    if (known) continue;
    if (shown < kMostShown) {
      notes.push_back({Severity::Note, place, "parser", "says: " + line, ""});
      ++shown;
    } else {
      ++more;
    }
  }
  if (more > 0) notes.back().problem += " (and " + std::to_string(more) + " more)";
}

}  // namespace pantin::assimp_loader

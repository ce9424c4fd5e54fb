#pragma once
// A folder for the files of one test.
#include <unistd.h>

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>

namespace pantin::test {

class TemporaryFolder {
 public:
  explicit TemporaryFolder(const std::string& name)
      : path_{std::filesystem::path{testing::TempDir()} /
              ("pantin_" + name + '_' + std::to_string(getpid()))} {
    std::filesystem::create_directories(path_);
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  /// The path of a file with this content.
  [[nodiscard]] std::filesystem::path write(const std::string& name, const std::string& content) const {
    std::ofstream{path_ / name, std::ios::binary} << content;
    return path_ / name;
  }
  /// The path of a shell script that can be run.
  [[nodiscard]] std::filesystem::path script(const std::string& name, const std::string& lines) const {
    const std::filesystem::path file = write(name, "#!/bin/sh\n" + lines);
    std::filesystem::permissions(file, std::filesystem::perms::owner_all);
    return file;
  }

 private:
  std::filesystem::path path_;
};

inline std::string content_of(const std::filesystem::path& file) {
  std::ifstream stream{file, std::ios::binary};
  return {std::istreambuf_iterator<char>{stream}, {}};
}

inline std::string replaced(std::string text, const std::string& what, const std::string& by) {
  const std::size_t at = text.find(what);
  if (at == std::string::npos) throw std::logic_error{what + " is not in the text"};
  return text.replace(at, what.size(), by);
}

}  // namespace pantin::test

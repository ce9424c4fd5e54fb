// Every message about a robot description, one fixture each: where, how grave, about what, what and what to
// do.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <string>
#include <vector>

#include <pantin/bridge/loaders/load_urdf.hpp>

namespace pantin {
namespace {

namespace fs = std::filesystem;

const fs::path kFolder = PANTIN_SOURCE_DIR "/assets/broken";

/// Expected lines of the ledger by name of the fixture.
std::map<std::string, std::vector<std::string>> expectations() {
  std::map<std::string, std::vector<std::string>> all;
  std::ifstream stream{PANTIN_SOURCE_DIR "/tests/loaders/data/broken_urdf.txt"};
  for (std::string line; std::getline(stream, line);) {
    if (!line.starts_with('#')) all[line.substr(0, line.find(".urdf:"))].push_back(line);
  }
  return all;
}

std::vector<std::string> fixtures() {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator{kFolder}) {
    if (entry.path().extension() == ".urdf") names.push_back(entry.path().stem());
  }
  return names;
}

std::string without_folder(std::string text) {
  const std::string folder = kFolder.string() + '/';
  for (std::size_t at = text.find(folder); at != std::string::npos; at = text.find(folder)) {
    text.erase(at, folder.size());
  }
  return text;
}

bool matches(const std::string& text, const std::string& expected) {
  if (!expected.ends_with('*')) return text == expected;
  return text.starts_with(expected.substr(0, expected.size() - 1));
}

class BrokenUrdf : public testing::TestWithParam<std::string> {};

TEST_P(BrokenUrdf, SaysWhereWhatAndWhy) {
  // The fixture holds the one fault its name tells; line and names can be counted in the file. A value comes
  // back just when there is no error, and nothing is said beside the expected.
  const std::vector<std::string> expected = expectations()[GetParam()];
  ASSERT_FALSE(expected.empty()) << "a fixture without expectation would be a message without a test";
  LoadOptions options;
  options.mesh_reader = [](const fs::path& mesh) {
    return Loaded<std::shared_ptr<const TriangleMesh>>{
        {}, {{Severity::Error, mesh.string(), "file", "ends too early", "write it again"}}};
  };
  const Loaded<Model> loaded = load_urdf(kFolder / (GetParam() + ".urdf"), options);
  EXPECT_EQ(loaded.value.has_value(), !has_error(loaded.notes));
  for (std::size_t i = 0; i < std::max(loaded.notes.size(), expected.size()); ++i) {
    const std::string said =
        i < loaded.notes.size() ? without_folder(to_string(loaded.notes[i])) : "(nothing)";
    const std::string wanted = i < expected.size() ? expected[i] : "(nothing)";
    EXPECT_TRUE(matches(said, wanted)) << "said:     " << said << "\nexpected: " << wanted;
  }
}

INSTANTIATE_TEST_SUITE_P(Fixtures, BrokenUrdf, testing::ValuesIn(fixtures()),
                         [](const auto& name) { return name.param; });

}  // namespace
}  // namespace pantin

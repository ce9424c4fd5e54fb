// Nothing in a problem file goes without an entry.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <random>
#include <set>

#include <pantin/bridge/problems/rigid_ref.hpp>

#include "reference_run.hpp"
#include "support/temporary_folder.hpp"

namespace pantin::test {
namespace {

using Json = nlohmann::ordered_json;
using Pointer = Json::json_pointer;

std::vector<Json> problems() {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator{PANTIN_SOURCE_DIR "/assets/problems"})
    if (entry.path().extension() == ".json") files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  std::vector<Json> all;
  for (const auto& file : files) all.push_back(Json::parse(content_of(file)));
  return all;
}

/// Every member of an object and every object in a list, by pointer; all objects besides.
void list(const Json& value, const std::string& at, std::set<std::string>& elements,
          std::vector<std::string>& objects) {
  if (value.is_object()) objects.push_back(at);
  if (!value.is_structured()) return;
  for (const auto& [key, member] : value.items()) {
    const std::string below = at + '/' + key;
    if (value.is_object() || member.is_object()) elements.insert(below);
    list(member, below, elements, objects);
  }
}

TEST(ProblemAccount, HasAnEntryForEveryValue) {
  // Another parser lists what the shipped problems hold: each value has one entry, and there are no others.
  for (const Json& problem : problems()) {
    Account account;
    const Loaded<ReferenceProblem> read = parse_rigid_ref(problem.dump(), "f", &account);
    ASSERT_TRUE(read.value) << lines(read.notes);
    std::set<std::string> expected, found;
    std::vector<std::string> objects;
    list(problem, "", expected, objects);
    for (const AccountEntry& entry : account) {
      EXPECT_EQ(entry.fate == Fate::Read, entry.why.empty()) << to_string(entry);
      EXPECT_TRUE(found.insert(entry.item).second) << entry.item;
      EXPECT_EQ(entry.place, "f#" + entry.item);
    }
    EXPECT_EQ(found, expected);
  }
}

TEST(ProblemAccount, NamesWhatIsPlantedAnywhere) {
  // A key that nobody knows in any object: it is accounted for as dropped, and a warning names it unless it
  // stands in something that is dropped as a whole, or in a table whose keys are data and where it is
  // refused.
  std::mt19937_64 random{10};
  const std::vector<Json> all = problems();
  std::size_t named = 0;
  for (int k = 0; k < 400; ++k) {
    Json problem = all[random() % all.size()];
    std::set<std::string> elements;
    std::vector<std::string> objects;
    list(problem, "", elements, objects);
    const std::string at = objects[random() % objects.size()];
    problem[Pointer{at}]["zorp"] = random() % 2 == 0 ? Json(0) : Json::object();
    Account account;
    const Loaded<ReferenceProblem> read = parse_rigid_ref(problem.dump(), "f", &account);
    const auto note = std::find_if(read.notes.begin(), read.notes.end(), [&](const Diagnostic& d) {
      return d.severity != Severity::Note && d.place.starts_with("f#" + at) && !d.subject.empty() &&
             (d.place + d.problem).find("zorp") != std::string::npos;
    });
    if (!read.value) {
      EXPECT_NE(note, read.notes.end()) << at << lines(read.notes);
      continue;
    }
    const auto entry = std::find_if(account.begin(), account.end(),
                                    [&](const AccountEntry& e) { return e.item == at + "/zorp"; });
    ASSERT_NE(entry, account.end()) << at;
    EXPECT_EQ(entry->fate, Fate::Dropped) << at;
    const bool inside = entry->why == "not needed to solve it";
    EXPECT_TRUE(inside || note != read.notes.end()) << at << lines(read.notes);
    named += inside ? 0 : 1;
  }
  EXPECT_GT(named, 200u);
}

TEST(ProblemAccount, SumsUpWhatIsForPeople) {
  // Descriptions are known and not needed: one note for all of them, and no warning.
  Json problem = problems().front();
  problem["description"] = "what it is";
  problem["source"] = {{"book", "one"}};
  Account account;
  const Loaded<ReferenceProblem> read = parse_rigid_ref(problem.dump(), "f", &account);
  ASSERT_TRUE(read.value);
  const auto note = std::find_if(read.notes.begin(), read.notes.end(),
                                 [](const Diagnostic& d) { return d.severity == Severity::Note; });
  ASSERT_NE(note, read.notes.end());
  EXPECT_TRUE(note->problem.starts_with("not needed to solve it and dropped: ")) << note->problem;
  EXPECT_NE(note->problem.find("'description'"), std::string::npos) << note->problem;
  EXPECT_NE(note->problem.find("'source'"), std::string::npos) << note->problem;
}

}  // namespace
}  // namespace pantin::test

// Nothing in a robot's file goes without an entry: an account of all of it, and findings about what was
// planted.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <random>

#include <pantin/bridge/loaders/load_model.hpp>
#include <pantin/bridge/loaders/load_urdf.hpp>

#include "support/model_text.hpp"
#include "support/temporary_folder.hpp"

namespace pantin {
namespace {

namespace fs = std::filesystem;
using test::content_of;
using test::TemporaryFolder;

struct TextRange {
  std::size_t begin{0}, end{0};
};

/// A tag that opens an element, found by looking at the characters, without any XML library.
struct Tag {
  TextRange name{};
  int line{0};
  std::size_t end{0};               ///< behind its '>'
  bool closes{false};               ///< <name ... />
  std::vector<TextRange> values{};  ///< of its attributes, without quotes
  std::vector<int> lines{};         ///< of its attributes
};

std::vector<Tag> tags_of(const std::string& text) {
  std::vector<Tag> tags;
  int line = 1;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '\n') ++line;
    if (text[i] != '<') continue;
    if (text.compare(i, 4, "<!--") == 0 || text[i + 1] == '?') {
      const std::size_t end = text.find(text[i + 1] == '?' ? "?>" : "-->", i);
      line += static_cast<int>(std::count(text.begin() + static_cast<std::ptrdiff_t>(i),
                                          text.begin() + static_cast<std::ptrdiff_t>(end), '\n'));
      i = end;
      continue;
    }
    if (text[i + 1] == '/') continue;
    Tag tag{.name = {i + 1, text.find_first_of(" \t\r\n/>", i + 1)}, .line = line};
    for (i = tag.name.end; text[i] != '>'; ++i) {
      if (text[i] == '\n') ++line;
      if (text[i] != '"' && text[i] != '\'') continue;
      const std::size_t end = text.find(text[i], i + 1);
      tag.values.push_back({i + 1, end});
      tag.lines.push_back(line);
      i = end;
    }
    tag.closes = text[i - 1] == '/';
    tag.end = i + 1;
    tags.push_back(std::move(tag));
  }
  return tags;
}

/// The shipped robots that load, mesh files beside them left unread.
std::vector<fs::path> robots() {
  std::vector<fs::path> files{PANTIN_SOURCE_DIR "/assets/arm.urdf"};
  for (const char* folder : {"/assets/broken", "/tests/loaders/data"}) {
    for (const auto& entry : fs::directory_iterator{PANTIN_SOURCE_DIR + std::string{folder}}) {
      if (entry.path().extension() == ".urdf" && load_urdf(entry.path()).value) files.push_back(entry.path());
    }
  }
  std::sort(files.begin(), files.end());
  return files;
}

int line_in(const std::string& place) { return std::stoi(place.substr(place.rfind(':') + 1)); }

std::string without_place(Diagnostic note) {
  note.place.clear();
  return to_string(note);
}

TEST(UrdfInventory, AccountsForEveryElementAndAttribute) {
  // What stands in the file is found by looking for tags and quotes in its characters. Each has one entry
  // with its line; entries of text and of what was defaulted come on top.
  for (const fs::path& file : robots()) {
    Account account;
    ASSERT_TRUE(load_urdf(file, {.account = &account}).value) << file;
    std::map<int, std::size_t> expected, found;
    for (const Tag& tag : tags_of(content_of(file))) {
      ++expected[tag.line];
      for (const int line : tag.lines) ++expected[line];
    }
    for (const AccountEntry& entry : account) {
      if (entry.fate != Fate::Defaulted && !entry.item.ends_with("text()")) ++found[line_in(entry.place)];
      EXPECT_EQ(entry.fate == Fate::Read, entry.why.empty()) << to_string(entry);
      EXPECT_NE(entry.why, "left out on reading") << to_string(entry);  // every loss has its reason
    }
    EXPECT_EQ(found, expected) << file;
  }
}

TEST(UrdfInventory, NamesWhatIsPlantedAnywhere) {
  // An element or attribute that no standard knows, somewhere in a robot: it is accounted for at its place as
  // dropped, and a finding names it unless it stands in something that is dropped as a whole.
  std::mt19937_64 random{8};
  const TemporaryFolder folder;
  const std::vector<fs::path> files = robots();
  ASSERT_GT(files.size(), 10u);
  std::size_t named = 0;
  for (int k = 0; k < 400; ++k) {
    const std::string text = content_of(files[random() % files.size()]);
    const std::vector<Tag> tags = tags_of(text);
    const Tag& tag = tags[random() % tags.size()];
    const bool is_attribute = tag.closes || random() % 2 == 0;
    const std::string planted = is_attribute ? " zorp=\"1 2\"" : "<zorp x=\"1\"/>";
    std::string changed = text;
    changed.insert(is_attribute ? tag.name.end : tag.end, planted);
    const int line =
        is_attribute
            ? tag.line
            : static_cast<int>(
                  1 + std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(tag.end), '\n'));
    Account account;
    const Loaded<Model> loaded = load_urdf(folder.write("planted.urdf", changed), {.account = &account});
    ASSERT_TRUE(loaded.value) << changed;
    const auto entry = std::find_if(account.begin(), account.end(), [&](const AccountEntry& e) {
      return e.item.ends_with(is_attribute ? "@zorp" : "zorp");
    });
    ASSERT_NE(entry, account.end()) << changed;
    EXPECT_EQ(entry->fate, Fate::Dropped);
    EXPECT_EQ(line_in(entry->place), line) << to_string(*entry) << changed;
    EXPECT_FALSE(entry->subject.empty());
    const bool inside = entry->why.find("zorp") == std::string::npos && entry->why != "is unknown";
    const auto note = std::find_if(loaded.notes.begin(), loaded.notes.end(), [&](const Diagnostic& d) {
      return d.severity == Severity::Warning && d.problem.find("zorp") != std::string::npos &&
             line_in(d.place) == line && !d.subject.empty();
    });
    EXPECT_TRUE(inside || note != loaded.notes.end()) << changed;
    named += inside ? 0 : 1;
  }
  EXPECT_GT(named, 200u);
}

TEST(UrdfInventory, SaysTheTruthAboutWhatMatters) {
  // Another value of an attribute that counts as dropped leaves the model as it is; of one that counts as
  // read it changes the model, is refused, or has a finding say something else.
  const TemporaryFolder folder;
  std::size_t read = 0, dropped = 0;
  for (const fs::path& file : robots()) {
    const std::string text = content_of(file);
    Account account;
    const Loaded<Model> before = load_urdf(folder.write("robot.urdf", text), {.account = &account});
    std::size_t at = 0;  // in the account, which is in the order of the file
    for (const Tag& tag : tags_of(text)) {
      const auto next = [&] {
        while (account[at].fate == Fate::Defaulted || account[at].item.ends_with("text()")) ++at;
        return account[at++];
      };
      static_cast<void>(next());
      for (const TextRange& value : tag.values) {
        const AccountEntry entry = next();
        const bool is_number = text.find_first_of("0123456789", value.begin) < value.end;
        std::string changed = text;
        changed.replace(
            value.begin, value.end - value.begin,
            is_number ? "0.3 0.1 -0.2" : text.substr(value.begin, value.end - value.begin) + "_x");
        Loaded<Model> after = load_urdf(folder.write("robot.urdf", changed), {});
        if (is_number && !after.value) {  // it wants one number
          changed.replace(value.begin, 12, "0.3");
          after = load_urdf(folder.write("robot.urdf", changed), {});
        }
        const bool same =
            after.value && test::text_of_model(*after.value) == test::text_of_model(*before.value);
        if (entry.fate == Fate::Dropped) {
          ++dropped;
          EXPECT_TRUE(same || !after.value) << to_string(entry);
        } else {
          ++read;
          const bool says_else =
              !std::equal(after.notes.begin(), after.notes.end(), before.notes.begin(), before.notes.end(),
                          [](const auto& a, const auto& b) { return without_place(a) == without_place(b); });
          EXPECT_TRUE(!same || says_else) << to_string(entry);
        }
      }
    }
  }
  EXPECT_GT(read, 300u);
  EXPECT_GT(dropped, 50u);
}

TEST(UrdfInventory, TellsDefaultsAndConversions) {
  // One of each kind that URDF's rules know: no axis, a limit without lower, an inertia without izz, an axis
  // that is normalised, a damping that is not taken.
  const TemporaryFolder folder;
  Account account;
  const Loaded<Model> loaded = load_urdf(folder.write("m.urdf", R"(<robot name="m">
<link name="a"/><link name="b"><inertial><mass value="1"/>
<inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0"/></inertial></link><link name="c"/>
<joint name="ab" type="revolute"><parent link="a"/><child link="b"/><limit upper="1" effort="2" velocity="2"/><dynamics/></joint>
<joint name="bc" type="continuous"><parent link="b"/><child link="c"/>
<axis xyz="0 0 2"/><dynamics damping="-1"/></joint></robot>)"),
                                         {.account = &account});
  ASSERT_TRUE(loaded.value);
  std::string told;
  for (const AccountEntry& entry : account) {
    if (entry.fate == Fate::Read) continue;
    told +=
        std::string{to_string(entry.fate)} + ' ' + entry.subject + ' ' + entry.item + ' ' + entry.why + '\n';
  }
  EXPECT_EQ(told,
            "defaulted link 'b' link/inertial/inertia@izz '0' is used\n"
            "defaulted joint 'ab' joint/axis@xyz '1 0 0' is used\n"
            "dropped joint 'ab' joint/limit@effort limits of effort and velocity are not used\n"
            "dropped joint 'ab' joint/limit@velocity limits of effort and velocity are not used\n"
            "defaulted joint 'ab' joint/limit@lower '0' is used\n"
            "dropped joint 'ab' joint/dynamics is empty\n"
            "converted joint 'bc' joint/axis@xyz to '0 0 1'\n"
            "converted joint 'bc' joint/dynamics@damping to '0'\n");
}

}  // namespace
}  // namespace pantin

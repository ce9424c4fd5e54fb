#include <pantin/bridge/loaders/gltf_json.hpp>

#include <gtest/gtest.h>

using namespace pantin::gltf;

namespace {

JsonTree parsed(const std::string& text) {
  JsonError error;
  std::optional<JsonTree> tree = JsonTree::parse(text, error);
  EXPECT_TRUE(tree) << error.text;
  return std::move(tree).value();
}

TEST(JsonTree, FindsValuesByKeyAndPosition) {
  // The values are those of the text; members may be looked up in any order.
  const JsonTree tree =
      parsed(R"({"b": [1, -2.5e2, 18446744073709551615], "a": {"t": true, "n": null}, "s": "ü"})");
  const JsonValue root = tree.root();
  ASSERT_EQ(root.kind(), JsonKind::Object);
  const JsonValue numbers = root.find("b").value();
  ASSERT_EQ(numbers.size(), 3U);
  EXPECT_EQ(numbers.at(0).number(), 1.0);
  EXPECT_EQ(numbers.at(1).number(), -250.0);
  EXPECT_EQ(numbers.at(2).number(), 18446744073709551616.0);  // 2^64 - 1 rounds to 2^64 in double
  EXPECT_TRUE(root.find("a")->find("t")->boolean());
  EXPECT_EQ(root.find("a")->find("n")->kind(), JsonKind::Null);
  EXPECT_EQ(root.find("s")->text(), "ü");
  EXPECT_FALSE(root.find("c"));
  EXPECT_FALSE(numbers.find("a"));
}

TEST(JsonTree, GivesPointersAsRfc6901) {
  // RFC 6901, 3: "~" is written ~0 and "/" ~1; array elements by their number; the root is "".
  const JsonTree tree = parsed(R"({"a/b": [0, {"m~n": 1}], "": 2})");
  EXPECT_EQ(tree.root().pointer(), "");
  EXPECT_EQ(tree.root().find("a/b")->at(1).find("m~n")->pointer(), "/a~1b/1/m~0n");
  EXPECT_EQ(tree.root().find("")->pointer(), "/");
}

TEST(JsonTree, FindsAKeyThatStandsTwice) {
  // In {"a": 1, "b": 2, "a": 3} the second "a" is the one too many; equal keys in different objects are fine.
  const JsonTree twice = parsed(R"([{"a": 1}, {"a": 1, "b": 2, "a": 3}])");
  ASSERT_TRUE(twice.first_duplicate());
  EXPECT_EQ(twice.first_duplicate()->number(), 3.0);
  EXPECT_FALSE(parsed(R"({"a": {"a": 1}, "b": {"a": 1}})").first_duplicate());
}

TEST(JsonTree, TakesAnyDepth) {
  // A million nested arrays parse and are destroyed: nothing here recurses, or the stack of 8 MiB would
  // overflow.
  constexpr std::size_t kDepth = 1'000'000;
  const JsonTree tree = parsed(std::string(kDepth, '[') + std::string(kDepth, ']'));
  JsonValue value = tree.root();
  std::size_t depth = 1;
  for (; value.size() > 0; ++depth) value = value.at(0);
  EXPECT_EQ(depth, kDepth);
  EXPECT_EQ(value.pointer().size(), 32 * 2 + 4U);  // cut after 32 levels of "/0", then "/..."
}

TEST(JsonTree, SaysTheLineOfAnError) {
  // The comma before ] stands on the third line.
  JsonError error;
  EXPECT_FALSE(JsonTree::parse("{\n\"a\":\n[1,]}", error));
  EXPECT_EQ(error.line, 3U);
  EXPECT_EQ(error.text, "syntax error while parsing value - unexpected ']'; expected '[', '{', or a literal");
}

TEST(JsonTree, RefusesWhatIsNotJson) {
  // None of these is JSON by RFC 8259, and a cut-off quote must stay readable text.
  for (const std::string& text : {std::string{}, std::string{"{"}, std::string{"nul"}, std::string{"[1] 2"},
                                  std::string{"[01]"}, std::string{"[1e999]"}, std::string{"\"\xFF\xFE\""},
                                  std::string{"/* */ 1"}, std::string{"[1]\0[2]", 7}, std::string{"[NaN]"}}) {
    JsonError error;
    EXPECT_FALSE(JsonTree::parse(text, error)) << text;
    EXPECT_FALSE(error.text.empty()) << text;
    for (const char c : error.text) EXPECT_LT(static_cast<unsigned char>(c), 0x80) << text;
  }
}

TEST(Shortened, CutsBetweenCharacters) {
  // "ä" takes two bytes: a cut at byte 3 of "aää" falls into the second one, which is left out whole.
  EXPECT_EQ(shortened("aää", 5), "aää");
  EXPECT_EQ(shortened("aää", 4), "aä...");
  EXPECT_EQ(shortened("aää", 3), "aä...");
  EXPECT_EQ(shortened("aää", 2), "a...");
}

}  // namespace

#include <gtest/gtest.h>

#include <set>
#include <support/random_affine.hpp>

#include <pantin/scenegraph/scene.hpp>

namespace pantin {
namespace {

TEST(Path, OrdinaryNamesAreJoinedBySlashes) {
  // From the child of the root down; the root itself has the empty path, and the empty path is the root.
  Scene scene;
  const NodeId base = scene.create(scene.root(), "base");
  const NodeId elbow = scene.create(base, "left elbow [m]");
  EXPECT_EQ(scene.path(elbow), "base/left elbow [m]");
  EXPECT_EQ(scene.find("base/left elbow [m]"), elbow);
  EXPECT_EQ(scene.path(scene.root()), "");
  EXPECT_EQ(scene.find(""), scene.root());
}

TEST(Path, EscapesLikeAJsonPointer) {
  // RFC 6901: '~' is "~0", '/' is "~1".
  Scene scene;
  const NodeId node = scene.create(scene.root(), "a/b~c~1");
  EXPECT_EQ(scene.path(node), "a~1b~0c~01");
  EXPECT_EQ(scene.find("a~1b~0c~01"), node);
}

TEST(Path, NumbersEqualSiblings) {
  // Counted among siblings of the same name only, in order; the first may be found without its number.
  Scene scene;
  const NodeId first = scene.create(scene.root(), "wheel");
  const NodeId axle = scene.create(scene.root(), "axle");
  const NodeId second = scene.create(scene.root(), "wheel");
  EXPECT_EQ(scene.path(first), "wheel[0]");
  EXPECT_EQ(scene.path(second), "wheel[1]");
  EXPECT_EQ(scene.path(axle), "axle");
  EXPECT_EQ(scene.find("wheel"), first);
  EXPECT_EQ(scene.find("wheel[1]"), second);
  EXPECT_EQ(scene.find("axle[0]"), axle);
  scene.remove(first);
  EXPECT_EQ(scene.path(second), "wheel");
}

TEST(Path, EmptyNamesAlwaysHaveANumber) {
  // Else a path could end in a slash or be the root's.
  Scene scene;
  const NodeId nameless = scene.create(scene.root(), "");
  const NodeId below = scene.create(nameless, "");
  const NodeId second = scene.create(nameless, "");
  EXPECT_EQ(scene.path(nameless), "[0]");
  EXPECT_EQ(scene.path(below), "[0]/[0]");
  EXPECT_EQ(scene.path(second), "[0]/[1]");
  EXPECT_EQ(scene.find("[0]/[1]"), second);
}

TEST(Path, ANameThatLooksLikeANumberedOneIsToldApart) {
  // "x[1]" as a name gets its bracket escaped; unescaped it is the second of two nodes called "x".
  Scene scene;
  const NodeId literal = scene.create(scene.root(), "x[1]");
  EXPECT_EQ(scene.path(literal), "x~21]");
  EXPECT_EQ(scene.find("x~21]"), literal);
  EXPECT_FALSE(scene.find("x[1]"));
  scene.create(scene.root(), "x");
  const NodeId second = scene.create(scene.root(), "x");
  EXPECT_EQ(scene.find("x[1]"), second);
  const NodeId twin = scene.create(scene.root(), "x[1]");
  EXPECT_EQ(scene.path(twin), "x~21][1]");
  EXPECT_EQ(scene.find("x~21][1]"), twin);
}

TEST(Path, BracketsThatAreNoNumberStayPlain) {
  // Only '[' digits ']' at the very end is a number.
  Scene scene;
  for (const char* name : {"a[]", "a[x]", "[", "]", "a[1]b", "1]", "[-1]", "a[1", "[1] "}) {
    const NodeId node = scene.create(scene.root(), name);
    EXPECT_EQ(scene.path(node), name);
    EXPECT_EQ(scene.find(name), node);
  }
}

TEST(Paths, AreThoseOfTheNodesInTheirOrder) {
  // Repeated ids, the root, and equal siblings of which one was asked for alone.
  Scene scene;
  const NodeId a = scene.create(scene.root(), "a");
  scene.create(a, "x");
  const NodeId second = scene.create(a, "x");
  const NodeId b = scene.create(scene.root(), "b");
  EXPECT_EQ(scene.paths(std::array{second, scene.root(), b, second, a}),
            (std::vector<std::string>{"a/x[1]", "", "b", "a/x[1]", "a"}));
  EXPECT_TRUE(scene.paths({}).empty());
}

TEST(Path, CountsSiblingsAnewWhereNamesOrPlacesChange) {
  // What is kept from one call to the next must not outlive a change: each kind of change is followed by a
  // path that would be another with the old counts.
  Scene scene;
  const NodeId a = scene.create(scene.root(), "x");
  EXPECT_EQ(scene.path(a), "x");
  const NodeId b = scene.create(scene.root(), "x");
  EXPECT_EQ(scene.path(b), "x[1]");
  scene.rename(a, "y");
  EXPECT_EQ(scene.path(b), "x");
  const NodeId c = scene.create(a, "x");
  scene.set_parent(c, scene.root(), Keep::Local);
  EXPECT_EQ(scene.path(c), "x[1]");
  scene.compact();
  EXPECT_EQ(scene.path(c), "x[1]");
  scene.remove(b);
  EXPECT_EQ(scene.path(c), "x");
}

TEST(Path, OfEveryNodeOfAWideFanTakesNoLongerThanItsLength) {
  // 100,000 siblings of two names in pairs. One look at all siblings for each path would be 10^10
  // comparisons, minutes; the numbers are what the order of creation says.
  Scene scene;
  std::vector<NodeId> ids;
  for (int i = 0; i < 100'000; ++i) ids.push_back(scene.create(scene.root(), "n" + std::to_string(i / 2)));
  for (std::size_t i = 0; i < ids.size(); ++i)
    ASSERT_EQ(scene.path(ids[i]), "n" + std::to_string(i / 2) + '[' + std::to_string(i % 2) + ']');
}

TEST(Find, IsNullForWhatIsNotThere) {
  // Unknown names, numbers past the last, bad escapes, numbers too long for any count, slashes too many.
  Scene scene;
  scene.create(scene.create(scene.root(), "a"), "b");
  for (const char* path : {"c", "a/c", "a/b/c", "b", "a[1]", "a/b[7]", "a~", "a~3", "~", "/", "a/", "/a",
                           "a//b", "a[99999999999999999999999]"})
    EXPECT_FALSE(scene.find(path)) << path;
}

TEST(Path, FindGivesBackEveryNode) {
  // Random trees with names from pieces that are hard to tell apart: paths are all different, and each finds
  // its node.
  std::mt19937_64 random{15};
  const std::vector<std::string> pieces{"",  "/",        "~",   "~0",  "~1",          "~2",
                                        "[", "]",        "[0]", "[1]", "1",           "[12]",
                                        "a", "\xC3\xA9", " ",   "\n",  "\xE2\x82\xAC"};
  for (int k = 0; k < 200; ++k) {
    Scene scene;
    std::vector<NodeId> ids{scene.root()};
    for (int i = 0; i < 40; ++i) {
      std::string name;
      for (std::size_t n = test::pick(random, 4); n > 0; --n)
        name += pieces[test::pick(random, pieces.size())];
      ids.push_back(scene.create(ids[test::pick(random, std::min<std::size_t>(ids.size(), 8))], name));
    }
    // In order, from the last to the first, and at random: what the writer keeps from one to the next
    // differs.
    std::vector<NodeId> asked = scene.subtree(scene.root());
    asked.insert(asked.end(), ids.rbegin(), ids.rend());
    for (int n = 0; n < 20; ++n) asked.push_back(ids[test::pick(random, ids.size())]);
    const std::vector<std::string> together = scene.paths(asked);
    ASSERT_EQ(together.size(), asked.size());
    for (std::size_t i = 0; i < asked.size(); ++i) ASSERT_EQ(together[i], scene.path(asked[i]));
    std::set<std::string> paths;
    for (const NodeId id : ids) {
      const std::string path = scene.path(id);
      ASSERT_EQ(scene.find(path), id) << path;
      paths.insert(path);
    }
    ASSERT_EQ(paths.size(), ids.size());
  }
}

}  // namespace
}  // namespace pantin

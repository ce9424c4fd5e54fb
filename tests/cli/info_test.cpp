// `pantin info`: what it prints of a file, against numbers worked out by hand.
#include <cmath>
#include <numbers>

#include "models.hpp"
#include "program.hpp"

namespace pantin::test {
namespace {

const Json& node_at(const Json& info, const std::string& path) {
  for (const Json& node : info.at("nodes"))
    if (node.at("path") == path) return node;
  throw std::runtime_error{"no node " + path + " in " + info.dump()};
}

std::vector<std::string> keys_of(const Json& object) {
  std::vector<std::string> keys;
  for (const auto& [key, value] : object.items()) keys.push_back(key);
  return keys;
}

void expect_position(const Json& matrix, double x, double y, double z) {
  // Products of a few rotations and translations of size 1: a few units in the last place.
  EXPECT_NEAR(matrix[0][3].get<double>(), x, 1e-15);
  EXPECT_NEAR(matrix[1][3].get<double>(), y, 1e-15);
  EXPECT_NEAR(matrix[2][3].get<double>(), z, 1e-15);
}

TEST(Info, HasTheDocumentedShape) {
  // The keys are promised in README; programs lean on all of them and on nothing else.
  const TemporaryFolder folder;
  const Json info = pantin({"info", "--json", folder.write("linked.urdf", kLinkedUrdf)}).json();
  EXPECT_EQ(keys_of(info), (std::vector<std::string>{"model", "format", "up_axis", "unit_m", "total_mass",
                                                     "nodes", "clips", "ledger"}));
  EXPECT_EQ(keys_of(info["nodes"][0]),
            (std::vector<std::string>{"path", "name", "parent", "local", "absolute", "link", "mass",
                                      "centre_of_gravity", "inertia", "shapes", "meshes"}));
  EXPECT_EQ(keys_of(node_at(info, "base/arm")["link"]),
            (std::vector<std::string>{"name", "kind", "axis", "lower", "upper", "value"}));
}

TEST(Info, GivesWhatTheFileSays) {
  // Every number stands in the file, so it must come out as it went in.
  const TemporaryFolder folder;
  const Json info = pantin({"info", "--json", folder.write("linked.urdf", kLinkedUrdf)}).json();
  EXPECT_EQ(info["model"], "linked");
  EXPECT_EQ(info["format"], "urdf");
  EXPECT_EQ(info["up_axis"], "Z");
  EXPECT_EQ(info["unit_m"], 1.0);
  EXPECT_EQ(info["total_mass"], 3.5);
  EXPECT_EQ(info["nodes"].size(), 5u);
  const Json& arm = node_at(info, "base/arm");
  EXPECT_EQ(arm["name"], "arm");
  EXPECT_EQ(arm["parent"], "base");
  EXPECT_EQ(arm["mass"], 2.0);
  EXPECT_EQ(arm["centre_of_gravity"], Json({0.0, 0.0, -0.5}));
  EXPECT_EQ(arm["inertia"], Json({{0.2, 0.01, 0.0}, {0.01, 0.25, 0.0}, {0.0, 0.0, 0.1}}));
  EXPECT_EQ(arm["link"],
            Json::parse(R"({"name": "hinge", "kind": "pivot", "axis": [0.0, 1.0, 0.0], "lower": -2.0,
                                         "upper": 2.0, "value": 0.0})"));
  ASSERT_EQ(arm["shapes"].size(), 1u);
  EXPECT_EQ(arm["shapes"][0]["kind"], "box");
  EXPECT_EQ(arm["shapes"][0]["size"], Json({0.1, 0.2, 0.3}));
  const Json& base = node_at(info, "base");
  EXPECT_TRUE(base["parent"].is_null());
  EXPECT_TRUE(base["link"].is_null());
  EXPECT_TRUE(base["mass"].is_null() && base["centre_of_gravity"].is_null() && base["inertia"].is_null());
  EXPECT_EQ(base["absolute"],
            Json::parse("[[1.0,0.0,0.0,0.0],[0.0,1.0,0.0,0.0],[0.0,0.0,1.0,0.0],[0.0,0.0,0.0,1.0]]"));
  const Json& unlimited = node_at(info, "base/hand")["link"];
  EXPECT_TRUE(unlimited["lower"].is_null() && unlimited["upper"].is_null());
  const Json& glue = node_at(info, "base/hand/tip")["link"];
  EXPECT_EQ(glue["kind"], "fixed");
  EXPECT_TRUE(glue["value"].is_null());
}

TEST(Info, PutsTheModelInTheConfigurationAskedFor) {
  // Turning by a right angle about y takes x to -z: the carriage, 1 m out along x from z = 1, comes to the
  // origin, and 0.25 m of rail take it on to z = -0.25.
  const TemporaryFolder folder;
  const std::string file = folder.write("linked.urdf", kLinkedUrdf);
  const std::string right_angle = "hinge=1.5707963267948966";
  const Json turned = pantin({"info", "--json", file, "--joint", right_angle}).json();
  expect_position(node_at(turned, "base/arm/carriage")["absolute"], 0, 0, 0);
  const Json slid = pantin({"info", "--json", file, "--joint", right_angle, "--joint", "rail=0.25"}).json();
  expect_position(node_at(slid, "base/arm/carriage")["absolute"], 0, 0, -0.25);
  expect_position(node_at(slid, "base/arm/carriage")["local"], 1.25, 0, 0);
  EXPECT_EQ(node_at(slid, "base/arm/carriage")["link"]["value"], 0.25);
}

TEST(Info, LetsMimicsFollowUnlessTheyAreNamed) {
  // echo = 2 * hinge + 0.1 by its definition in the file.
  const TemporaryFolder folder;
  const std::string file = folder.write("linked.urdf", kLinkedUrdf);
  const Json followed = pantin({"info", "--json", file, "--joint", "hinge=0.4"}).json();
  EXPECT_DOUBLE_EQ(node_at(followed, "base/hand")["link"]["value"].get<double>(), 0.9);
  const Json named = pantin({"info", "--json", file, "--joint", "hinge=0.4", "--joint", "echo=-1"}).json();
  EXPECT_EQ(node_at(named, "base/hand")["link"]["value"], -1.0);
}

TEST(Info, TakesPathsForJoints) {
  // The path of the child names a joint as well as its own name does.
  const TemporaryFolder folder;
  const std::string file = folder.write("linked.urdf", kLinkedUrdf);
  const Json info = pantin({"info", "--json", file, "--joint", "base/arm=0.5"}).json();
  EXPECT_EQ(node_at(info, "base/arm")["link"]["value"], 0.5);
}

TEST(Info, WarnsOfValuesOutsideTheLimits) {
  // Pictures of impossible configurations are allowed, but said; strictness makes them errors.
  const TemporaryFolder folder;
  const std::string file = folder.write("linked.urdf", kLinkedUrdf);
  const Ran ran = pantin({"info", "--json", file, "--joint", "hinge=2.5"});
  EXPECT_EQ(ran.code, 0);
  const Json info = ran.json();
  EXPECT_EQ(node_at(info, "base/arm")["link"]["value"], 2.5);
  EXPECT_NE(info["ledger"].dump().find("the value 2.5 is outside the limits -2 to 2"), std::string::npos);
  EXPECT_EQ(pantin({"info", "--strict", file, "--joint", "hinge=2.5"}).code, 1);
}

TEST(Info, ShowsTheClipAtATime) {
  // Linear from x = 0 to 8 in 4 s: 2 m/s; held before the first and after the last key.
  const TemporaryFolder folder;
  const std::string file = folder.write("cart.gltf", cart_gltf());
  const auto x_at = [&](const std::string& time) {
    const Json info = pantin({"info", "--json", file, "--clip", "go", "--time", time}).json();
    return node_at(info, "track/cart")["absolute"][0][3].get<double>();
  };
  EXPECT_EQ(x_at("1.25"), 2.5);
  EXPECT_EQ(x_at("-1"), 0.0);
  EXPECT_EQ(x_at("9"), 8.0);
  const Json second = pantin({"info", "--json", file, "--clip", "[1]", "--time", "2"}).json();
  EXPECT_EQ(node_at(second, "track/cart")["absolute"][1][3], 2.0);
}

TEST(Info, ListsClips) {
  // The file has two clips of one channel and 4 s each, and says nothing of masses but for the cart.
  const TemporaryFolder folder;
  const Json info = pantin({"info", "--json", folder.write("cart.gltf", cart_gltf())}).json();
  EXPECT_EQ(info["clips"], Json::parse(R"([{"name": "go", "duration": 4.0, "channels": 1},
                                           {"name": "rise", "duration": 4.0, "channels": 1}])"));
  EXPECT_EQ(info["up_axis"], "Y");
  EXPECT_EQ(info["format"], "gltf");
  EXPECT_EQ(info["total_mass"], 1.0);
}

TEST(Info, TellsPeopleTheSame) {
  // The table has a row for each node and the head names model and mass.
  const TemporaryFolder folder;
  const Ran ran = pantin({"info", folder.write("linked.urdf", kLinkedUrdf)});
  EXPECT_EQ(ran.code, 0);
  for (const char* text : {"linked", "5 nodes", "4 links", "3.5 kg", "base/arm/carriage", "slider 'rail'",
                           "-0.5 .. 0.5", "pivot 'echo' follows 'hinge'"})
    EXPECT_NE(ran.out.find(text), std::string::npos) << text << "\n" << ran.out;
}

TEST(Info, NumbersReadBackExactly) {
  // Shortest round trip: a third has no short decimal form, and comes back as the same double.
  const TemporaryFolder folder;
  std::string text = kLinkedUrdf;
  const std::string third = "0.3333333333333333";
  text.replace(text.find("xyz=\"0 0 1\""), 11, "xyz=\"0 0 " + third + "\"");
  const Json info = pantin({"info", "--json", folder.write("linked.urdf", text)}).json();
  EXPECT_EQ(node_at(info, "base/arm")["local"][2][3].get<double>(), 1.0 / 3);
}

struct Refusal {
  std::vector<std::string> arguments{};
  std::string says{};
};

TEST(Info, NamesWhatItCannotFind) {
  // Each message names the culprit and what there is instead; nothing but the ledger is printed.
  const TemporaryFolder folder;
  const std::string urdf = folder.write("linked.urdf", kLinkedUrdf);
  const std::string gltf = folder.write("cart.gltf", cart_gltf());
  const std::vector<Refusal> refusals{
      {{urdf, "--joint", "hing=1"}, "--joint 'hing=1': no link has this name; did you mean 'hinge'?"},
      {{gltf, "--joint", "track=1"}, "--joint 'track=1': this node has no link"},
      {{urdf, "--joint", "glue=1"}, "--joint 'glue=1': the link is fixed and has no value; leave it out"},
      {{urdf, "--joint", "hinge=1,2"},
       "--joint 'hinge=1,2': the value does not fit a pivot; give one angle in rad"},
      {{urdf, "--joint", "rail=1,2"},
       "--joint 'rail=1,2': the value does not fit a slider; give one distance in m"},
      {{urdf, "--joint", "hinge=1", "--joint", "base/arm=1"}, "the link 'hinge' is set twice; give it once"},
      {{gltf, "--joint", "cart=1"}, "no link has this name; leave it out: there is none here"},
      {{gltf, "--clip", "goo"}, "--clip 'goo': the model has no clip 'goo'; did you mean 'go'?"},
      {{gltf, "--clip", "[2]"}, "the model has no clip '[2]'"},
      {{urdf, "--clip", "go"}, "the model has no clip 'go'; leave it out: there is none here"},
  };
  for (const Refusal& refusal : refusals) {
    std::vector<std::string> arguments{"info", "--json"};
    arguments.insert(arguments.end(), refusal.arguments.begin(), refusal.arguments.end());
    const Ran ran = pantin(arguments);
    EXPECT_EQ(ran.code, 1) << refusal.says;
    EXPECT_TRUE(ran.says(refusal.says)) << ran.err;
    EXPECT_EQ(keys_of(ran.json()), std::vector<std::string>{"ledger"});
  }
}

}  // namespace
}  // namespace pantin::test

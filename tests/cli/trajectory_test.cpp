// Trajectories as files: JSON and CSV of one run say the same, and both read back exactly.
#include <charconv>

#include "models.hpp"
#include "program.hpp"

namespace pantin::test {
namespace {

using Table = std::vector<std::vector<std::string>>;

/// RFC 4180: fields by commas, rows by CR LF, quoted fields with doubled quotes.
Table parse_csv(const std::string& text) {
  Table rows{{""}};
  bool quoted = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (quoted) {
      if (c == '"' && i + 1 < text.size() && text[i + 1] == '"') rows.back().back() += text[++i];
      else if (c == '"') quoted = false;
      else rows.back().back() += c;
    } else if (c == '"') {
      quoted = true;
    } else if (c == ',') {
      rows.back().emplace_back();
    } else if (c == '\r' && i + 1 < text.size() && text[i + 1] == '\n') {
      ++i;
      if (i + 1 < text.size()) rows.push_back({""});
    } else {
      rows.back().back() += c;
    }
  }
  return rows;
}

double number(const std::string& text) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  EXPECT_TRUE(error == std::errc{} && end == text.data() + text.size()) << text;
  return value;
}

const std::vector<std::string> kHeader{"t",  "path",  "drive",       "px",         "py",      "pz",
                                       "cx", "cy",    "cz",          "qw",         "qx",      "qy",
                                       "qz", "vx",    "vy",          "vz",         "wx",      "wy",
                                       "wz", "joint", "joint_value", "joint_rate", "kinetic", "potential"};

void expect_same(const std::vector<std::string>& row, std::size_t first, const Json& numbers) {
  for (std::size_t i = 0; i < numbers.size(); ++i)
    EXPECT_EQ(number(row[first + i]), numbers[i].get<double>());
}

TEST(Trajectory, SaysTheSameInCsvAndJson) {
  // Both are written from the same samples, and their numbers are meant to read back to the same doubles.
  const TemporaryFolder folder;
  const std::string csv = folder.path("t.csv");
  const std::string json = folder.path("t.json");
  const Ran ran = pantin({"run", folder.write("p.urdf", kPendulumUrdf), "--simulate", "all", "--joint",
                          "hinge=1", "--duration", "0.5", "--out", csv, "--out", json});
  ASSERT_EQ(ran.code, 0) << ran.err;
  const Json result = Json::parse(content_of(json));
  const Table table = parse_csv(content_of(csv));
  ASSERT_EQ(table[0], kHeader);
  std::size_t i = 1;
  for (const Json& sample : result["samples"]) {
    for (const auto& [path, body] : sample["bodies"].items()) {
      ASSERT_LT(i, table.size());
      const std::vector<std::string>& row = table[i++];
      ASSERT_EQ(row.size(), kHeader.size());
      EXPECT_EQ(number(row[0]), sample["t"].get<double>());
      EXPECT_EQ(row[1], path);
      EXPECT_EQ(row[2], body["drive"]);
      expect_same(row, 3, body["position_origin"]);
      expect_same(row, 6, body["position_cog"]);
      expect_same(row, 9, body["quaternion_wxyz"]);
      expect_same(row, 13, body["velocity_cog"]);
      expect_same(row, 16, body["angular_velocity_world"]);
      if (path == "base/rod") {
        EXPECT_EQ(row[19], "hinge");
        EXPECT_EQ(number(row[20]), sample["joints"]["hinge"]["value"].get<double>());
        EXPECT_EQ(number(row[21]), sample["joints"]["hinge"]["rate"].get<double>());
      }
      EXPECT_EQ(number(row[22]), sample["energy"]["kinetic"].get<double>());
      EXPECT_EQ(number(row[23]), sample["energy"]["potential"].get<double>());
    }
  }
  EXPECT_EQ(i, table.size());
  EXPECT_GT(i, 30u);
}

TEST(Trajectory, QuotesNamesInCsv) {
  // Names may hold whatever JSON can: comma, quote and line break have to survive.
  const TemporaryFolder folder;
  const std::string csv = folder.path("t.csv");
  const Ran ran = pantin(
      {"run", folder.write("cart.gltf", cart_gltf(R"(a,\"b\"\nc)")), "--duration", "0.1", "--out", csv});
  ASSERT_EQ(ran.code, 0) << ran.err;
  const Table table = parse_csv(content_of(csv));
  ASSERT_GT(table.size(), 1u);
  for (const std::vector<std::string>& row : table) EXPECT_EQ(row.size(), kHeader.size());
  EXPECT_EQ(table[1][1], "track/a,\"b\"\nc");
}

TEST(Trajectory, HasTheDocumentedShape) {
  // The keys are promised in README.
  const TemporaryFolder folder;
  const Ran ran = pantin(
      {"run", "--json", folder.write("p.urdf", kPendulumUrdf), "--simulate", "all", "--duration", "0.1"});
  const Json result = ran.json();
  const auto keys = [](const Json& object) {
    std::vector<std::string> names;
    for (const auto& [key, value] : object.items()) names.push_back(key);
    return names;
  };
  using Names = std::vector<std::string>;
  EXPECT_EQ(keys(result), (Names{"samples", "summary", "ledger"}));
  EXPECT_EQ(keys(result["samples"][0]), (Names{"t", "bodies", "joints", "energy"}));
  EXPECT_EQ(keys(result["samples"][0]["bodies"]["base/rod"]),
            (Names{"position_origin", "position_cog", "quaternion_wxyz", "velocity_cog",
                   "angular_velocity_world", "drive"}));
  EXPECT_EQ(keys(result["samples"][0]["joints"]["hinge"]), (Names{"value", "rate"}));
  EXPECT_EQ(keys(result["samples"][0]["energy"]), (Names{"kinetic", "potential", "total"}));
  EXPECT_EQ(keys(result["summary"]), (Names{"models",
                                            "bodies",
                                            "bodies_simulated",
                                            "joints",
                                            "steps",
                                            "evaluations",
                                            "joint_events",
                                            "crowded",
                                            "samples",
                                            "toggles",
                                            "duration",
                                            "completed",
                                            "integrator",
                                            "step",
                                            "energy_initial",
                                            "energy_final",
                                            "energy_conserved_expected",
                                            "energy_drift_relative",
                                            "joint_drift_m",
                                            "joint_drift_rad",
                                            "wall_seconds"}));
}

TEST(Trajectory, PlacesOriginAndCentreOfGravity) {
  // Turned by a right angle about y, the rod's centre of gravity, 0.5 m along its -z, lies at x = -0.5; the
  // origin stays on the pivot.
  const TemporaryFolder folder;
  const Ran ran = pantin({"run", "--json", folder.write("p.urdf", kPendulumUrdf), "--simulate", "all",
                          "--joint", "hinge=1.5707963267948966", "--duration", "0.1"});
  const Json result = ran.json();
  const Json& rod = result["samples"][0]["bodies"]["base/rod"];
  for (const auto& [key, expected] : {std::pair{"position_origin", 0.0}, {"position_cog", -0.5}}) {
    EXPECT_NEAR(rod[key][0].get<double>(), expected, 1e-15) << key;
    EXPECT_NEAR(rod[key][2].get<double>(), 0, 1e-15) << key;
  }
}

TEST(Trajectory, ReplacesAnOldFileWhole) {
  // The old content stands until the new one is complete; nothing else is left in the folder.
  const TemporaryFolder folder;
  const std::string model = folder.write("p.urdf", kPendulumUrdf);
  const std::string out = folder.write("t.csv", "old\n");
  ASSERT_EQ(pantin({"run", model, "--simulate", "all", "--duration", "0.1", "--out", out}).code, 0);
  EXPECT_TRUE(content_of(out).starts_with("t,path,drive,"));
  EXPECT_EQ(folder.names().size(), 2u);
}

TEST(Trajectory, IsTheSameEveryTime) {
  // Same binary, same input: same bits; only the wall time may differ, and CSV has none.
  const TemporaryFolder folder;
  const std::string model = folder.write("p.urdf", kPendulumUrdf);
  std::vector<std::string> texts;
  for (const char* name : {"a.csv", "b.csv"}) {
    ASSERT_EQ(
        pantin({"run", model, "--simulate", "all", "--joint", "hinge=1", "--out", folder.path(name)}).code,
        0);
    texts.push_back(content_of(folder.path(name)));
  }
  EXPECT_EQ(texts[0], texts[1]);
}

}  // namespace
}  // namespace pantin::test

// Nothing in a glTF document goes without an entry: an account of all of it, and findings about what was
// planted.
#include <algorithm>
#include <nlohmann/json.hpp>
#include <random>
#include <set>

#include "support/gltf_files.hpp"
#include "support/model_text.hpp"

using namespace pantin;
using namespace pantin::test;

namespace {

using Json = nlohmann::ordered_json;
using Pointer = Json::json_pointer;

/// A document, with the binary chunk of the GLB that it comes from.
struct Sample {
  Json json{};
  std::string binary{};
};

Loaded<Model> load(const TemporaryFolder& folder, const Sample& sample, Account* account) {
  const std::string text = sample.json.dump();
  const bool is_glb = !sample.binary.empty();
  return load_gltf(
      folder.write(is_glb ? "m.glb" : "m.gltf",
                   is_glb ? glb(chunk("JSON", text) + chunk(std::string{"BIN\0", 4}, sample.binary)) : text),
      {.account = account});
}

/// Most of what a document may hold: some read, some left out for one reason each.
Sample rich() {
  GltfText text;
  text.floats({0, 0, 0, 1, 0, 0, 0, 1, 0}, "VEC3");
  text.floats({0, 1}, "SCALAR");
  text.floats({1, 2, 3, 4, 5, 6}, "VEC3");
  return {Json::parse(text.embedded(R"("scene": 0, "scenes": [{"nodes": [0], "name": "s"}, {"nodes": [3]}],
      "extensionsUsed": ["KHR_physics_rigid_bodies", "EXT_mesh_gpu_instancing", "ACME_gears"],
      "materials": [{"pbrMetallicRoughness": {"baseColorFactor": [1, 0, 0, 1]}}], "cameras": [{"type": "none"}],
      "skins": [{"joints": [0]}],
      "extensions": {"KHR_physics_rigid_bodies": {"physicsJoints": [{"limits": []}]}},
      "nodes": [{"name": "n", "mesh": 0, "children": [1, 2], "camera": 0,
                 "extensions": {"EXT_mesh_gpu_instancing": {"attributes": {"TRANSLATION": 2, "_ID": 1}}}},
                {"name": "b", "rotation": [0, 0, 2, 0], "extras": {"a": {"b": 1}},
                 "extensions": {"KHR_physics_rigid_bodies": {"motion": {"mass": 2, "centerOfMass": [1, 0, 0],
                   "inertiaDiagonal": [1, 1, 1], "isKinematic": false, "linearVelocity": [1, 0, 0]},
                   "collider": {"shape": 0}}}},
                {"scale": [1, 2, 1], "skin": 0, "extensions": {"ACME_gears": {"teeth": [12]}}}, {"name": "out"}],
      "meshes": [{"name": "m", "primitives": [
          {"attributes": {"POSITION": 0, "NORMAL": 0}, "material": 0, "targets": [{"POSITION": 0}]},
          {"attributes": {"POSITION": 0}, "mode": 0}]}, {"primitives": [{"attributes": {"POSITION": 0}}]}],
      "animations": [{"name": "c", "samplers": [{"input": 1, "output": 2}, {"input": 1, "output": 2, "interpolation": "STEP"}],
                      "channels": [{"sampler": 0, "target": {"node": 1, "path": "translation"}},
                                   {"sampler": 0, "target": {"node": 3, "path": "translation"}},
                                   {"sampler": 0, "target": {"node": 1, "path": "weights"}}]}])"))};
}

std::vector<Sample> samples() {
  const std::string assets = PANTIN_SOURCE_DIR "/assets/";
  const std::string bytes = content_of(assets + "pendulum_room.glb");
  std::uint32_t size = 0;
  std::memcpy(&size, bytes.data() + 12, sizeof size);
  return {rich(),
          {Json::parse(content_of(assets + "mobile.gltf"))},
          {Json::parse(bytes.substr(20, size)), bytes.substr(20 + size + 8)}};
}

/// Every member of an object and every object or array in an array, by pointer; all objects besides.
void list(const Json& value, const std::string& at, std::set<std::string>& elements,
          std::vector<std::string>& objects) {
  if (value.is_object()) objects.push_back(at);
  if (!value.is_structured()) return;
  for (const auto& [key, member] : value.items()) {
    std::string below = at + '/' + key;
    if (value.is_object() || member.is_structured()) elements.insert(below);
    list(member, below, elements, objects);
  }
}

const AccountEntry* entry_of(const Account& account, const std::string& item) {
  const auto found = std::ranges::find_if(
      account, [&](const AccountEntry& e) { return e.item == item && e.fate != Fate::Defaulted; });
  return found == account.end() ? nullptr : &*found;
}

TEST(GltfAccount, HasAnEntryForEveryValue) {
  // Another parser lists what the document holds: each has one entry, and there are no others.
  const TemporaryFolder folder;
  for (const Sample& sample : samples()) {
    Account account;
    const Loaded<Model> loaded = load(folder, sample, &account);
    ASSERT_TRUE(loaded.value) << ledger(loaded);
    std::set<std::string> expected, found;
    std::vector<std::string> objects;
    list(sample.json, "", expected, objects);
    for (const AccountEntry& entry : account) {
      EXPECT_EQ(entry.fate == Fate::Read, entry.why.empty()) << to_string(entry);
      EXPECT_TRUE(found.insert(entry.item).second) << entry.item;
      EXPECT_TRUE(entry.place.ends_with('#' + entry.item)) << entry.place;
    }
    EXPECT_EQ(found, expected);
  }
}

TEST(GltfAccount, NamesWhatIsPlantedAnywhere) {
  // A member that nobody knows, of any kind, in any object: it is accounted for as dropped, and a finding
  // names it unless it stands in something that is dropped as a whole.
  std::mt19937_64 random{9};
  const TemporaryFolder folder;
  const std::vector<Sample> all = samples();
  const std::vector<Json> kinds{0,
                                1.5,
                                false,
                                true,
                                nullptr,
                                "text",
                                Json::array(),
                                Json::object(),
                                Json::array({0, 0, 0}),
                                Json{{"a", 1}}};
  std::size_t named = 0;
  for (int k = 0; k < 600; ++k) {
    Sample sample = all[random() % all.size()];
    std::set<std::string> elements;
    std::vector<std::string> objects;
    list(sample.json, "", elements, objects);
    const std::string at = objects[random() % objects.size()];
    sample.json[Pointer{at}]["zorp"] = kinds[random() % kinds.size()];
    Account account;
    const Loaded<Model> loaded = load(folder, sample, &account);
    ASSERT_TRUE(loaded.value) << at << ledger(loaded);
    const AccountEntry* entry = entry_of(account, at + "/zorp");
    ASSERT_NE(entry, nullptr) << at;
    EXPECT_EQ(entry->fate, Fate::Dropped) << at;
    const AccountEntry* above = entry_of(account, at);
    const bool inside = above != nullptr && above->fate == Fate::Dropped;
    const bool is_named = std::ranges::any_of(loaded.notes, [&](const Diagnostic& note) {
      const bool at_key = note.place.ends_with('#' + at + "/zorp");
      const bool at_owner =
          note.place.ends_with(at.empty() ? "m.gltf" : '#' + at) || note.place.ends_with("m.glb");
      return note.subject.find("'zorp'") != std::string::npos && (at_key || at_owner);
    });
    EXPECT_TRUE(inside || is_named) << at << '\n' << ledger(loaded);
    named += inside ? 0 : 1;
  }
  EXPECT_GT(named, 300u);
}

/// Another value of the same kind, to this side.
Json another(const Json& value, int side) {
  if (value.is_boolean()) return !value.get<bool>();
  if (value.is_string()) return value.get<std::string>() + "x";
  if (value.is_number_integer()) return value.get<int>() + side;
  if (value.is_number()) return value.get<double>() + 0.25 * side;
  Json other = value;
  for (Json& element : other) element = another(element, side);
  return other;
}

TEST(GltfAccount, SaysTheTruthAboutWhatMatters) {
  // Another value of what counts as dropped leaves the model as it is, unless a finding says that it is not
  // dropped then; of what counts as read it changes the model or is refused, or a finding says something
  // else.
  const TemporaryFolder folder;
  std::size_t read = 0, dropped = 0;
  for (const Sample& sample : samples()) {
    Account account;
    const Loaded<Model> before = load(folder, sample, &account);
    for (const AccountEntry& entry : account) {
      const Pointer pointer{entry.item};
      if (sample.json[pointer].is_object() || entry.item.find("/buffers/") == 0) continue;
      const bool is_list = sample.json[pointer].is_array();
      if (is_list && (sample.json[pointer].empty() || sample.json[pointer][0].is_structured())) continue;
      bool matters = false;  // a bound does so to one side only
      for (const int side : {1, -1}) {
        Sample changed = sample;
        changed.json[pointer] = another(sample.json[pointer], side);
        const Loaded<Model> after = load(folder, changed, nullptr);
        const bool same = after.value && text_of_model(*after.value) == text_of_model(*before.value);
        matters = matters || !same || ledger(after) != ledger(before);
        EXPECT_TRUE(entry.fate != Fate::Dropped || same || ledger(after) != ledger(before))
            << to_string(entry);
      }
      ++(entry.fate == Fate::Dropped ? dropped : read);
      EXPECT_TRUE(entry.fate == Fate::Dropped || matters) << to_string(entry);
    }
  }
  EXPECT_GT(read, 50u);
  EXPECT_GT(dropped, 15u);
}

TEST(GltfAccount, GivesAReasonForWhatIsNotRead) {
  // One of each reason: looks, an extension that is not known, data of applications, what says what holds
  // anyway, parts that nothing refers to; a rotation that is made unit is converted.
  const TemporaryFolder folder;
  Account account;
  const Loaded<Model> loaded = load(folder, rich(), &account);
  ASSERT_TRUE(loaded.value);
  const std::string motion = "/nodes/1/extensions/KHR_physics_rigid_bodies/motion/";
  for (const auto& [item, why] : std::vector<std::pair<std::string, std::string>>{
           {"/materials/0/pbrMetallicRoughness/baseColorFactor",
            "not loaded: physics has no use for appearance"},
           {"/nodes/2/extensions/ACME_gears/teeth", "not known to Pantin: what it says is dropped"},
           {"/nodes/1/extras/a/b", "not read: data of applications"},
           {motion + "isKinematic", "says what holds without it"},
           {motion + "linearVelocity", "not read yet"},
           {"/nodes/3/name", "not in the scene: not loaded"},
           {"/meshes/1", "on no node of the scene: not loaded"},
           {"/animations/0/samplers/1", "not needed for physics"},
           {"/nodes/1/rotation", "a quaternion is not of unit length: normalised"}}) {
    const AccountEntry* entry = entry_of(account, item);
    ASSERT_NE(entry, nullptr) << item;
    EXPECT_EQ(entry->why, why) << item;
  }
  EXPECT_NE(
      ledger(loaded).find("m.gltf: note: file: not needed for physics and dropped: 1 'camera', 1 'material', "
                          "1 'name', 1 'skin', 1 of 'samplers' unused"),
      std::string::npos)
      << ledger(loaded);
}

}  // namespace

#pragma once
// Small models whose numbers can be worked out by hand.
#include <cstring>
#include <string>
#include <vector>

namespace pantin::test {

/// base -hinge(pivot about y, at z = 1)-> arm -rail(slider along x, at x = 1)-> carriage; base -echo-> hand,
/// which follows the hinge: 2 * angle + 0.1. The arm weighs 2 kg, the carriage 1 kg; hand has a fixed tip.
inline const std::string kLinkedUrdf = R"(<robot name="linked">
  <link name="base"/>
  <link name="arm">
    <inertial><origin xyz="0 0 -0.5"/><mass value="2"/>
      <inertia ixx="0.2" ixy="0.01" ixz="0" iyy="0.25" iyz="0" izz="0.1"/></inertial>
    <collision><geometry><box size="0.1 0.2 0.3"/></geometry></collision>
  </link>
  <link name="carriage">
    <inertial><mass value="1"/><inertia ixx="0.1" ixy="0" ixz="0" iyy="0.1" iyz="0" izz="0.1"/></inertial>
  </link>
  <link name="hand">
    <inertial><mass value="0.5"/><inertia ixx="0.1" ixy="0" ixz="0" iyy="0.1" iyz="0" izz="0.1"/></inertial>
  </link>
  <link name="tip"/>
  <joint name="hinge" type="revolute"><parent link="base"/><child link="arm"/><origin xyz="0 0 1"/>
    <axis xyz="0 1 0"/><limit lower="-2" upper="2" effort="1" velocity="1"/></joint>
  <joint name="rail" type="prismatic"><parent link="arm"/><child link="carriage"/><origin xyz="1 0 0"/>
    <axis xyz="1 0 0"/><limit lower="-0.5" upper="0.5" effort="1" velocity="1"/></joint>
  <joint name="echo" type="continuous"><parent link="base"/><child link="hand"/>
    <axis xyz="1 0 0"/><mimic joint="hinge" multiplier="2" offset="0.1"/></joint>
  <joint name="glue" type="fixed"><parent link="hand"/><child link="tip"/></joint>
</robot>
)";

/// base -hinge(pivot about y)-> rod: a compound pendulum of 2 kg, centre of gravity 0.5 m from the pivot
/// along -z.
inline const std::string kPendulumUrdf = R"(<robot name="pendulum">
  <link name="base"/>
  <link name="rod">
    <inertial><origin xyz="0 0 -0.5"/><mass value="2"/>
      <inertia ixx="0.2" ixy="0" ixz="0" iyy="0.2" iyz="0" izz="0.1"/></inertial>
  </link>
  <joint name="hinge" type="continuous"><parent link="base"/><child link="rod"/><axis xyz="0 1 0"/></joint>
</robot>
)";

/// One body of 1 kg, centre of gravity at its origin.
inline const std::string kStoneUrdf = R"(<robot name="stone">
  <link name="stone">
    <inertial><mass value="1"/><inertia ixx="0.1" ixy="0" ixz="0" iyy="0.1" iyz="0" izz="0.1"/></inertial>
  </link>
</robot>
)";

/// A link that a joint moves and that has no mass: a warning, not an error.
inline const std::string kMasslessUrdf = R"(<robot name="light">
  <link name="base"/><link name="leaf"><inertial><mass value="0"/>
    <inertia ixx="0" ixy="0" ixz="0" iyy="0" iyz="0" izz="0"/></inertial></link>
  <joint name="hinge" type="continuous"><parent link="base"/><child link="leaf"/><axis xyz="0 1 0"/></joint>
</robot>
)";

/// A mimic of a joint that is not there: an error.
inline const std::string kBrokenUrdf = R"(<robot name="broken">
  <link name="base"/><link name="leaf"/>
  <joint name="grip" type="continuous"><parent link="base"/><child link="leaf"/><mimic joint="palm"/></joint>
</robot>
)";

inline std::string base64(const std::string& bytes) {
  static constexpr char kDigits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    unsigned int word = 0;
    for (std::size_t k = 0; k < 3; ++k)
      word = word << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0u);
    for (std::size_t k = 0; k < 4; ++k)
      out += k <= bytes.size() - i ? kDigits[word >> (18 - 6 * k) & 63] : '=';
  }
  return out;
}

inline std::string bytes_of(const std::vector<float>& numbers) {
  std::string bytes(numbers.size() * sizeof(float), '\0');
  std::memcpy(bytes.data(), numbers.data(), bytes.size());
  return bytes;
}

/// A glTF with a node "track" above a node of the given JSON name text (1 kg), which the clip "go" moves from
/// x = 0 at 0 s to x = 8 at 4 s, and the clip "rise" from y = 0 to y = 4 in the same time. Y is up.
inline std::string cart_gltf(const std::string& name = "cart") {
  const std::string bytes = bytes_of({0, 4, 0, 0, 0, 8, 0, 0, 0, 0, 0, 0, 4, 0});
  return R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
    "extensionsUsed": ["KHR_physics_rigid_bodies"],
    "nodes": [{"name": "track", "children": [1]},
      {"name": ")" +
         name + R"(", "extensions": {"KHR_physics_rigid_bodies":
        {"motion": {"mass": 1, "inertiaDiagonal": [0.1, 0.1, 0.1]}}}}],
    "buffers": [{"byteLength": 56, "uri": "data:application/octet-stream;base64,)" +
         base64(bytes) + R"("}],
    "bufferViews": [{"buffer": 0, "byteLength": 8}, {"buffer": 0, "byteOffset": 8, "byteLength": 24},
      {"buffer": 0, "byteOffset": 32, "byteLength": 24}],
    "accessors": [
      {"bufferView": 0, "componentType": 5126, "count": 2, "type": "SCALAR", "min": [0], "max": [4]},
      {"bufferView": 1, "componentType": 5126, "count": 2, "type": "VEC3"},
      {"bufferView": 2, "componentType": 5126, "count": 2, "type": "VEC3"}],
    "animations": [
      {"name": "go", "samplers": [{"input": 0, "output": 1}],
       "channels": [{"sampler": 0, "target": {"node": 1, "path": "translation"}}]},
      {"name": "rise", "samplers": [{"input": 0, "output": 2}],
       "channels": [{"sampler": 0, "target": {"node": 1, "path": "translation"}}]}]})";
}

}  // namespace pantin::test

#include <algorithm>
#include <map>

#include "support/gltf_files.hpp"

using namespace pantin;
using namespace pantin::test;

namespace {

const std::filesystem::path kFolder = std::filesystem::path{PANTIN_SOURCE_DIR} / "assets" / "broken";

/// Each file assets/broken/gltf_<name> with its one error: what follows the file's name in the message.
const std::map<std::string, std::string> kErrors{
    {"absolute.gltf",
     "#/buffers/0/uri: error: buffer 0: its uri is an absolute path: '/etc/hostname'; put the buffer beside "
     "the model and name it relative to it"},
    {"animated_matrix.gltf",
     "#/animations/0/channels/0/target/node: error: animation 0: animates node 1 'wheel', which is given by "
     "a matrix; give the node by translation, rotation and scale"},
    {"animated_twice.gltf",
     "#/animations/0/channels/1: error: animation 0: the rotation of node 1 is animated twice; keep one of "
     "the channels"},
    {"asset_missing.gltf", ": error: document: 'asset' is missing; add it: glTF 2.0 requires it here"},
    {"base64_bits.gltf",
     "#/buffers/0/uri: error: buffer 0: its base64 text ends within a byte; write "
     "data:application/octet-stream;base64,..."},
    {"base64_character.gltf",
     "#/buffers/0/uri: error: buffer 0: character 2 of its base64 text is not one of base64; write "
     "data:application/octet-stream;base64,..."},
    {"base64_length.gltf",
     "#/buffers/0/uri: error: buffer 0: its base64 text has 5 characters, not a multiple of 4; write "
     "data:application/octet-stream;base64,..."},
    {"binary_short.glb",
     "#/buffers/0/byteLength: error: buffer 0: the buffer should have 104 bytes, its data has 100; export or "
     "copy the model again"},
    {"buffer_empty.gltf",
     "#/buffers/0/byteLength: error: buffer 0: the buffer has 0 bytes; write its true length, 1 to 2^32"},
    {"buffer_short.gltf",
     "#/buffers/0/byteLength: error: buffer 0: the buffer should have 105 bytes, its data has 104; export or "
     "copy the model again"},
    {"buffer_without_uri.gltf",
     "#/buffers/0: error: buffer 0: it has no uri and is not the binary chunk of a GLB; give it a uri"},
    {"chunk_header.glb",
     ": error: file: the GLB ends within the header of the chunk at byte 48; export or copy it again"},
    {"chunk_length.glb",
     ": error: file: the chunk at byte 12 says 1073741824 bytes, 1120 are left; export or copy it again"},
    {"collection_kind.gltf",
     "#/nodes: error: 'nodes': an object stands where an array must be; write an array"},
    {"component_missing.gltf",
     "#/accessors/0: error: accessor 0: 'componentType' is missing; add it: glTF 2.0 requires it here"},
    {"component_type.gltf",
     "#/accessors/0/componentType: error: accessor 0: componentType 5124 is none of glTF 2.0; write 5120, "
     "5121, 5122, 5123, 5125 or 5126"},
    {"count_lying.gltf",
     "#/accessors/0: error: accessor 0: its 4503599627370496 elements of 12 bytes from byte 0 at stride 12 "
     "leave its view of 48 bytes; export the model again"},
    {"count_zero.gltf",
     "#/accessors/0/count: error: accessor 0: its count is 0; leave the accessor out or give it elements"},
    {"cycle.gltf",
     "#/nodes/2: error: node 2 'spoke': the node is its own ancestor; take it out of the children of node 1"},
    {"data_without_comma.gltf",
     "#/buffers/0/uri: error: buffer 0: its data: uri has no comma before the data; write "
     "data:application/octet-stream;base64,..."},
    {"extensions_required.gltf",
     "#/extensionsRequired: error: 'extensionsRequired': the model cannot be read without "
     "'KHR_draco_mesh_compression', 'ACME_gears', which Pantin does not know; export it without them"},
    {"file_missing.gltf",
     "#/buffers/0/uri: error: buffer 0: buffer file 'no_such.bin': does not exist; check the path"},
    {"first_chunk.glb", ": error: file: the first chunk of the GLB is not JSON; export it again"},
    {"glb_version.glb",
     ": error: file: the GLB is of version 1; only version 2 is read; export it as glTF 2.0"},
    {"header_short.glb",
     ": error: file: the GLB ends after 15 bytes, within its header; export or copy it again"},
    {"index_beyond.gltf",
     "#/nodes/0/mesh: error: node 0 'plate': refers to item 1 of 'meshes', which has 1; write an index below "
     "that"},
    {"index_fraction.gltf",
     "#/nodes/0/mesh: error: node 0 'plate': the number is not a whole number from 0 to 2^53; write an "
     "index, count or offset"},
    {"index_negative.gltf",
     "#/nodes/0/mesh: error: node 0 'plate': the number is not a whole number from 0 to 2^53; write an "
     "index, count or offset"},
    {"index_signed.gltf",
     "#/accessors/1: error: accessor 1: indices must be plain unsigned integers; use componentType 5121, "
     "5123 or 5125, not normalised"},
    {"interpolation.gltf",
     "#/animations/0/samplers/0/interpolation: error: animation 0: there is no interpolation 'BEZIER'; write "
     "LINEAR, STEP or CUBICSPLINE"},
    {"item_kind.gltf", "#/nodes/0: error: node 0: a number stands where an object must be; write an object"},
    {"json_chunk.glb",
     ":2: error: file: its JSON chunk has a syntax error while parsing object separator - unexpected string "
     "literal; expected ':'; mend the text or export it again"},
    {"key_twice.gltf",
     "#/nodes/0/name: error: node 0 'plate': the key stands twice in the same object; keep one of them"},
    {"length.glb",
     ": error: file: the GLB header says 100000 bytes, the file has 1140; export or copy it again"},
    {"magic.glb", ": error: file: it does not begin as a GLB does; export or copy it again"},
    {"matrix_and_scale.gltf",
     "#/nodes/0/matrix: error: node 0 'plate': the node has both a matrix and a scale; keep one of them"},
    {"matrix_projective.gltf",
     "#/nodes/0/matrix: error: node 0 'plate': the last row of the matrix is not 0, 0, 0, 1; write an affine "
     "matrix, column after column"},
    {"min_version.gltf",
     "#/asset/minVersion: error: 'asset': the model needs a reader of glTF 2.1; export it for glTF 2.0"},
    {"mode.gltf", "#/meshes/0/primitives/0/mode: error: mesh 0: there is no such mode; write 0 to 6"},
    {"name_kind.gltf", "#/nodes/0/name: error: node 0: a number stands where a text must be; write a text"},
    {"no_name.gltf",
     "#/buffers/0/uri: error: buffer 0: its uri names no file: ''; put the buffer beside the model and name "
     "it relative to it"},
    {"no_nodes.gltf", ": error: document: there is no node to load; put nodes into the default scene"},
    {"normalised_float.gltf",
     "#/accessors/0: error: accessor 0: it is normalised, which its component type cannot be; leave "
     "'normalized' out or use 8 or 16 bit integers"},
    {"not_finite.gltf",
     "#/accessors/0: error: accessor 0: element 1 is not a finite number; export the model again"},
    {"not_object.gltf", ": error: document: an array stands where an object must be; write an object"},
    {"number_count.gltf",
     "#/nodes/0/translation: error: node 0 'plate': has 2 numbers instead of 3; write exactly 3"},
    {"number_kind.gltf",
     "#/nodes/0/translation/1: error: node 0 'plate': a text stands where a number must be; write a number"},
    {"overflow.gltf",
     ":1: error: file: its JSON has a number overflow parsing '1e999'; mend the text or export it again"},
    {"percent.gltf",
     "#/buffers/0/uri: error: buffer 0: the % at character 4 of its uri is not followed by two hexadecimal "
     "digits: 'part%2.bin'; put the buffer beside the model and name it relative to it"},
    {"quaternion_zero.gltf",
     "#/nodes/0/rotation: error: node 0 'plate': a quaternion is zero or too great to have a direction; "
     "write a unit quaternion x, y, z, w"},
    {"random.gltf",
     ":1: error: file: its JSON has a syntax error while parsing value - invalid literal; last read: '?'; "
     "mend the text or export it again"},
    {"rotation_integer.gltf",
     "#/accessors/3: error: accessor 3: rotations in integers must be normalised; set 'normalized' to true"},
    {"rotation_zero.gltf",
     "#/accessors/3: error: accessor 3: a quaternion is zero or too great to have a direction; write a unit "
     "quaternion x, y, z, w"},
    {"sampler_beyond.gltf",
     "#/animations/0/channels/0/sampler: error: animation 0: refers to sampler 1, but there are 1; write an "
     "index below that"},
    {"scene_of_child.gltf",
     "#/scenes/0/nodes/1: error: scene 0: lists node 2, which is a child of node 1; list the top nodes only"},
    {"scene_twice.gltf", "#/scenes/0/nodes/2: error: scene 0: lists node 0 twice; list it once"},
    {"scheme.gltf",
     "#/buffers/0/uri: error: buffer 0: its uri has the scheme 'https', which is not read; download the "
     "buffer into the model's folder"},
    {"sparse_count.gltf",
     "#/accessors/0/sparse: error: accessor 0: it replaces 5 of 4 elements; write a count from 1 to that"},
    {"sparse_index_type.gltf",
     "#/accessors/0/sparse/indices: error: accessor 0: sparse indices must be unsigned integers; use "
     "componentType 5121, 5123 or 5125"},
    {"sparse_order.gltf",
     "#/accessors/0: error: accessor 0: sparse index 3 is out of order or beyond the last element; export "
     "the model again"},
    {"stride.gltf",
     "#/bufferViews/0: error: bufferView 0: its byteStride is 3; write a multiple of 4 from 4 to 252"},
    {"stride_short.gltf",
     "#/accessors/0: error: accessor 0: its elements of 12 bytes overlap at byteStride 8; export the model "
     "again"},
    {"syntax.gltf",
     ":3: error: file: its JSON has a syntax error while parsing object key - unexpected '}'; expected "
     "string literal; mend the text or export it again"},
    {"time_negative.gltf",
     "#/animations/0/channels/0: error: animation 0: key 0 at -1.000000 s is before 0; export the animation "
     "again"},
    {"time_order.gltf",
     "#/animations/0/channels/0: error: animation 0: key 2 at 1.000000 s is not after the key before it; "
     "export the animation again"},
    {"too_many_numbers.gltf",
     "#/accessors/4: error: accessor 4: with this the model would hold more than 134217728 numbers; split "
     "the model"},
    {"traversal.gltf",
     "#/buffers/0/uri: error: buffer 0: its uri leads out of the model's folder: '../mobile.gltf'; put the "
     "buffer beside the model and name it relative to it"},
    {"traversal_encoded.gltf",
     "#/buffers/0/uri: error: buffer 0: its uri leads out of the model's folder: '%2e%2e%2Fmobile.gltf'; put "
     "the buffer beside the model and name it relative to it"},
    {"truncated.gltf",
     ":1: error: file: its JSON has a syntax error while parsing object key - invalid string: missing "
     "closing quote; last read: '\"compo'; expected string literal; mend the text or export it again"},
    {"two_parents.gltf",
     "#/nodes/1/children/0: error: node 1 'wheel': lists node 2, which is already a child of node 0; a node "
     "has one parent: leave it out of one list"},
    {"type.gltf",
     "#/accessors/0/type: error: accessor 0: its type is 'VEC2' where VEC3 is needed; refer to an accessor "
     "of that type"},
    {"value_count.gltf",
     "#/animations/0/channels/0: error: animation 0: 2 keys need 8 numbers, not 4; export the animation "
     "again"},
    {"value_count_cubic.gltf",
     "#/animations/0/channels/0: error: animation 0: 2 keys need 24 numbers, not 8; export the animation "
     "again"},
    {"version_1.gltf",
     "#/asset/version: error: 'asset': the model is glTF 1.0; only glTF 2 is read; convert it to glTF 2.0"},
    {"version_missing.gltf",
     "#/asset: error: 'asset': 'version' is missing; add it: glTF 2.0 requires it here"},
    {"version_no_version.gltf",
     "#/asset/version: error: 'asset': 'two' is no version; write major.minor, \"2.0\" say"},
    {"vertex_beyond.gltf",
     "#/accessors/1: error: accessor 1: index 2 is 2, but there are 2 vertices; export the model again"},
    {"view_beyond.gltf",
     "#/bufferViews/0: error: bufferView 0: its bytes 0 to 1000 leave buffer 0 of 104; export the model "
     "again"},
    {"zero_byte.gltf",
     ":2: error: file: its JSON has a syntax error - a zero byte; mend the text or export it again"},
    {"zeros_without_end.gltf",
     "#/accessors/0: error: accessor 0: it has no bufferView, but 1099511627776 elements; give it a "
     "bufferView or at most 1048576 elements"},
};

TEST(GltfBroken, EachFileHasItsOneError) {
  // Every file was made with one thing wrong (assets/make_broken_gltf.py); place, subject, problem and remedy
  // must be those of that thing, and nothing may be loaded.
  for (const auto& [name, message] : kErrors) {
    const std::filesystem::path file = kFolder / ("gltf_" + name);
    const Loaded<Model> loaded = load_gltf(file);
    EXPECT_FALSE(loaded.value) << name;
    std::vector<std::string> errors;
    for (const Diagnostic& finding : loaded.notes)
      if (finding.severity == Severity::Error) errors.push_back(to_string(finding));
    EXPECT_EQ(errors, std::vector{file.string() + message}) << name;
  }
}

TEST(GltfBroken, EachFileIsInTheTable) {
  // A file without a row would test nothing.
  std::size_t files = 0;
  for (const auto& entry : std::filesystem::directory_iterator{kFolder}) {
    const std::string name = entry.path().filename().string();
    if (!name.starts_with("gltf_")) continue;
    ++files;
    EXPECT_TRUE(kErrors.contains(name.substr(5))) << name;
  }
  EXPECT_EQ(files, kErrors.size());
}

}  // namespace

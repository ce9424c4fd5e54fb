#include <sys/stat.h>

#include "support/gltf_files.hpp"

using namespace pantin;
using namespace pantin::test;
using namespace std::string_literals;

namespace {

/// A triangle and a moving node: something of every kind that a buffer holds.
GltfText triangle_and_clip() {
  GltfText text;
  text.floats({0, 0, 0, 1, 0, 0, 0, 1, 0}, "VEC3");
  text.accessor(packed<std::uint8_t>({2, 1, 0}), 5121, "SCALAR", 3);
  text.floats({0, 0.25F}, "SCALAR");
  text.floats({0, 0, 0, 1, 2, 3}, "VEC3");
  return text;
}

const std::string kContent = R"("nodes": [{"mesh": 0}], "scenes": [{"nodes": [0]}],
    "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
    "animations": [{"channels": [{"sampler": 0, "target": {"node": 0, "path": "translation"}}],
                    "samplers": [{"input": 2, "output": 3}]}])";

void expect_triangle_and_clip(const Loaded<Model>& loaded) {
  const Model model = sound(loaded);
  ASSERT_EQ(model.nodes.size(), 1U);
  ASSERT_EQ(model.nodes[0].meshes.size(), 1U);
  EXPECT_EQ(model.nodes[0].meshes[0].mesh->vertices, (std::vector<Vector3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}));
  EXPECT_EQ(model.nodes[0].meshes[0].mesh->triangles, (std::vector<std::array<std::uint32_t, 3>>{{2, 1, 0}}));
  ASSERT_EQ(model.clips.size(), 1U);
  EXPECT_EQ(model.clips[0].tracks.at(0).times, (std::vector<double>{0, 0.25}));
  EXPECT_EQ(model.clips[0].tracks[0].values, (std::vector<double>{0, 0, 0, 1, 2, 3}));
}

std::string with_uri(const std::string& uri) {
  return triangle_and_clip().document(kContent, "\"uri\": \"" + uri + "\", ");
}

std::string percent_encoded(const std::string& bytes) {
  std::string text;
  for (const char c : bytes) {
    const auto byte = static_cast<unsigned char>(c);
    text += '%';
    text += "0123456789abcdef"[byte >> 4];
    text += "0123456789ABCDEF"[byte & 15];
  }
  return text;
}

TEST(GltfBuffers, AreTheSameInAllTheirForms) {
  // Embedded in base64 or percent-encoded, beside the model or in the chunk of a GLB: the same bytes, the
  // same model.
  const TemporaryFolder folder;
  const GltfText text = triangle_and_clip();
  expect_triangle_and_clip(load_text(text.embedded(kContent)));
  expect_triangle_and_clip(
      load_text(with_uri("data:application/gltf-buffer;base64," + base64(text.bytes()))));
  expect_triangle_and_clip(load_text(with_uri("DATA:;charset=x;base64," + base64(text.bytes()))));
  expect_triangle_and_clip(load_text(with_uri("data:," + percent_encoded(text.bytes()))));
  folder.write("a part.bin", text.bytes());
  expect_triangle_and_clip(load_gltf(folder.write("a.gltf", with_uri("a%20part.bin"))));
  std::filesystem::create_directory(folder.path() / "sub");
  folder.write("sub/b.bin", text.bytes() + "more than byteLength says");
  expect_triangle_and_clip(load_gltf(folder.write("b.gltf", with_uri("./sub/../sub/b.bin"))));
  const Loaded<Model> binary = load_gltf(
      folder.write("c.glb", glb(chunk("JSON", text.document(kContent, "")) + chunk("BIN\0"s, text.bytes()))));
  expect_triangle_and_clip(binary);
  EXPECT_EQ(binary.value->format, "glb");
}

TEST(GltfBuffers, AreFoundByContentNotByName) {
  // A GLB called .gltf and text called .glb are read for what they are.
  const TemporaryFolder folder;
  const GltfText text = triangle_and_clip();
  const std::string binary = glb(chunk("JSON", text.document(kContent, "")) + chunk("BIN\0"s, text.bytes()));
  expect_triangle_and_clip(load_gltf(folder.write("a.gltf", binary)));
  expect_triangle_and_clip(load_gltf(folder.write("b.glb", text.embedded(kContent))));
}

TEST(GltfBuffers, MayBeReachedFromAnyWorkingFolder) {
  // The model is named without a folder: its buffer is still looked for beside it.
  const TemporaryFolder folder;
  folder.write("part.bin", triangle_and_clip().bytes());
  folder.write("model.gltf", with_uri("part.bin"));
  const std::filesystem::path before = std::filesystem::current_path();
  std::filesystem::current_path(folder.path());
  const Loaded<Model> loaded = load_gltf("model.gltf");
  std::filesystem::current_path(before);
  expect_triangle_and_clip(loaded);
}

TEST(GltfBuffers, NeverComeFromOutsideTheFolder) {
  // Each of these names an existing file with the right bytes outside of the model's folder; none may be
  // read.
  const TemporaryFolder folder;
  const std::string bytes = triangle_and_clip().bytes();
  folder.write("secret.bin", bytes);
  std::filesystem::create_directory(folder.path() / "model");
  std::filesystem::create_directory(folder.path() / "model-2");
  folder.write("model-2/secret.bin", bytes);
  std::filesystem::create_symlink(folder.path() / "secret.bin", folder.path() / "model" / "link.bin");
  std::filesystem::create_directory_symlink(folder.path() / "model-2", folder.path() / "model" / "linked");
  const std::string outside = (folder.path() / "secret.bin").string();
  for (const std::string& uri :
       {std::string{"../secret.bin"}, std::string{"x/../../secret.bin"}, std::string{"%2e%2E/secret.bin"},
        std::string{"..%2Fsecret.bin"}, std::string{"../model-2/secret.bin"}, std::string{"link.bin"},
        std::string{"linked/secret.bin"}, outside, "%2F" + outside.substr(1), "file://" + outside,
        "//" + outside}) {
    const Loaded<Model> loaded = load_gltf(folder.write("model/m.gltf", with_uri(uri)));
    EXPECT_FALSE(loaded.value) << uri;
    ASSERT_EQ(loaded.notes.size(), 1U) << uri;
    const std::string& problem = loaded.notes[0].problem;
    EXPECT_TRUE(problem.starts_with("its uri leads out") ||
                problem.starts_with("its uri is an absolute path") ||
                problem.starts_with("its uri has the scheme 'file'"))
        << uri << ": " << problem;
  }
}

TEST(GltfBuffers, MayComeThroughLinksInsideTheFolder) {
  // A symbolic link is no harm where it stays within the folder, nor where the folder itself is reached by
  // one.
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder.path() / "model");
  folder.write("model/part.bin", triangle_and_clip().bytes());
  folder.write("model/m.gltf", with_uri("link.bin"));
  std::filesystem::create_symlink("part.bin", folder.path() / "model" / "link.bin");
  std::filesystem::create_directory_symlink("model", folder.path() / "alias");
  expect_triangle_and_clip(load_gltf(folder.path() / "alias" / "m.gltf"));
}

TEST(GltfBuffers, AreNotReadFromPipesAndFolders) {
  // Opening a pipe for reading would wait for a writer that never comes.
  const TemporaryFolder folder;
  ASSERT_EQ(mkfifo((folder.path() / "pipe.bin").c_str(), 0600), 0);
  for (const std::string uri : {"pipe.bin", "."}) {
    const Loaded<Model> loaded = load_gltf(folder.write("m.gltf", with_uri(uri)));
    EXPECT_FALSE(loaded.value);
    EXPECT_EQ(loaded.notes.at(0).problem,
              "buffer file '" + uri + "': " + (uri == "." ? "is a folder" : "is not a regular file"));
  }
}

TEST(GltfContainer, NotesWhatItSkips) {
  // A chunk of another type, a second BIN chunk, bytes after the end and a chunk without padding are all told
  // of; the model is whole.
  const TemporaryFolder folder;
  const GltfText text = triangle_and_clip();
  std::string json = text.document(kContent, "");
  json.resize((json.size() + 3) / 4 * 4 + 1, ' ');
  const std::string chunks = word(static_cast<std::uint32_t>(json.size())) + "JSON" + json +
                             chunk("BIN\0"s, text.bytes()) + chunk("ODD\0"s, "1234") +
                             chunk("BIN\0"s, "1234");
  const Loaded<Model> loaded = load_gltf(folder.write("a.glb", glb(chunks) + "tail"));
  ASSERT_TRUE(loaded.value);
  const std::size_t odd = 12 + 8 + json.size() + 8 + text.bytes().size();
  EXPECT_EQ(ledger(loaded),
            "a.glb: warning: file: 4 bytes after the end of the GLB are not read; export it again\n"
            "a.glb: warning: file: the chunk at byte 12 is not padded to 4 bytes; export it again\n"
            "a.glb: note: file: the chunk of unknown type 4473935 at byte " +
                std::to_string(odd) +
                " is not read\n"
                "a.glb: warning: file: a second chunk of type BIN at byte " +
                std::to_string(odd + 12) + " is not read; export it again\n");
}

TEST(GltfContainer, TakesTextPaddedWithZeros) {
  // Some writers pad the JSON chunk with zero bytes; blanks are what the format wants.
  const TemporaryFolder folder;
  std::string json = R"({"asset": {"version": "2.0"}, "nodes": [{}], "scenes": [{"nodes": [0]}]})";
  json.resize((json.size() + 4) / 4 * 4, '\0');
  ASSERT_EQ(json.back(), '\0');
  EXPECT_EQ(sound(load_gltf(folder.write("a.glb",
                                         glb(word(static_cast<std::uint32_t>(json.size())) + "JSON" + json))))
                .nodes.size(),
            1U);
}

TEST(GltfContainer, NotesABinaryChunkThatNothingUses) {
  // Buffer 0 has its own uri, so the chunk belongs to nothing.
  const TemporaryFolder folder;
  const GltfText text = triangle_and_clip();
  const Loaded<Model> loaded =
      load_gltf(folder.write("a.glb", glb(chunk("JSON", text.embedded(kContent)) + chunk("BIN\0"s, "1234"))));
  ASSERT_EQ(loaded.notes.size(), 1U);
  EXPECT_EQ(loaded.notes[0].problem, "the binary chunk of the GLB belongs to no buffer and is not read");
}

TEST(GltfContainer, RefusesJsonBeyondItsLimit) {
  // 2^28 + 1 bytes, nearly all of them a hole in the file: refused by size, before any of it is parsed.
  const TemporaryFolder folder;
  const std::filesystem::path file = folder.write("a.gltf", "{");
  std::filesystem::resize_file(file, (std::uintmax_t{1} << 28) + 1);
  const Loaded<Model> loaded = load_gltf(file);
  ASSERT_EQ(loaded.notes.size(), 1U);
  EXPECT_EQ(
      to_string(loaded.notes[0]),
      file.string() +
          ": error: file: its JSON has 268435457 bytes, more than 268435456; move its data into a .bin file");
}

TEST(GltfContainer, RefusesWhatIsNoFile) {
  // A missing file, a folder, an empty file: one error each.
  const TemporaryFolder folder;
  for (const std::filesystem::path& file :
       {folder.path() / "none.gltf", folder.path(), folder.write("empty.glb", "")}) {
    const Loaded<Model> loaded = load_gltf(file);
    EXPECT_FALSE(loaded.value);
    ASSERT_EQ(loaded.notes.size(), 1U);
    EXPECT_EQ(loaded.notes[0].severity, Severity::Error);
    EXPECT_EQ(loaded.notes[0].place, file.string());
  }
}

}  // namespace

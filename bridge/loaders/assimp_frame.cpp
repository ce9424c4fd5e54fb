#include <pantin/bridge/loaders/assimp_frame.hpp>

#include <assimp/scene.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <optional>

namespace pantin::assimp_loader {
namespace {

/// The decimal number that a single-precision one was most likely written as: 0.01f is 0.01, not
/// 0.0099999998.
double shortest_decimal(float value) {
  std::array<char, 32> buffer{};
  const auto written = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value);
  double result = value;
  std::from_chars(buffer.data(), written.ptr, result);
  return result;
}

std::string text_of(double value) {
  std::array<char, 32> buffer{};
  const auto written = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value);
  return {buffer.data(), written.ptr};
}

/// The top node of a COLLADA scene is s R with R turning the file's up axis to +Y: the second row of R is
/// that axis.
FileFrame collada_frame(const aiScene& scene) {
  const aiMatrix4x4& m = scene.mRootNode->mTransformation;
  const std::array<std::array<float, 3>, 3> rows{
      {{m.a1, m.a2, m.a3}, {m.b1, m.b2, m.b3}, {m.c1, m.c2, m.c3}}};
  const float scale = std::hypot(rows[1][0], rows[1][1], rows[1][2]);
  const bool moved = m.a4 != 0 || m.b4 != 0 || m.c4 != 0;
  if (moved || !std::isfinite(scale) || scale <= 0) return {};
  UpAxis up{UpAxis::Y};
  int found = 0;
  for (const UpAxis axis : {UpAxis::X, UpAxis::Y, UpAxis::Z}) {
    if (std::abs(rows[1][static_cast<std::size_t>(axis)] / scale - 1) > 1e-6F) continue;
    up = axis;
    ++found;
  }
  for (const auto& row : rows) {  // each row must hold one number, the scale or its negative
    const auto is_zero = [&](float x) { return std::abs(x) <= 1e-6F * scale; };
    const float length = std::hypot(row[0], row[1], row[2]);
    if (std::count_if(row.begin(), row.end(), is_zero) != 2 || std::abs(length / scale - 1) > 1e-6F)
      found = 0;
  }
  if (found != 1) return {};
  return {up, shortest_decimal(scale), true, true, true};
}

template <class Number>
std::optional<double> metadata(const aiMetadata& data, const char* key) {
  Number value{};
  if (!data.Get(key, value)) return std::nullopt;
  return static_cast<double>(value);
}

std::optional<double> number_of(const aiScene& scene, const char* key) {
  if (scene.mMetaData == nullptr) return std::nullopt;
  const aiMetadata& data = *scene.mMetaData;
  if (auto value = metadata<double>(data, key)) return value;
  if (auto value = metadata<float>(data, key)) return shortest_decimal(static_cast<float>(*value));
  return metadata<std::int32_t>(data, key);
}

/// UpAxis is 0, 1 or 2 for x, y, z; UnitScaleFactor is centimetres per unit.
FileFrame fbx_frame(const aiScene& scene) {
  FileFrame frame{.up_axis = UpAxis::Y, .unit_m = 0.01};
  if (const auto up = number_of(scene, "UpAxis"); up && (*up == 0 || *up == 1 || *up == 2)) {
    frame.up_axis = *up == 0 ? UpAxis::X : *up == 1 ? UpAxis::Y : UpAxis::Z;
    frame.states_up = true;
  }
  if (const auto unit = number_of(scene, "UnitScaleFactor"); unit && std::isfinite(*unit) && *unit > 0) {
    frame.unit_m = *unit / 100;
    frame.states_unit = true;
  }
  return frame;
}

}  // namespace

FileFrame frame_of(const aiScene& scene, std::string_view extension) {
  if (extension == "dae" || extension == "zae") return collada_frame(scene);
  if (extension == "fbx") return fbx_frame(scene);
  constexpr std::array<std::string_view, 4> kZUp{"stl", "ply", "3mf", "amf"};
  const bool z_up = std::find(kZUp.begin(), kZUp.end(), extension) != kZUp.end();
  return {.up_axis = z_up ? UpAxis::Z : UpAxis::Y, .unit_m = 1};
}

std::vector<Diagnostic> notes_about(const FileFrame& frame, const std::string& place) {
  std::vector<Diagnostic> notes;
  const std::string up{to_string(frame.up_axis)};
  if (!frame.states_up) {
    notes.push_back({Severity::Note, place, "up axis", "is not stated by the file: " + up + " is taken", ""});
  }
  if (!frame.states_unit) {
    notes.push_back({Severity::Note, place, "unit",
                     "is not stated by the file: " + text_of(frame.unit_m) + " m is taken", ""});
  }
  if (frame.unit_m != 1) {
    notes.push_back({Severity::Note, place, "unit",
                     "lengths are multiplied by " + text_of(frame.unit_m) + " to be metres", ""});
  }
  return notes;
}

}  // namespace pantin::assimp_loader

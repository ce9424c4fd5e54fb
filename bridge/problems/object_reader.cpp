#include "object_reader.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace pantin::reference {
namespace {

std::string digits(double number) {
  char out[32];
  std::snprintf(out, sizeof out, "%.12g", number);
  return out;
}

}  // namespace

ObjectReader::ObjectReader(const JsonValue& value, std::string place, std::string subject,
                           std::vector<Diagnostic>& ledger)
    : value_{value}, place_{std::move(place)}, subject_{std::move(subject)}, ledger_{ledger} {
  value.use = JsonUse::Read;
  if (value.kind != JsonKind::Object) {
    ledger_.push_back({Severity::Error, place_, subject_,
                       "is " + std::string{to_string(value.kind)} + ", not an object", "write it as {...}"});
  }
}

ObjectReader::~ObjectReader() {
  for (const auto& [key, value] : value_.members) {
    if (value.use != JsonUse::Unseen) continue;
    value.use = JsonUse::Unknown;
    warn(key, "the reader does not know this key: dropped", "check its spelling");
  }
}

const JsonValue* ObjectReader::find(std::string_view key) const {
  for (const auto& [name, value] : value_.members) {
    if (name == key) return &value;
  }
  return nullptr;
}

void ObjectReader::missing(std::string_view key) {
  if (value_.kind != JsonKind::Object) return;  // that is told already
  ledger_.push_back({Severity::Error, place_, subject_, "has no '" + std::string{key} + "'", "add it"});
}

const JsonValue* ObjectReader::take(std::string_view key, JsonKind kind) {
  const JsonValue* found = find(key);
  if (found == nullptr) return nullptr;
  found->use = JsonUse::Read;
  if (found->kind == kind) return found;
  error(key, "is " + std::string{to_string(found->kind)} + ", not " + std::string{to_string(kind)},
        "mend it");
  return nullptr;
}

const JsonValue* ObjectReader::take_required(std::string_view key, JsonKind kind) {
  if (!has(key)) missing(key);
  return take(key, kind);
}

bool ObjectReader::is_sensible(std::string_view key, const JsonValue& number) {
  constexpr double kGreatest = 1e150;  // products of two are finite, so positions and moments are
  if (std::abs(number.number) <= kGreatest) return true;
  error(key, "holds a number beyond 1e150, too great to be computed with", "choose numbers of sensible size");
  return false;
}

std::optional<double> ObjectReader::number_if(std::string_view key) {
  const JsonValue* found = take(key, JsonKind::Number);
  if (found == nullptr || !is_sensible(key, *found)) return std::nullopt;
  return found->number;
}

double ObjectReader::number(std::string_view key) {
  if (!has(key)) missing(key);
  return number_if(key).value_or(0);
}

std::optional<std::string> ObjectReader::text_if(std::string_view key) {
  const JsonValue* found = take(key, JsonKind::Text);
  return found != nullptr ? std::optional{found->text} : std::nullopt;
}

std::string ObjectReader::text(std::string_view key) {
  if (!has(key)) missing(key);
  return text_if(key).value_or("");
}

std::optional<Eigen::VectorXd> ObjectReader::numbers(std::string_view key, const JsonValue& list,
                                                     std::size_t count) {
  const bool all_numbers = std::all_of(list.elements.begin(), list.elements.end(),
                                       [](const JsonValue& v) { return v.kind == JsonKind::Number; });
  if (list.elements.size() != count || !all_numbers) {
    error(key, "is not a list of " + std::to_string(count) + " numbers", "mend it");
    return std::nullopt;
  }
  for (const JsonValue& element : list.elements) {
    if (!is_sensible(key, element)) return std::nullopt;
  }
  Eigen::VectorXd out(static_cast<Eigen::Index>(count));
  for (std::size_t i = 0; i < count; ++i) out[static_cast<Eigen::Index>(i)] = list.elements[i].number;
  return out;
}

std::optional<Vector3> ObjectReader::vector3_if(std::string_view key) {
  const JsonValue* found = take(key, JsonKind::Array);
  if (found == nullptr) return std::nullopt;
  const std::optional<Eigen::VectorXd> read = numbers(key, *found, 3);
  return read ? std::optional<Vector3>{*read} : std::nullopt;
}

Vector3 ObjectReader::vector3(std::string_view key) {
  if (!has(key)) missing(key);
  return vector3_if(key).value_or(Vector3::Zero());
}

Vector3 ObjectReader::unit_vector3(std::string_view key) {
  if (!has(key)) missing(key);
  const std::optional<Vector3> axis = vector3_if(key);
  if (!axis) return Vector3::UnitZ();
  const double length = axis->stableNorm();
  if (!(std::abs(length - 1) <= kUnitTolerance)) {
    error(key, "is not a unit vector: its length is " + digits(length), "divide it by its length");
    return Vector3::UnitZ();
  }
  return *axis / length;
}

std::optional<Quaternion> ObjectReader::quaternion_if(std::string_view key) {
  const JsonValue* found = take(key, JsonKind::Array);
  if (found == nullptr) return std::nullopt;
  const std::optional<Eigen::VectorXd> read = numbers(key, *found, 4);
  if (!read) return std::nullopt;
  const double length = read->stableNorm();
  if (!(std::abs(length - 1) <= kUnitTolerance)) {
    error(key, "is not a unit quaternion: its length is " + digits(length), "divide it by its length");
    return std::nullopt;
  }
  return Quaternion{(*read)[0], (*read)[1], (*read)[2], (*read)[3]}.normalized();
}

Quaternion ObjectReader::quaternion(std::string_view key) {
  if (!has(key)) missing(key);
  return quaternion_if(key).value_or(Quaternion::Identity());
}

Matrix3 ObjectReader::matrix3(std::string_view key) {
  Matrix3 out = Matrix3::Identity();
  const JsonValue* found = take_required(key, JsonKind::Array);
  if (found == nullptr) return out;
  if (found->elements.size() != 3) {
    error(key, "is not a list of three rows", "mend it");
    return out;
  }
  for (std::size_t row = 0; row < 3; ++row) {
    const std::optional<Eigen::VectorXd> read = numbers(key, found->elements[row], 3);
    if (!read) return out;
    out.row(static_cast<Eigen::Index>(row)) = read->transpose();
  }
  return out;
}

const std::vector<JsonValue>& ObjectReader::list_if(std::string_view key) {
  static const std::vector<JsonValue> kNone;
  const JsonValue* found = take(key, JsonKind::Array);
  return found != nullptr ? found->elements : kNone;
}

const std::vector<JsonValue>& ObjectReader::list(std::string_view key) {
  if (!has(key)) missing(key);
  return list_if(key);
}

const JsonValue* ObjectReader::object_if(std::string_view key) { return take(key, JsonKind::Object); }

void ObjectReader::skip(std::initializer_list<std::string_view> keys) {
  for (const std::string_view key : keys) {
    if (const JsonValue* found = find(key)) found->use = JsonUse::NotNeeded;
  }
}

void ObjectReader::skip_all() {
  for (const auto& [key, value] : value_.members) value.use = JsonUse::NotNeeded;
}

void ObjectReader::error(std::string_view key, std::string problem, std::string remedy) const {
  ledger_.push_back({Severity::Error, place(key), subject_,
                     "'" + std::string{key} + "' " + std::move(problem), std::move(remedy)});
}

void ObjectReader::warn(std::string_view key, std::string problem, std::string remedy) const {
  ledger_.push_back({Severity::Warning, place(key), subject_,
                     "'" + std::string{key} + "': " + std::move(problem), std::move(remedy)});
}

std::optional<std::string> read_type(ObjectReader& reader) {
  if (reader.has("type")) return reader.text_if("type");
  (void)reader.text("type");
  return std::nullopt;
}

void refuse_type(ObjectReader& reader, const std::optional<std::string>& type, const char* known) {
  if (type) {
    reader.error("type", "is '" + *type + "', which the reader does not know",
                 std::string{"known are "} + known);
  }
  reader.skip_all();
}

}  // namespace pantin::reference

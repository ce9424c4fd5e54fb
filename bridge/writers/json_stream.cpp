#include <pantin/bridge/writers/json_stream.hpp>

#include <nlohmann/json.hpp>

namespace pantin {
namespace {

std::string text_of(const nlohmann::json& json) {
  return json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

}  // namespace

/// What stands between this value and the one before.
void JsonStream::separate() {
  if (after_key_) {
    after_key_ = false;
    return;
  }
  if (open_.empty()) return;
  Open& inner = open_.back();
  if (!inner.empty) out_ << ',';
  if (inner.layout == JsonLayout::Lines) out_ << '\n';
  else if (!inner.empty) out_ << ' ';
  inner.empty = false;
}

void JsonStream::open(char bracket, JsonLayout layout) {
  separate();
  out_ << bracket;
  open_.push_back({layout, true});
}

void JsonStream::close(char bracket) {
  if (open_.back().layout == JsonLayout::Lines && !open_.back().empty) out_ << '\n';
  open_.pop_back();
  out_ << bracket;
  if (open_.empty()) out_ << '\n';
}

JsonStream& JsonStream::begin_object(JsonLayout layout) {
  open('{', layout);
  return *this;
}

JsonStream& JsonStream::end_object() {
  close('}');
  return *this;
}

JsonStream& JsonStream::begin_array(JsonLayout layout) {
  open('[', layout);
  return *this;
}

JsonStream& JsonStream::end_array() {
  close(']');
  return *this;
}

JsonStream& JsonStream::key(std::string_view name) {
  separate();
  out_ << text_of(name) << ": ";
  after_key_ = true;
  return *this;
}

JsonStream& JsonStream::value(double number) {
  separate();
  out_ << text_of(number);
  return *this;
}

JsonStream& JsonStream::value(std::int64_t number) {
  separate();
  out_ << text_of(number);
  return *this;
}

JsonStream& JsonStream::value(bool truth) {
  separate();
  out_ << (truth ? "true" : "false");
  return *this;
}

JsonStream& JsonStream::value(std::string_view text) {
  separate();
  out_ << text_of(text);
  return *this;
}

JsonStream& JsonStream::null() {
  separate();
  out_ << "null";
  return *this;
}

JsonStream& JsonStream::value(std::span<const double> numbers) {
  begin_array();
  for (const double number : numbers) value(number);
  return end_array();
}

JsonStream& JsonStream::value(const Vector3& v) { return value(std::span{v.data(), 3}); }

JsonStream& JsonStream::value(const Quaternion& q) {
  const std::array<double, 4> wxyz{q.w(), q.x(), q.y(), q.z()};
  return value(std::span<const double>{wxyz});
}

JsonStream& JsonStream::value(const Matrix3& m) {
  begin_array();
  for (int row = 0; row < 3; ++row) value(Vector3{m.row(row)});
  return end_array();
}

JsonStream& JsonStream::value(const Affine& M) {
  begin_array();
  for (int row = 0; row < 4; ++row) {
    begin_array();
    for (int column = 0; column < 4; ++column) value(M.matrix()(row, column));
    end_array();
  }
  return end_array();
}

}  // namespace pantin

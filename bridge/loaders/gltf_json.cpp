#include "gltf_json.hpp"

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>

namespace pantin::gltf {
namespace {

/// Longer pointers are cut: glTF is flat, deeper values can only be nonsense.
constexpr std::size_t kPointerDepth = 32;

}  // namespace

std::string_view to_string(JsonKind kind) noexcept {
  constexpr std::array<std::string_view, 6> kNames{"null",   "true or false", "a number",
                                                   "a text", "an array",      "an object"};
  return kNames[static_cast<std::size_t>(kind)];
}

std::string shortened(std::string_view text, std::size_t bytes) {
  if (text.size() <= bytes) return std::string{text};
  std::size_t end = bytes;
  while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0U) == 0x80U) --end;
  return std::string{text.substr(0, end)} + "...";
}

JsonKind JsonValue::kind() const noexcept { return tree_->entries_[entry_].kind; }

std::size_t JsonValue::size() const noexcept { return tree_->entries_[entry_].count; }

JsonValue JsonValue::at(std::size_t i) const {
  return {*tree_, tree_->children_.at(tree_->entries_[entry_].first + i)};
}

std::optional<JsonValue> JsonValue::find(std::string_view key) const {
  if (kind() != JsonKind::Object) return std::nullopt;
  const auto first = tree_->children_.begin() + tree_->entries_[entry_].first;
  const auto last = first + tree_->entries_[entry_].count;
  const auto found = std::lower_bound(first, last, key, [&](std::uint32_t entry, std::string_view wanted) {
    return tree_->key_of(entry) < wanted;
  });
  if (found == last || tree_->key_of(*found) != key) return std::nullopt;
  return JsonValue{*tree_, *found};
}

double JsonValue::number() const noexcept {
  return kind() == JsonKind::Number ? tree_->entries_[entry_].number : 0.0;
}

bool JsonValue::boolean() const noexcept {
  return kind() == JsonKind::Boolean && tree_->entries_[entry_].number != 0.0;
}

std::string_view JsonValue::text() const noexcept {
  const JsonTree::Entry& entry = tree_->entries_[entry_];
  return entry.kind == JsonKind::Text ? std::string_view{tree_->texts_[entry.first]} : std::string_view{};
}

std::string_view JsonValue::key() const noexcept { return tree_->key_of(entry_); }

std::size_t JsonValue::position() const noexcept { return tree_->entries_[entry_].position; }

std::optional<JsonValue> JsonValue::parent() const {
  if (entry_ == 0) return std::nullopt;
  return JsonValue{*tree_, tree_->entries_[entry_].parent};
}

std::string JsonValue::pointer() const {
  std::vector<std::string> tokens;
  for (std::optional<JsonValue> at = *this; at->entry_ != 0; at = at->parent()) {
    if (at->parent()->kind() == JsonKind::Array) {
      tokens.push_back(std::to_string(at->position()));
      continue;
    }
    std::string token;
    for (const char c : shortened(at->key())) token += c == '~' ? "~0" : c == '/' ? "~1" : std::string(1, c);
    tokens.push_back(std::move(token));
  }
  std::string result;
  for (std::size_t i = 0; i < std::min(tokens.size(), kPointerDepth); ++i) {
    result += '/';
    result += tokens[tokens.size() - 1 - i];
  }
  return tokens.size() > kPointerDepth ? result + "/..." : result;
}

/// Fills a tree from the events of the parser. A container's children are gathered on one stack and moved to
/// the tree's pool when it closes.
class JsonBuilder final : public nlohmann::json_sax<nlohmann::json> {
 public:
  explicit JsonBuilder(std::string_view text) : text_{text} { tree_.texts_.emplace_back(); }

  bool null() override { return add(JsonKind::Null, 0); }
  bool boolean(bool value) override { return add(JsonKind::Boolean, value ? 1 : 0); }
  bool number_integer(std::int64_t value) override {
    return add(JsonKind::Number, static_cast<double>(value));
  }
  bool number_unsigned(std::uint64_t value) override {
    return add(JsonKind::Number, static_cast<double>(value));
  }
  bool number_float(double value, const std::string& /*token*/) override {
    return add(JsonKind::Number, value);
  }
  bool string(std::string& value) override {
    add(JsonKind::Text, 0);
    tree_.entries_.back().first = keep(std::move(value));
    return true;
  }
  bool binary(nlohmann::json::binary_t& /*value*/) override { return false; }  // not in JSON text
  bool key(std::string& value) override {
    key_ = keep(std::move(value));
    return true;
  }
  bool start_object(std::size_t /*size*/) override { return open(JsonKind::Object); }
  bool start_array(std::size_t /*size*/) override { return open(JsonKind::Array); }
  bool end_object() override { return close(); }
  bool end_array() override { return close(); }
  bool parse_error(std::size_t position, const std::string& /*token*/,
                   const nlohmann::json::exception& exception) override {
    const std::size_t read = std::min(position > 0 ? position - 1 : 0, text_.size());
    const auto end = text_.begin() + static_cast<std::ptrdiff_t>(read);
    error_.line = 1 + static_cast<std::size_t>(std::count(text_.begin(), end, '\n'));
    const std::string_view what = exception.what();
    const std::size_t start = std::min(what.find("syntax error"), what.find("number overflow"));
    error_.text = shortened(what.substr(start == std::string_view::npos ? 0 : start), 160);
    // What the parser quotes may be any bytes; a diagnostic is text.
    for (char& c : error_.text) c = static_cast<unsigned char>(c) < 0x80 ? c : '?';
    return false;
  }

  JsonTree tree_;
  JsonError error_;

 private:
  struct Open {
    std::uint32_t entry;
    std::size_t first_child;  // in pending_
  };

  std::uint32_t keep(std::string&& text) {
    tree_.texts_.push_back(std::move(text));
    return static_cast<std::uint32_t>(tree_.texts_.size() - 1);
  }

  bool add(JsonKind kind, double number) {
    JsonTree::Entry entry{.kind = kind, .key = std::exchange(key_, 0U), .number = number};
    if (!open_.empty()) {
      entry.parent = open_.back().entry;
      entry.position = static_cast<std::uint32_t>(pending_.size() - open_.back().first_child);
      pending_.push_back(static_cast<std::uint32_t>(tree_.entries_.size()));
    }
    tree_.entries_.push_back(entry);
    return true;
  }

  bool open(JsonKind kind) {
    add(kind, 0);
    open_.push_back({static_cast<std::uint32_t>(tree_.entries_.size() - 1), pending_.size()});
    return true;
  }

  bool close() {
    JsonTree::Entry& entry = tree_.entries_[open_.back().entry];
    const auto first = pending_.begin() + static_cast<std::ptrdiff_t>(open_.back().first_child);
    entry.first = static_cast<std::uint32_t>(tree_.children_.size());
    entry.count = static_cast<std::uint32_t>(pending_.end() - first);
    if (entry.kind == JsonKind::Object)
      std::stable_sort(first, pending_.end(), [this](std::uint32_t a, std::uint32_t b) {
        return tree_.key_of(a) < tree_.key_of(b);
      });
    tree_.children_.insert(tree_.children_.end(), first, pending_.end());
    pending_.erase(first, pending_.end());
    open_.pop_back();
    return true;
  }

  std::string_view text_;
  std::uint32_t key_{0};
  std::vector<Open> open_;
  std::vector<std::uint32_t> pending_;
};

std::optional<JsonTree> JsonTree::parse(std::string_view text, JsonError& error) {
  JsonBuilder builder{text};
  // The parser takes a zero byte for the end of its input and would overlook whatever follows.
  if (const std::size_t zero = text.find('\0'); zero != std::string_view::npos) {
    const auto end = text.begin() + static_cast<std::ptrdiff_t>(zero);
    error = {1 + static_cast<std::size_t>(std::count(text.begin(), end, '\n')), "syntax error - a zero byte"};
    return std::nullopt;
  }
  if (!nlohmann::json::sax_parse(text.begin(), text.end(), &builder)) {
    error = std::move(builder.error_);
    return std::nullopt;
  }
  return std::move(builder.tree_);
}

std::optional<JsonValue> JsonTree::first_duplicate() const {
  for (const Entry& entry : entries_) {
    if (entry.kind != JsonKind::Object) continue;
    const auto first = children_.begin() + entry.first;
    const auto last = first + entry.count;
    const auto twice = std::adjacent_find(
        first, last, [&](std::uint32_t a, std::uint32_t b) { return key_of(a) == key_of(b); });
    if (twice != last) return JsonValue{*this, *(twice + 1)};
  }
  return std::nullopt;
}

}  // namespace pantin::gltf

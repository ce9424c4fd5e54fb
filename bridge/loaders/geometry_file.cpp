#include <pantin/bridge/loaders/geometry_file.hpp>

#include <algorithm>
#include <charconv>
#include <cmath>

namespace pantin::geometry_loader {
namespace {

constexpr std::string_view kBlanks = " \t\r\n\v\f";
constexpr std::uint32_t kUnused = ~std::uint32_t{0};

template <class Number>
std::optional<Number> whole(std::string_view word) {
  if (word.starts_with('+')) word.remove_prefix(1);
  Number value{};
  const auto [end, problem] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (problem != std::errc{} || end != word.data() + word.size()) return std::nullopt;
  return value;
}

}  // namespace

std::optional<double> number_of(std::string_view word) {
  const std::optional<double> value = whole<double>(word);
  return value && std::isfinite(*value) ? value : std::nullopt;
}

std::optional<std::int64_t> integer_of(std::string_view word) { return whole<std::int64_t>(word); }

std::string_view Words::next() {
  while (at_ < text_.size() && kBlanks.find(text_[at_]) != std::string_view::npos) {
    if (text_[at_++] == '\n') ++line_;
  }
  const std::size_t begin = at_;
  at_ = std::min(text_.find_first_of(kBlanks, at_), text_.size());
  return text_.substr(begin, at_ - begin);
}

std::string_view Words::rest_of_line() {
  const std::size_t end = std::min(text_.find('\n', at_), text_.size());
  std::string_view rest = text_.substr(at_, end - at_);
  at_ = end;
  rest.remove_prefix(std::min(rest.find_first_not_of(kBlanks), rest.size()));
  return rest.substr(0, rest.find_last_not_of(kBlanks) + 1);
}

double Words::number(const char* what) {
  const std::string_view word = next();
  const std::optional<double> value = number_of(word);
  if (!value) {
    throw Damage{line_, std::string{what} + " is wanted, but " +
                            (word.empty() ? std::string{"the file ends"}
                                          : '\'' + std::string{word.substr(0, 40)} + "' stands there")};
  }
  return *value;
}

void clean(TriangleMesh& mesh, Content& content) {
  const std::size_t before = mesh.triangles.size();
  std::erase_if(mesh.triangles, [](const auto& t) { return t[0] == t[1] || t[1] == t[2] || t[2] == t[0]; });
  if (const std::size_t gone = before - mesh.triangles.size())
    content.not_needed["triangles with two equal corners"].add(gone);
  std::vector<std::uint32_t> place(mesh.vertices.size(), kUnused);
  for (const auto& triangle : mesh.triangles) {
    for (const std::uint32_t index : triangle) place[index] = 0;
  }
  std::uint32_t used = 0;
  for (std::size_t i = 0; i < place.size(); ++i) {
    if (place[i] == kUnused) continue;
    mesh.vertices[used] = mesh.vertices[i];
    place[i] = used++;
  }
  if (const std::size_t gone = mesh.vertices.size() - used)
    content.not_needed["vertices without triangle"].add(gone);
  mesh.vertices.resize(used);
  for (auto& triangle : mesh.triangles) {
    for (std::uint32_t& index : triangle) index = place[index];
  }
}

}  // namespace pantin::geometry_loader

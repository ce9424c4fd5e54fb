// Paths. A segment is the escaped name, then '[k]' where the name is empty or shared with a sibling. '~0',
// '~1' and '~2' stand for '~', '/' and '['; the last only where a name ends in what would read as an index,
// so that a node called "x[1]" (written "x~21]") is never taken for the second "x".
#include <algorithm>
#include <charconv>
#include <optional>

#include <pantin/scenegraph/scene_impl.hpp>

namespace pantin {
namespace {

/// Where a trailing '[' digits ']' begins, or npos.
std::size_t index_suffix(std::string_view text) {
  if (text.size() < 3 || text.back() != ']') return std::string_view::npos;
  const std::size_t open = text.find_last_not_of("0123456789", text.size() - 2);
  if (open == std::string_view::npos || text[open] != '[' || open + 2 == text.size())
    return std::string_view::npos;
  return open;
}

std::string escaped(std::string_view name) {
  const std::size_t open = index_suffix(name);
  std::string out;
  out.reserve(name.size());
  for (std::size_t i = 0; i < name.size(); ++i) {
    if (name[i] == '~') out += "~0";
    else if (name[i] == '/') out += "~1";
    else if (i == open) out += "~2";
    else out += name[i];
  }
  return out;
}

std::optional<std::string> unescaped(std::string_view text) {
  std::string out;
  out.reserve(text.size());
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '~') {
      out += text[i];
      continue;
    }
    if (++i == text.size()) return std::nullopt;
    if (text[i] < '0' || text[i] > '2') return std::nullopt;
    out += std::string_view{"~/["}[static_cast<std::size_t>(text[i] - '0')];
  }
  return out;
}

struct Segment {
  std::string name{};
  std::size_t number{0};  ///< which of the siblings of that name
};

std::optional<Segment> parse(std::string_view text) {
  Segment segment;
  const std::size_t open = index_suffix(text);
  if (open != std::string_view::npos) {
    const char* last = text.data() + text.size() - 1;
    if (std::from_chars(text.data() + open + 1, last, segment.number).ec != std::errc{}) return std::nullopt;
    text = text.substr(0, open);
  }
  std::optional<std::string> name = unescaped(text);
  if (!name) return std::nullopt;
  segment.name = std::move(*name);
  return segment;
}

}  // namespace

std::string Scene::Impl::path(std::uint32_t at) const {
  std::vector<std::uint32_t> chain;
  for (; at != 0; at = nodes.parent(at)) chain.push_back(at);
  std::string out;
  for (auto node = chain.rbegin(); node != chain.rend(); ++node) {
    const std::string& own = name(*node);
    std::size_t same = 0;
    std::size_t number = 0;
    nodes.for_each_child(nodes.parent(*node), [&](std::uint32_t sibling) {
      if (sibling == *node) number = same;
      if (name(sibling) == own) ++same;
      return true;
    });
    if (!out.empty()) out += '/';
    out += escaped(own);
    if (own.empty() || same > 1) out += '[' + std::to_string(number) + ']';
  }
  return out;
}

std::string Scene::Impl::called(std::uint32_t at) const {
  return at == 0 ? "the root" : "node '" + path(at) + "'";
}

std::string Scene::path(NodeId id) const { return impl_->path(impl_->at(id)); }

NodeId Scene::find(std::string_view path) const {
  if (path.empty()) return root();
  std::uint32_t at = 0;
  while (true) {
    const std::size_t slash = path.find('/');
    const std::optional<Segment> segment = parse(path.substr(0, slash));
    if (!segment) return {};
    std::uint32_t found = Impl::kNone;
    std::size_t number = 0;
    impl_->nodes.for_each_child(at, [&](std::uint32_t child) {
      if (impl_->name(child) != segment->name || number++ != segment->number) return true;
      found = child;
      return false;
    });
    if (found == Impl::kNone) return {};
    if (slash == std::string_view::npos) return impl_->id(found);
    at = found;
    path.remove_prefix(slash + 1);
  }
}

}  // namespace pantin

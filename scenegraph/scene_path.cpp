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

/// Adds '/' where something stands before, the escaped name, and the number in brackets if there is one.
void append_segment(std::string& out, std::string_view name, std::optional<std::size_t> number) {
  if (!out.empty()) out += '/';
  const std::size_t open = index_suffix(name);
  for (std::size_t i = 0; i < name.size(); ++i) {
    if (name[i] == '~') out += "~0";
    else if (name[i] == '/') out += "~1";
    else if (i == open) out += "~2";
    else out += name[i];
  }
  if (number) out += '[' + std::to_string(*number) + ']';
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

/// Writes paths of one scene. What the last path has in common with the next is kept, so that a subtree in
/// its order is written in one pass.
class PathWriter {
 public:
  PathWriter(const SceneStorage& nodes, const std::vector<std::string>& names)
      : nodes_{nodes}, names_{names} {}

  const std::string& write(std::uint32_t at) {
    while (!above_.empty() && !nodes_.is_above(above_.back().at, at)) above_.pop_back();
    const std::uint32_t shared = above_.empty() ? 0 : above_.back().at;
    path_.resize(above_.empty() ? 0 : above_.back().length);
    rest_.clear();
    for (; at != shared; at = nodes_.parent(at)) rest_.push_back(at);
    while (!rest_.empty()) {
      const std::uint32_t node = rest_.back();
      rest_.pop_back();
      append_segment(path_, name(node), numbers_.of(node, nodes_, names_));
      above_.push_back({node, path_.size()});
    }
    return path_;
  }

 private:
  struct Written {
    std::uint32_t at{0};
    std::size_t length{0};  ///< of the path up to here
  };

  [[nodiscard]] const std::string& name(std::uint32_t at) const { return names_[nodes_.order()[at].index]; }

  const SceneStorage& nodes_;
  const std::vector<std::string>& names_;
  std::string path_{};
  std::vector<Written> above_{};  ///< the nodes of path_, from the child of the root down
  std::vector<std::uint32_t> rest_{};
  SiblingNumbers numbers_{};
};

}  // namespace

std::string Scene::Impl::path(std::uint32_t at) const {
  std::vector<std::uint32_t> chain;
  for (; at != 0; at = nodes.parent(at)) chain.push_back(at);
  const std::lock_guard lock{numbering};
  if (numbered_shape != shape) numbers.clear();
  numbered_shape = shape;
  std::string out;
  for (auto node = chain.rbegin(); node != chain.rend(); ++node)
    append_segment(out, name(*node), numbers.of(*node, nodes, names));
  return out;
}

std::string Scene::Impl::called(std::uint32_t at) const {
  return at == 0 ? "the root" : "node '" + path(at) + "'";
}

std::string Scene::path(NodeId id) const { return impl_->path(impl_->at(id)); }

std::vector<std::string> Scene::paths(std::span<const NodeId> ids) const {
  std::vector<std::string> paths;
  paths.reserve(ids.size());
  PathWriter writer{impl_->nodes, impl_->names};
  for (const NodeId id : ids) paths.push_back(writer.write(impl_->at(id)));
  return paths;
}

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

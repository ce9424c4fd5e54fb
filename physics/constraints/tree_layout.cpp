// Look-up in a layout.
#include <algorithm>

#include <pantin/physics/constraints/tree.hpp>

namespace pantin {

std::size_t TreeLayout::tree_of(std::int32_t link) const {
  const auto after = std::upper_bound(trees.begin(), trees.end(), static_cast<std::uint32_t>(link),
                                      [](std::uint32_t l, const Tree& t) { return l < t.links_begin; });
  return static_cast<std::size_t>(after - trees.begin()) - 1;
}

std::size_t TreeLayout::tree_of_closure(std::int32_t closure) const {
  const auto after = std::upper_bound(trees.begin(), trees.end(), static_cast<std::uint32_t>(closure),
                                      [](std::uint32_t c, const Tree& t) { return c < t.closures_end; });
  return static_cast<std::size_t>(after - trees.begin());
}

bool TreeLayout::stands_on(const Tree& tree, std::int32_t ground) const {
  for (std::uint32_t i = tree.links_begin; i < tree.links_end; ++i) {
    if (links[i].parent < 0 && links[i].joint >= 0 && links[i].ground == ground) return true;
  }
  for (std::uint32_t c = tree.closures_begin; c < tree.closures_end; ++c) {
    for (const ClosureEnd* end : {&closures[c].a, &closures[c].b}) {
      if (end->link < 0 && end->ground == ground) return true;
    }
  }
  return false;
}

const Pose& TreeLayout::pose_in_link(std::uint32_t body) const {
  const TreeLink& link = links[static_cast<std::size_t>(link_of_body[body])];
  std::uint32_t m = link.members_begin;
  while (members[m].body != body) ++m;
  return members[m].X_LB;
}

}  // namespace pantin

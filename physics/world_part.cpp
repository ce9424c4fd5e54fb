#include <pantin/physics/world_part.hpp>

#include <algorithm>

namespace pantin {
namespace {

/// Copies trees one after the other, with their numbers moved to where they come to stand.
class Extraction {
 public:
  Extraction(const TreeLayout& whole, TreeLayout& part) : whole_{whole}, part_{part} {}

  void add(const Tree& from) {
    Tree tree = from;
    link_shift_ = size(part_.links) - from.links_begin;
    const std::uint32_t q_shift = part_.coordinates - from.q_begin, v_shift = part_.rates - from.v_begin;
    tree.links_begin += link_shift_, tree.links_end += link_shift_;
    tree.q_begin += q_shift, tree.q_end += q_shift;
    tree.v_begin += v_shift, tree.v_end += v_shift;
    for (std::uint32_t l = from.links_begin; l < from.links_end; ++l) {
      TreeLink link = whole_.links[l];
      link.q += q_shift;
      link.v += v_shift;
      add_link(link);
    }
    tree.closures_begin = size(part_.closures);
    for (std::uint32_t c = from.closures_begin; c < from.closures_end; ++c) add_closure(whole_.closures[c]);
    tree.closures_end = size(part_.closures);
    part_.coordinates += from.q_end - from.q_begin;
    part_.rates += from.v_end - from.v_begin;
    part_.trees.push_back(tree);
  }

 private:
  template <class T>
  static std::uint32_t size(const std::vector<T>& list) {
    return static_cast<std::uint32_t>(list.size());
  }
  /// Differences are taken modulo 2^32, and so may be added to.
  void shift(std::int32_t& link) const {
    if (link >= 0) link = static_cast<std::int32_t>(static_cast<std::uint32_t>(link) + link_shift_);
  }

  void add_link(TreeLink link) {
    const auto here = static_cast<std::int32_t>(part_.links.size());
    shift(link.parent);
    const std::uint32_t begin = size(part_.members);
    for (std::uint32_t m = link.members_begin; m < link.members_end; ++m) {
      part_.members.push_back(whole_.members[m]);
      part_.link_of_body[whole_.members[m].body] = here;
    }
    link.members_begin = begin, link.members_end = size(part_.members);
    if (link.joint >= 0) part_.link_of_joint[static_cast<std::size_t>(link.joint)] = here;
    part_.links.push_back(link);
  }

  void add_closure(Closure closure) {
    shift(closure.a.link);
    shift(closure.b.link);
    for (CoupledNumber& number : closure.coupled) shift(number.link);
    const std::uint32_t begin = size(part_.paths);
    for (std::uint32_t p = closure.path_begin; p < closure.path_end; ++p) {
      PathLink step = whole_.paths[p];
      step.link += link_shift_;
      part_.paths.push_back(step);
    }
    closure.path_begin = begin, closure.path_end = size(part_.paths);
    const auto here = static_cast<std::int32_t>(part_.closures.size());
    if (closure.coupling >= 0) part_.closure_of_coupling[static_cast<std::size_t>(closure.coupling)] = here;
    else part_.closure_of_joint[static_cast<std::size_t>(closure.joint)] = here;
    part_.closures.push_back(closure);
  }

  const TreeLayout& whole_;
  TreeLayout& part_;
  std::uint32_t link_shift_{0};
};

}  // namespace

std::unique_ptr<WorldPart> part_of(const TreeLayout& whole, std::span<const std::uint32_t> free_bodies,
                                   std::span<const std::uint32_t> trees) {
  auto part = std::make_unique<WorldPart>();
  part->trees.assign(trees.begin(), trees.end());
  TreeLayout& layout = part->layout;
  layout.free_bodies.assign(free_bodies.begin(), free_bodies.end());
  layout.link_of_body.assign(whole.link_of_body.size(), -1);
  layout.link_of_joint.assign(whole.link_of_joint.size(), -1);
  layout.closure_of_joint.assign(whole.closure_of_joint.size(), -1);
  layout.closure_of_coupling.assign(whole.closure_of_coupling.size(), -1);
  layout.cut_coupling = whole.cut_coupling;
  Extraction extraction{whole, layout};
  for (const std::uint32_t tree : trees) extraction.add(whole.trees[tree]);
  part->kernel.resize(layout);
  part->loops.resize(layout);
  return part;
}

}  // namespace pantin

#include <pantin/physics/lanes/loop_lanes.hpp>

#include <algorithm>

#include <pantin/physics/constraints/closure.hpp>

namespace pantin::lanes {

void LoopSizes::include(const TreeLayout& layout, const RowLayout& at, const Tree& tree) {
  if (!tree.has_closures()) return;
  const std::uint32_t first = at.first_row(tree), last = at.last_row(tree);
  links = std::max<std::size_t>(links, tree.links_end - tree.links_begin);
  rows = std::max<std::size_t>(rows, last - first);
  y = std::max(y, at.places[tree.closures_end].y - at.places[tree.closures_begin].y);
  entries = std::max(entries, at.begins[last] - at.begins[first]);
  for (std::uint32_t c = tree.closures_begin; c < tree.closures_end; ++c) {
    const Closure& closure = layout.closures[c];
    longest_path = std::max<std::size_t>(longest_path, closure.path_end - closure.path_begin);
  }
}

namespace {

ClosureEndConstants constants(const ClosureEnd& end, const BodyStore& bodies, std::int32_t& given) {
  ClosureEndConstants c;
  c.link = end.link;
  if (end.link < 0 && end.ground >= 0 &&
      bodies.kinds[static_cast<std::size_t>(end.ground)] != BodyKind::Simulated) {
    c.ground = given++;
  }
  std::copy_n(end.R_LJ.m, 9, c.R_LJ);
  c.p_LJ[0] = end.p_LJ.x, c.p_LJ[1] = end.p_LJ.y, c.p_LJ[2] = end.p_LJ.z;
  return c;
}

}  // namespace

std::int32_t fill_closures(const TreeLayout& layout, const RowLayout& at, const BodyStore& bodies,
                           std::int32_t given, std::vector<ClosureConstants>& closures) {
  closures.resize(layout.closures.size());
  std::int32_t couplings = 0;
  for (std::size_t i = 0; i < closures.size(); ++i) {
    const Closure& closure = layout.closures[i];
    ClosureConstants& c = closures[i];
    c = {};
    c.kind = closure.kind, c.pitch = closure.pitch;
    c.row = at.places[i].row, c.y = at.places[i].y;
    c.rows = c.rigid_rows = closure.rows;
    c.path_begin = closure.path_begin, c.path_end = closure.path_end, c.path_rates = closure.path_rates;
    c.a = constants(closure.a, bodies, given);
    c.b = constants(closure.b, bodies, given);
    if (closure.coupling >= 0) {
      c.coupling = couplings++;
      continue;
    }
    if (closure.driver != nullptr) c.given = given++;
    c.rotors = rotors_of(closure);
    for (const double armature : c.rotors.armature) c.rigid_rows -= armature > 0 ? 1 : 0;
  }
  return given;
}

}  // namespace pantin::lanes

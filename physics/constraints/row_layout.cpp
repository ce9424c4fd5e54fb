#include <pantin/physics/constraints/row_layout.hpp>

#include <algorithm>

namespace pantin {

Envelope RowLayout::envelope(const Tree& tree) const {
  const std::uint32_t first = first_row(tree);
  return {left.data() + first, begins.data() + first, last_row(tree) - first};
}

RowLayout lay_out_rows(const TreeLayout& layout) {
  RowLayout rows;
  rows.places.assign(1, {});
  rows.begins.assign(1, 0);
  const auto share = [&](const Closure& x, const Closure& y) {
    for (std::uint32_t i = x.path_begin; i < x.path_end; ++i) {
      for (std::uint32_t k = y.path_begin; k < y.path_end; ++k) {
        if (layout.paths[i].link == layout.paths[k].link) return true;
      }
    }
    return false;
  };
  for (const Tree& tree : layout.trees) {
    for (std::uint32_t c = tree.closures_begin; c < tree.closures_end; ++c) {
      const Closure& closure = layout.closures[c];
      std::uint32_t first = tree.closures_begin;
      while (first < c && !share(closure, layout.closures[first])) ++first;
      RowLayout::Place next = rows.places.back();
      for (std::uint32_t i = 0; i < closure.rows; ++i, ++next.row) {
        rows.left.push_back(rows.places[first].row);
        rows.begins.push_back(rows.begins.back() + (next.row - rows.left.back() + 1));
      }
      next.y += std::size_t{closure.rows} * closure.path_rates;
      rows.places.push_back(next);
      rows.longest_path = std::max(rows.longest_path, closure.path_end - closure.path_begin);
    }
  }
  return rows;
}

}  // namespace pantin

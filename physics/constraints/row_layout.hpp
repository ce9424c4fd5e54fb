#pragma once
// Where the rows of closures stand among those of all trees, and which of them share links.
#include <vector>

#include <pantin/physics/constraints/proximal.hpp>
#include <pantin/physics/constraints/tree.hpp>

namespace pantin {

struct RowLayout {
  struct Place {
    std::uint32_t row{0};  ///< first row
    std::size_t y{0};      ///< first number of what its rows leave at the joints (Articulated::reduce)
  };
  std::vector<Place> places{};        ///< by closure, and one behind the last
  std::vector<std::uint32_t> left{};  ///< by row: the first row of its tree that shares a link with it
  std::vector<std::size_t> begins{};  ///< by row, and one behind the last: where W(row, left) stands
  std::uint32_t longest_path{0};

  [[nodiscard]] std::uint32_t rows() const { return places.back().row; }
  [[nodiscard]] std::uint32_t first_row(const Tree& tree) const { return places[tree.closures_begin].row; }
  [[nodiscard]] std::uint32_t last_row(const Tree& tree) const { return places[tree.closures_end].row; }
  [[nodiscard]] Envelope envelope(const Tree& tree) const;
};

[[nodiscard]] RowLayout lay_out_rows(const TreeLayout& layout);

}  // namespace pantin

#pragma once
// Names one node of a Scene. A value: pass it by value, store it anywhere.
#include <compare>
#include <cstdint>
#include <functional>

namespace pantin {

/// Index and generation of a node; null by default. A removed node's id stays invalid for ever, also after
/// its slot was given to another node.
struct NodeId {
  std::uint32_t index{0};
  std::uint32_t generation{0};  ///< 0 = null

  explicit operator bool() const noexcept { return generation != 0; }
  friend auto operator<=>(const NodeId&, const NodeId&) = default;
};

}  // namespace pantin

template <>
struct std::hash<pantin::NodeId> {
  std::size_t operator()(pantin::NodeId id) const noexcept {
    return std::hash<std::uint64_t>{}(std::uint64_t{id.generation} << 32 | id.index);
  }
};

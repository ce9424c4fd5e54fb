#pragma once
// The ledger in full: one entry for every element and attribute of a file, with what became of it. The notes
// of a loader are its summary; this is for whoever wants to see all of it, and for tests that nothing can be
// missed.
#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace pantin {

/// What became of an element or attribute.
enum class Fate {
  Read,       ///< it is in the model as it stands in the file, or decided what is
  Converted,  ///< it is in the model as another value: normalised, say
  Defaulted,  ///< it is not in the file; a value was put in its place
  Dropped,    ///< nothing in the model depends on it
};
inline constexpr std::size_t kFates = 4;

/// "read", "converted", "defaulted", "dropped".
[[nodiscard]] std::string_view to_string(Fate fate) noexcept;

struct AccountEntry {
  Fate fate{Fate::Read};
  std::string place{};    ///< "file:line" or "file#/json/pointer"; of `count` alike ones that of the first
  std::string subject{};  ///< whose it is: "link 'arm'", "node 3 'crate'"
  std::string item{};     ///< "link/inertial/mass@value", "/nodes/3/extras", "statement 'vn'"
  std::string why{};      ///< what was made of it, or why it was dropped; empty for what was read
  std::size_t count{1};   ///< how many alike ones this entry stands for (OBJ, STL, PLY and what assimp reads)
};

/// In the order of the file; defaulted ones where they would stand. Empty for a file that was refused.
using Account = std::vector<AccountEntry>;

/// How many elements and attributes met each fate, by position of the enumerator.
[[nodiscard]] std::array<std::size_t, kFates> count_fates(const Account& account) noexcept;

/// "link 'arm': link/inertial/mass@value: dropped: why" on one line, with the place before it; control
/// characters of the input are escaped.
[[nodiscard]] std::string to_string(const AccountEntry& entry);

}  // namespace pantin

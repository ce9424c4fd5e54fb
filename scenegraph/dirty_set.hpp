#pragma once
// Private to scenegraph. Which positions of the dense arrays have a changed local matrix: a bit a position,
// and above it a summary bit for each 64 of them, so that the next dirty position is found without touching
// clean words.
#include <cstddef>
#include <cstdint>
#include <vector>

namespace pantin {

class DirtySet {
 public:
  static constexpr std::uint32_t kNone = 0xffff'ffff;

  /// Makes room for positions below `count`; new ones are clean.
  void grow(std::size_t count);
  /// Marks a position; true if it was clean.
  bool mark(std::uint32_t position) noexcept;
  /// Cleans [begin, end).
  void clean(std::uint32_t begin, std::uint32_t end) noexcept;
  [[nodiscard]] bool test(std::uint32_t position) const noexcept {
    return (words_[position >> 6] >> (position & 63) & 1) != 0;
  }
  /// The first dirty position >= `from`, or kNone.
  [[nodiscard]] std::uint32_t next(std::uint32_t from) const noexcept;

  /// No dirty position is below this one. Exact after `mark`, a lower bound after `clean`.
  [[nodiscard]] std::uint32_t lowest() const noexcept { return lowest_; }
  /// To be called when everything was cleaned.
  void forget_lowest() noexcept { lowest_ = kNone; }

 private:
  std::vector<std::uint64_t> words_{};    ///< bit i % 64 of word i / 64: position i
  std::vector<std::uint64_t> summary_{};  ///< bit w % 64 of word w / 64: words_[w] is not zero
  std::uint32_t lowest_{kNone};
};

}  // namespace pantin

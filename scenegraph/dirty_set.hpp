#pragma once
// Private to scenegraph. Which positions of the dense arrays have a changed local matrix: a bit a position,
// and above it a summary bit for each 64 of them, so that the next dirty position is found without touching
// clean words.
#include <algorithm>
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
  bool mark(std::uint32_t position) noexcept {
    const std::size_t word = position >> 6;
    const std::uint64_t bit = std::uint64_t{1} << (position & 63);
    if ((words_[word] & bit) != 0) return false;
    words_[word] |= bit;
    summary_[word >> 6] |= std::uint64_t{1} << (word & 63);
    lowest_ = std::min(lowest_, position);
    return true;
  }
  /// Cleans [begin, end).
  void clean(std::uint32_t begin, std::uint32_t end) noexcept;
  [[nodiscard]] bool test(std::uint32_t position) const noexcept {
    return (words_[position >> 6] >> (position & 63) & 1) != 0;
  }
  /// The first dirty position >= `from`, or kNone.
  [[nodiscard]] std::uint32_t next(std::uint32_t from) const noexcept;

  [[nodiscard]] std::size_t bytes() const noexcept {
    return (words_.capacity() + summary_.capacity()) * sizeof(std::uint64_t);
  }

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

#include <bit>

#include <pantin/scenegraph/dirty_set.hpp>

namespace pantin {
namespace {

constexpr std::uint64_t kAll = ~std::uint64_t{0};

/// Bits `bit` .. 63 of a word.
std::uint64_t from_bit(std::size_t bit) { return kAll << bit; }

}  // namespace

void DirtySet::grow(std::size_t count) {
  const std::size_t words = (count + 63) / 64;
  if (words <= words_.size()) return;
  words_.resize(words);
  summary_.resize((words + 63) / 64);
}

void DirtySet::clean(std::uint32_t begin, std::uint32_t end) noexcept {
  if (begin >= end) return;
  const std::size_t first = begin >> 6;
  const std::size_t last = (end - 1) >> 6;
  for (std::size_t word = first; word <= last; ++word) {
    std::uint64_t cleaned = kAll;
    if (word == first) cleaned &= from_bit(begin & 63);
    if (word == last) cleaned &= kAll >> (63 - ((end - 1) & 63));
    words_[word] &= ~cleaned;
    if (words_[word] == 0) summary_[word >> 6] &= ~(std::uint64_t{1} << (word & 63));
  }
}

std::uint32_t DirtySet::next(std::uint32_t from) const noexcept {
  std::size_t word = from >> 6;
  if (word >= words_.size()) return kNone;
  std::uint64_t bits = words_[word] & from_bit(from & 63);
  if (bits == 0) {
    ++word;
    std::size_t block = word >> 6;
    if (block >= summary_.size()) return kNone;
    std::uint64_t blocks = summary_[block] & from_bit(word & 63);
    while (blocks == 0) {
      if (++block == summary_.size()) return kNone;
      blocks = summary_[block];
    }
    word = block * 64 + static_cast<std::size_t>(std::countr_zero(blocks));
    bits = words_[word];
  }
  return static_cast<std::uint32_t>(word * 64 + static_cast<std::size_t>(std::countr_zero(bits)));
}

}  // namespace pantin

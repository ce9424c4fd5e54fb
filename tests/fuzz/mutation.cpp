#include "mutation.hpp"

#include <algorithm>
#include <array>

namespace pantin::test {
namespace {

/// What stands in place of a word: numbers at the ends of types, what is no number, and parts of syntax.
constexpr std::array<std::string_view, 28> kWords{
    "-1",    "0",         "1",      "4294967295", "2147483648", "18446744073709551615",
    "1e999", "-1e308",    "1e-320", "nan",        "inf",        "1,5",
    "0x10",  "999999999", "\"\"",   "null",       "[]",         "{}",
    "<",     "/>",        "&#0;",   "<!--",       "\xff\xfe",   "../..",
    "%",     "vertex",    "-0",     "a b"};

class Damage {
 public:
  Damage(std::string_view bytes, std::mt19937_64& random) : bytes_{bytes}, random_{random} {}

  void apply() {
    if (bytes_.empty()) return;
    const std::size_t kind = below(10);
    if (kind == 0) cut();
    else if (kind <= 2) turn_bits();
    else if (kind <= 7) swap_word();
    else if (kind == 8) copy_block();
    else remove_block();
  }
  [[nodiscard]] std::string take() { return std::move(bytes_); }

 private:
  std::size_t below(std::size_t n) { return static_cast<std::size_t>(random_() % n); }

  void cut() { bytes_.resize(below(bytes_.size())); }
  void turn_bits() {
    for (std::size_t k = 1 + below(4); k > 0; --k) {
      char& byte = bytes_[below(bytes_.size())];
      const unsigned bit = 1U << below(8);
      byte = static_cast<char>(static_cast<unsigned char>(byte) ^ bit);
    }
  }
  /// The word (letters, digits and what numbers hold) that begins at or after a random place; sometimes it
  /// gives way to another word of the file.
  void swap_word() {
    const auto in_word = [](char c) {
      return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '-' ||
             c == '.' || c == '_' || c == '+';
    };
    const auto word_at = [&](std::size_t from) {
      const auto begin =
          std::find_if(bytes_.begin() + static_cast<std::ptrdiff_t>(from), bytes_.end(), in_word);
      return std::pair{begin, std::find_if_not(begin, bytes_.end(), in_word)};
    };
    const auto [begin, end] = word_at(below(bytes_.size()));
    std::string other{kWords[below(kWords.size())]};
    if (below(3) == 0) {
      const auto [first, last] = word_at(below(bytes_.size()));
      other.assign(first, last);
    }
    bytes_.replace(begin, end, other);
  }
  void copy_block() {
    const std::size_t from = below(bytes_.size());
    const std::string block = bytes_.substr(from, 1 + below(std::min<std::size_t>(bytes_.size(), 400)));
    const std::size_t to = below(bytes_.size());
    const std::size_t over = below(2) == 0 ? 0 : block.size();
    bytes_.replace(to, over, block);
  }
  // Each number is drawn in a statement of its own: compilers differ in the order of arguments.
  void remove_block() {
    const std::size_t from = below(bytes_.size());
    bytes_.erase(from, 1 + below(std::min<std::size_t>(bytes_.size(), 200)));
  }

  std::string bytes_;
  std::mt19937_64& random_;
};

}  // namespace

std::string mutated(std::string_view bytes, std::mt19937_64& random) {
  Damage damage{bytes, random};
  const std::uint64_t dice = random() % 6;
  for (std::uint64_t hits = dice < 3 ? 1 : dice < 5 ? 2 : 3; hits > 0; --hits) damage.apply();
  return damage.take();
}

}  // namespace pantin::test

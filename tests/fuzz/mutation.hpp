#pragma once
// Seeded damage to the bytes of a file.
#include <random>
#include <string>
#include <string_view>

namespace pantin::test {

/// `bytes` with one to three damages: cut off at the end, bits turned, a word or number replaced by one that
/// readers stumble over, a block of the file copied over or into another place, a block removed. Equal
/// generators give equal results.
[[nodiscard]] std::string mutated(std::string_view bytes, std::mt19937_64& random);

}  // namespace pantin::test

#pragma once
// What the scene graph benchmark measures on: a crowd of characters of 60 nodes each under one root, as plain
// arrays, parents before children. Each contender builds its own scene from them.
#include <array>
#include <cstdint>
#include <random>
#include <string_view>
#include <vector>

#include <support/random_affine.hpp>

namespace pantin::bench {

struct Crowd {
  std::vector<std::uint32_t> parents{};  ///< of each node; the root is 0 and its own parent
  std::vector<Matrix34> locals{};
};

constexpr std::uint32_t kCharacterNodes = 60;

/// Parents within a character: pelvis, two legs of five, a spine of six that carries a head with three parts
/// and two arms of four, each with a hand of five fingers of three joints, and one thing held in the left.
inline std::array<std::uint32_t, kCharacterNodes> character_parents() {
  std::array<std::uint32_t, kCharacterNodes> parents{};
  std::uint32_t count = 1;
  const auto chain = [&](std::uint32_t from, int links) {
    for (; links > 0; --links) parents[count] = from, from = count++;
    return from;
  };
  chain(0, 5);
  chain(0, 5);
  const std::uint32_t chest = chain(0, 6);
  const std::uint32_t head = chain(chest, 1);
  for (int part = 0; part < 3; ++part) chain(head, 1);
  for (int arm = 0; arm < 2; ++arm) {
    const std::uint32_t wrist = chain(chest, 4);
    for (int finger = 0; finger < 5; ++finger) chain(wrist, 3);
  }
  chain(count - 1, 1);
  return parents;
}

/// A rigid motion, so that worlds keep their size however deep.
inline Matrix34 random_pose(std::mt19937_64& random) {
  Affine M = Affine::Identity();
  M.linear() = test::random_rotation(random).toRotationMatrix();
  M.translation() = test::random_vector(random);
  return Matrix34::from(M);
}

inline Crowd make_crowd(std::uint32_t characters) {
  static_assert(kCharacterNodes == 60);
  const std::array<std::uint32_t, kCharacterNodes> inside = character_parents();
  std::mt19937_64 random{1};
  Crowd crowd{{0}, {Matrix34{}}};
  for (std::uint32_t c = 0; c < characters; ++c) {
    const auto first = static_cast<std::uint32_t>(crowd.parents.size());
    for (std::uint32_t k = 0; k < kCharacterNodes; ++k) {
      crowd.parents.push_back(k == 0 ? 0 : first + inside[k]);
      crowd.locals.push_back(random_pose(random));
    }
  }
  return crowd;
}

}  // namespace pantin::bench

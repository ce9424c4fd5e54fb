#pragma once
// Which instructions of the processor the inner loops of the scene graph use. The choice changes speed alone:
// every set does the same operations in the same order and nothing is contracted to fused multiply-add, so
// results agree to the last bit (tests/scenegraph/sweep_test.cpp).
#include <string_view>

namespace pantin {

enum class InstructionSet {
  Best,      ///< the widest that this processor runs, found out once
  Baseline,  ///< what the build is for: SSE2 on x86-64, plain C++ elsewhere
  Avx2,      ///< AVX2, without fused multiply-add
};

/// Whether this build has the set and this processor runs it. Always true for Best and Baseline.
[[nodiscard]] bool runs_here(InstructionSet set) noexcept;

[[nodiscard]] std::string_view to_string(InstructionSet set) noexcept;

}  // namespace pantin

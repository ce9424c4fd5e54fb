// libFuzzer: the reading of reference problems.
#include <pantin/bridge/problems/rigid_ref.hpp>

#include <cstdlib>

#include "use_model.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text{reinterpret_cast<const char*>(data), size};
  pantin::Account account;
  const auto loaded = pantin::parse_rigid_ref(text, "input", &account);
  if (!pantin::test::problem_with_ledger(loaded.value.has_value(), loaded.notes, "input").empty())
    std::abort();
  if (!loaded.value) return 0;
  pantin::PhysicsManager physics;
  (void)pantin::instantiate(*loaded.value, physics);
  return 0;
}

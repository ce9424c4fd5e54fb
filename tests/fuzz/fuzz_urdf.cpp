// libFuzzer: the pre-flight and reading of robots.
#include <pantin/bridge/loaders/load_urdf.hpp>

#include "memory_file.hpp"
#include "use_model.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const pantin::test::MemoryFile file{data, size};
  pantin::Account account;
  const auto loaded = pantin::load_urdf(file.path(), {.account = &account});
  if (!pantin::test::problem_with_ledger(loaded.value.has_value(), loaded.notes, file.path()).empty())
    std::abort();
  if (loaded.value && !pantin::test::use(*loaded.value).empty()) std::abort();
  return 0;
}

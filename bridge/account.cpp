#include <pantin/bridge/account.hpp>

#include <pantin/bridge/diagnostic.hpp>

namespace pantin {

std::string_view to_string(Fate fate) noexcept {
  constexpr std::array<std::string_view, kFates> kNames{"read", "converted", "defaulted", "dropped"};
  return kNames[static_cast<std::size_t>(fate)];
}

std::array<std::size_t, kFates> count_fates(const Account& account) noexcept {
  std::array<std::size_t, kFates> counts{};
  for (const AccountEntry& entry : account) counts[static_cast<std::size_t>(entry.fate)] += entry.count;
  return counts;
}

std::string to_string(const AccountEntry& entry) {
  std::string text = entry.place + ": " + std::string{to_string(entry.fate)} + ": " + entry.subject;
  if (!entry.item.empty()) text += ": " + entry.item;
  if (entry.count > 1) text += " (" + std::to_string(entry.count) + " times)";
  if (!entry.why.empty()) text += ": " + entry.why;
  return printable(text);
}

}  // namespace pantin

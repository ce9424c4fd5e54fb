#pragma once
// Aligned columns of text for a terminal, and numbers short enough to stand in them.
#include <ostream>
#include <string>
#include <vector>

namespace pantin::cli {

/// Six significant digits, whatever the locale.
[[nodiscard]] std::string short_number(double number);
/// "0.25 s", or "1/240 s" where the number is one over a whole number that decimals say badly.
[[nodiscard]] std::string short_seconds(double seconds);
/// "1 body", "2 bodies": `plural` is the whole word.
[[nodiscard]] std::string counted(std::size_t count, const char* singular, const char* plural);

/// Rows of cells; all columns but the last are padded to the widest cell, up to 80 characters. Control
/// characters are escaped.
class TextTable {
 public:
  void add(std::vector<std::string> cells) { rows_.push_back(std::move(cells)); }
  void print(std::ostream& out, const std::string& indent = "") const;

 private:
  std::vector<std::vector<std::string>> rows_{};
};

}  // namespace pantin::cli

#include <pantin/bridge/cli/progress_bar.hpp>

#include <unistd.h>
#include <algorithm>
#include <iostream>
#include <string>

#include <pantin/bridge/cli/text_table.hpp>

namespace pantin::cli {

ProgressBar::ProgressBar(double end) : end_{end}, is_on_terminal_{isatty(STDERR_FILENO) == 1} {}

ProgressBar::~ProgressBar() { wipe(); }

void ProgressBar::show(double value) {
  if (!is_on_terminal_) return;
  const int percent = static_cast<int>(100 * std::clamp(value / end_, 0.0, 1.0));
  if (percent == shown_) return;
  shown_ = percent;
  const auto filled = static_cast<std::size_t>(percent * 2 / 5);
  std::cerr << "\r\033[K[" << std::string(filled, '=') << std::string(40 - filled, ' ') << "] " << percent
            << " %  " << short_number(value) << " of " << short_number(end_) << " s" << std::flush;
}

void ProgressBar::wipe() {
  if (shown_ >= 0) std::cerr << "\r\033[K" << std::flush;
  shown_ = -1;
}

}  // namespace pantin::cli

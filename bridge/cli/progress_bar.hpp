#pragma once
// A bar on standard error while something takes its time; nothing at all where that is no terminal.

namespace pantin::cli {

class ProgressBar {
 public:
  /// `end`: the value at which it is full [s of simulated time], > 0.
  explicit ProgressBar(double end);
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;
  ~ProgressBar();  ///< wipes the bar off the line

  void show(double value);
  void wipe();  ///< until the next show, so that a line can be printed

 private:
  double end_;
  bool is_on_terminal_;
  int shown_{-1};  ///< percent on screen; -1 = nothing
};

}  // namespace pantin::cli

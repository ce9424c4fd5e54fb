#pragma once
// Error against time of several contenders on one problem, and from that the time each needs for an error.
#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "contender.hpp"

namespace pantin::bench {

/// One contender at one setting.
struct Row {
  int number{0};  ///< of the setting
  double error{std::numeric_limits<double>::infinity()};
  double seconds{std::numeric_limits<double>::infinity()};  ///< processor time, least of several runs
  double spent{0};                                          ///< in all its timed runs [s]
  long evaluations{0};
};

struct Entry {
  std::unique_ptr<Contender> contender{};
  std::vector<Row> rows{};  ///< from coarse to fine
};

using ErrorOf = std::function<double(const std::vector<Point>&)>;

/// Runs each contender from coarse to fine until its error is at most `least`, or a run takes too long.
void scout(std::vector<Entry>& entries, const ErrorOf& error_of, double least);

/// Lets all rows of all contenders take turns, again and again; the least time of each counts.
void race(std::vector<Entry>& entries);

enum class Known {
  Between,       ///< from the two rows on either side
  Coarsest,      ///< the coarsest row is already better: an upper bound
  Extrapolated,  ///< the finest row is worse: continued at the order of the method
  No,            ///< the same, where there is nothing to continue
};

struct Crossing {
  double seconds{std::numeric_limits<double>::infinity()};
  Known known{Known::No};
};

/// The time at which a contender reaches an error: the straight line in logarithms of both through the first
/// row that is at least as good and the one before it, or a finer row that took less.
[[nodiscard]] Crossing time_at(const Entry& entry, double error);

}  // namespace pantin::bench

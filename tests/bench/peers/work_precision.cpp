#include "work_precision.hpp"

#include <algorithm>
#include <cmath>

#include "bench/cpu_time.hpp"

namespace pantin::bench {
namespace {

constexpr int kMostSettings = 20;
/// Nobody goes on to finer settings from a run that took this long [s].
constexpr double kLongRun = 2.5;
/// Rows with a greater error say nothing of the method [m or rad].
constexpr double kUseful = 1;
constexpr int kMostRounds = 25, kLeastRounds = 3;
/// A row that has taken this long in all sits out, after the least number of rounds [s].
constexpr double kEnough = 0.3;
/// Runs shorter than this are made once untimed, to bring their data back into the caches [s].
constexpr double kShortRun = 0.02;

/// False if the run failed.
bool run(Contender& contender, Row& row) {
  contender.prepare(row.number);
  const double start = cpu_seconds();
  const bool ok = contender.run();
  const double seconds = cpu_seconds() - start;
  row.seconds = std::min(row.seconds, seconds);
  row.spent += seconds;
  row.evaluations = contender.evaluations();
  return ok;
}

}  // namespace

void scout(std::vector<Entry>& entries, const ErrorOf& error_of, double least) {
  for (Entry& entry : entries) {
    for (int k = 0; k < kMostSettings; ++k) {
      Row row{.number = k};
      if (run(*entry.contender, row)) row.error = error_of(entry.contender->points());
      if (row.error <= kUseful) entry.rows.push_back(row);
      if (row.error <= least || row.seconds > kLongRun) break;
    }
  }
}

void race(std::vector<Entry>& entries) {
  for (int round = 0; round < kMostRounds; ++round) {
    for (Entry& entry : entries) {
      for (Row& row : entry.rows) {
        if (round >= kLeastRounds && row.spent > kEnough) continue;
        if (row.seconds < kShortRun) {
          Row untimed{.number = row.number};
          (void)run(*entry.contender, untimed);
        }
        (void)run(*entry.contender, row);
      }
    }
  }
}

Crossing time_at(const Entry& entry, double error) {
  const std::vector<Row>& rows = entry.rows;
  const auto good = [&](const Row& row) { return row.error <= error; };
  const auto first = std::find_if(rows.begin(), rows.end(), good);
  if (first == rows.end()) {
    if (rows.empty()) return {};
    const Row& last = rows.back();
    const int order = entry.contender->order();
    return {last.seconds * std::pow(last.error / error, 1.0 / order), Known::Extrapolated};
  }
  Crossing crossing{first->seconds, first == rows.begin() ? Known::Coarsest : Known::Between};
  if (first != rows.begin()) {
    const Row& before = *(first - 1);
    const double part = std::log(before.error / error) / std::log(before.error / first->error);
    crossing.seconds = before.seconds * std::pow(first->seconds / before.seconds, part);
  }
  for (auto row = first; row != rows.end(); ++row) {
    if (good(*row) && row->seconds < crossing.seconds) crossing.seconds = row->seconds;
  }
  return crossing;
}

}  // namespace pantin::bench

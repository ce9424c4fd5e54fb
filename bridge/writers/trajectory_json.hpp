#pragma once
// A trajectory as JSON: {"samples": [{"t", "bodies", "joints", "energy"}, ...], "summary", "ledger"}, a
// sample a line.
#include <ostream>

#include <pantin/bridge/writers/json_stream.hpp>
#include <pantin/bridge/writers/trajectory.hpp>

namespace pantin {

/// Writes to a stream as samples come; the document is whole once `finish` was called.
class TrajectoryJson final : public TrajectoryWriter {
 public:
  explicit TrajectoryJson(std::ostream& out);
  void write(const Sample& sample) override;
  void finish(const RunSummary& summary, const std::vector<Diagnostic>& ledger) override;

 private:
  JsonStream json_;
};

}  // namespace pantin

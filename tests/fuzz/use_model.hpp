#pragma once
// What a careful user may do with whatever a loader returned.
#include <string>

#include <pantin/bridge/diagnostic.hpp>
#include <pantin/bridge/model.hpp>

namespace pantin::test {

/// Why a ledger is not as promised (a value beside an error, neither, an error without place or problem, a
/// place that does not begin with `file`); empty if it is.
[[nodiscard]] std::string problem_with_ledger(bool has_value, const std::vector<Diagnostic>& notes,
                                              const std::string& file);

/// Puts the model into a scene, plays its clips half through and hands it to physics; refusals by notes are
/// fine, a broken contract ends the process. Empty, or what of the model is unusable.
[[nodiscard]] std::string use(const Model& model);

}  // namespace pantin::test

#pragma once
// A model as JSON: what `pantin info --json` prints.
#include <ostream>
#include <span>

#include <pantin/bridge/diagnostic.hpp>
#include <pantin/bridge/model.hpp>
#include <pantin/scenegraph/scene.hpp>

namespace pantin {

/// A model with the scene nodes that stand for its nodes. Matrices and link values are the scene's, so the
/// scene may have been moved to another configuration; everything else is the model's.
struct ModelInScene {
  const Model& model;
  const Scene& scene;
  std::span<const NodeId> nodes;  ///< by position in Model::nodes; all alive
};

/// One object: model, format, up_axis, unit_m, total_mass, nodes, clips, ledger. Lengths in metres, masses in
/// kg, angles in rad, matrices by rows. What the file does not say is null.
void write_model_json(std::ostream& out, const ModelInScene& view, std::span<const Diagnostic> ledger);

/// The sum of all masses that the file gives [kg]; nothing where it gives none.
[[nodiscard]] std::optional<double> total_mass(const Model& model);

}  // namespace pantin

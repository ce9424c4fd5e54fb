#pragma once
// Makes a Model of what urdfdom read.
#include <optional>

#include <pantin/bridge/loaders/urdf_ledger.hpp>
#include <pantin/bridge/loaders/urdf_meshes.hpp>
#include <pantin/bridge/loaders/urdf_survey.hpp>
#include <pantin/bridge/model.hpp>

namespace urdf {
class ModelInterface;
}

namespace pantin::urdf_loader {

/// One node a link, parents first, as laid out in `survey.tree`. Nothing, with an error, where urdfdom's
/// model is not the one surveyed.
[[nodiscard]] std::optional<Model> build_model(const urdf::ModelInterface& robot, const Survey& survey,
                                               Meshes& meshes, Ledger& ledger);

}  // namespace pantin::urdf_loader

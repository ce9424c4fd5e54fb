#include <pantin/bridge/loaders/load_urdf.hpp>

#include <tinyxml2.h>

#include <exception>
#include <utility>

#include <pantin/bridge/input_file.hpp>
#include <pantin/bridge/loaders/urdf_build.hpp>
#include <pantin/bridge/loaders/urdf_document.hpp>
#include <pantin/bridge/loaders/urdf_inventory.hpp>
#include <pantin/bridge/loaders/urdf_ledger.hpp>
#include <pantin/bridge/loaders/urdf_meshes.hpp>
#include <pantin/bridge/loaders/urdf_parse.hpp>
#include <pantin/bridge/loaders/urdf_survey.hpp>

namespace pantin {
namespace {

constexpr std::uintmax_t kMaxBytes = 256u << 20;  ///< of the XML; the largest robots have 1 MB

/// The steps from text to model; each stops the next where it finds an error.
std::optional<Model> read_robot(const std::filesystem::path& file, const std::string& text,
                                const LoadOptions& options, urdf_loader::Ledger& ledger) {
  using namespace urdf_loader;
  const auto document = parse_xml(text, ledger);
  if (document == nullptr) return std::nullopt;
  const Inventory inventory{*document};
  tinyxml2::XMLElement* robot = find_robot(*document, ledger);
  if (robot == nullptr) return std::nullopt;
  remove_unknown(*robot, ledger);
  const Survey found = survey(*robot, ledger);
  if (ledger.has_error()) return std::nullopt;
  const auto parsed = parse_urdf(print_xml(*robot), ledger);
  if (parsed == nullptr) return std::nullopt;
  Meshes meshes{file, options, ledger};
  std::optional<Model> model = build_model(*parsed, found, meshes, ledger);
  if (model) inventory.settle(*document, ledger, options.account);
  return model;
}

}  // namespace

Loaded<Model> load_urdf(const std::filesystem::path& file, const LoadOptions& options) {
  Loaded<Model> loaded;
  urdf_loader::Ledger ledger{file.string()};
  try {
    Loaded<std::string> text = read_file(file, kMaxBytes);
    if (!text.value) return {{}, std::move(text.notes)};
    loaded.value = read_robot(file, *text.value, options, ledger);
  } catch (const std::exception& e) {  // memory, a path that cannot be written as text
    loaded.value.reset();
    ledger.error({0, "file", std::string{"cannot be read: "} + e.what(), ""});
  }
  loaded.notes = ledger.take();
  return loaded;
}

}  // namespace pantin

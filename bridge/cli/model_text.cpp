#include <pantin/bridge/cli/model_text.hpp>

#include <algorithm>
#include <cmath>

#include <pantin/bridge/cli/ledger_text.hpp>
#include <pantin/bridge/cli/text_table.hpp>

namespace pantin::cli {
namespace {

std::string joined(std::span<const double> numbers) {
  std::string out;
  for (const double number : numbers) out += (out.empty() ? "" : " ") + short_number(number);
  return out;
}

std::string range_of(const Link& link) {
  std::string text;
  for (std::size_t i = 0; i < static_cast<std::size_t>(limit_count(link.kind)); ++i) {
    const LinkLimits& limits = link.limits[i];
    text += i == 0 ? "" : ", ";
    if (limits == LinkLimits{}) text += "unlimited";
    else text += short_number(limits.lower) + " .. " + short_number(limits.upper);
  }
  return text;
}

std::string link_of(const ModelNode& node) {
  if (!node.link) return "-";
  std::string text{to_string(node.link->kind)};
  if (!node.link->name.empty()) text += " '" + node.link->name + "'";
  if (node.link->mimic) text += " follows '" + node.link->mimic->source + "'";
  return text;
}

std::string geometry_of(const ModelNode& node) {
  std::string text;
  if (!node.shapes.empty()) text = counted(node.shapes.size(), "shape", "shapes");
  if (!node.meshes.empty())
    text += (text.empty() ? "" : ", ") + counted(node.meshes.size(), "mesh", "meshes");
  return text;
}

void print_nodes(std::ostream& out, const ModelInScene& view) {
  TextTable table;
  table.add({"path", "link", "range", "value", "mass [kg]", "position [m]", "geometry"});
  const std::vector<std::string> paths = view.scene.paths(view.nodes);
  for (std::size_t i = 0; i < view.model.nodes.size(); ++i) {
    const ModelNode& node = view.model.nodes[i];
    const NodeId id = view.nodes[i];
    const Link* link = node.link ? view.scene.link(id) : nullptr;
    const Vector3 position = view.scene.world(id).translation();
    table.add({paths[i], link_of(node), node.link ? range_of(*node.link) : "",
               link != nullptr ? joined(link->value.numbers()) : "",
               node.mass ? short_number(node.mass->mass) : "-",
               joined(std::span<const double>{position.data(), 3}), geometry_of(node)});
  }
  table.print(out);
}

}  // namespace

std::string outline(const Model& model) {
  const auto links = static_cast<std::size_t>(std::count_if(
      model.nodes.begin(), model.nodes.end(), [](const ModelNode& node) { return node.link.has_value(); }));
  std::string text = model.format + ", " + counted(model.nodes.size(), "node", "nodes");
  if (links > 0) text += ", " + counted(links, "link", "links");
  if (!model.clips.empty()) text += ", " + counted(model.clips.size(), "clip", "clips");
  if (const std::optional<double> mass = total_mass(model)) text += ", " + short_number(*mass) + " kg";
  return text;
}

void print_model(std::ostream& out, const std::string& file, const ModelInScene& view,
                 const std::vector<Diagnostic>& ledger) {
  const Model& model = view.model;
  TextTable head;
  head.add({"file", file});
  head.add({"model", model.name});
  head.add({"holds", outline(model)});
  head.add({"up", std::string{to_string(model.up_axis)} + ", 1 unit = " + short_number(model.unit_m) + " m"});
  head.print(out);
  out << '\n';
  print_nodes(out, view);
  if (!model.clips.empty()) {
    out << '\n';
    TextTable clips;
    clips.add({"clip", "duration", "channels"});
    for (const Clip& clip : model.clips)
      clips.add({clip.name, short_number(clip.duration) + " s", std::to_string(clip.tracks.size())});
    clips.print(out);
  }
  if (!ledger.empty()) {
    out << "\nledger\n";
    print_remarks(out, ledger);
  }
}

}  // namespace pantin::cli

#include <pantin/bridge/problems/rigid_ref.hpp>

#include <pantin/bridge/input_file.hpp>

#include "object_reader.hpp"
#include "problem_account.hpp"
#include "rigid_ref_parts.hpp"

namespace pantin {
namespace reference {
namespace {

constexpr const char* kSchema = "rigid-ref/1";
/// The largest file that is read; problems of a hundred bodies need one megabyte.
constexpr std::uintmax_t kMaxBytes = std::uintmax_t{64} << 20;

/// Reads every element of a list with `read_one`.
template <class T, class ReadOne>
std::vector<T> read_list(const std::vector<JsonValue>& list, const std::string& place,
                         std::vector<Diagnostic>& ledger, const ReadOne& read_one) {
  std::vector<T> out;
  for (std::size_t i = 0; i < list.size(); ++i) {
    out.push_back(read_one(list[i], PartContext{place + '/' + std::to_string(i), ledger}));
  }
  return out;
}

void check_schema(ObjectReader& reader) {
  const std::string schema = reader.text("schema");
  if (reader.has("schema") && schema != kSchema) {
    reader.error("schema", "is '" + schema + "'", std::string{"this reader reads "} + kSchema);
  }
}

Problem read_problem(const JsonValue& root, const std::string& file, std::vector<Diagnostic>& ledger) {
  ObjectReader reader{root, file + '#', "problem", ledger};
  check_schema(reader);
  Problem problem{.file = file};
  problem.name = reader.text("name");
  problem.title = reader.text_if("title").value_or("");
  problem.gravity = reader.vector3("gravity");
  problem.bodies = read_list<Body>(reader.list("bodies"), reader.place("bodies"), ledger, read_body);
  problem.particles =
      read_list<Particle>(reader.list_if("particles"), reader.place("particles"), ledger, read_particle);
  problem.kinematic_bodies = read_list<KinematicBody>(
      reader.list_if("kinematic_bodies"), reader.place("kinematic_bodies"), ledger, read_kinematic_body);
  problem.joints = read_list<Joint>(reader.list_if("joints"), reader.place("joints"), ledger, read_joint);
  problem.forces = read_list<Force>(reader.list_if("forces"), reader.place("forces"), ledger, read_force);
  problem.contacts =
      read_list<Contact>(reader.list_if("contacts"), reader.place("contacts"), ledger, read_contact);
  problem.duration = reader.number("duration");
  problem.samples = read_list<Sample>(reader.list("samples"), reader.place("samples"), ledger, read_sample);
  if (const JsonValue* accuracy = reader.object_if("accuracy")) {
    problem.accuracy = read_accuracy(*accuracy, {reader.place("accuracy"), ledger});
  }
  problem.error_metric = reader.text_if("error_metric").value_or("");
  reader.skip({"description", "category", "units", "parameters", "reference_method", "cross_checks", "source",
               "notes", "verification_maximal_coordinates", "events", "samples_refined", "suggested_run"});
  return problem;
}

}  // namespace
}  // namespace reference

Loaded<ReferenceProblem> parse_rigid_ref(std::string_view text, std::string file, Account* account) {
  Loaded<reference::JsonValue> document = reference::parse_json(text, file);
  if (!document.value) return {{}, std::move(document.notes)};
  std::vector<Diagnostic> ledger = std::move(document.notes);
  ReferenceProblem problem = reference::read_problem(*document.value, file, ledger);
  // What a part means can be judged only when all parts could be read.
  if (!has_error(ledger)) {
    for (Diagnostic& finding : findings_in(problem)) ledger.push_back(std::move(finding));
  }
  if (has_error(ledger)) return {{}, std::move(ledger)};
  reference::settle(*document.value, problem.file, ledger, account);
  return {std::move(problem), std::move(ledger)};
}

Loaded<ReferenceProblem> load_rigid_ref(const std::filesystem::path& file, Account* account) {
  Loaded<std::string> text = read_file(file, reference::kMaxBytes);
  if (!text.value) return {{}, std::move(text.notes)};
  return parse_rigid_ref(*text.value, file.string(), account);
}

}  // namespace pantin

#include <pantin/bridge/writers/ledger_json.hpp>

namespace pantin {

void write_ledger(JsonStream& json, std::span<const Diagnostic> ledger) {
  json.begin_array(JsonLayout::Lines);
  for (const Diagnostic& note : ledger) {
    json.begin_object();
    json.member("severity", to_string(note.severity));
    json.member("place", note.place);
    json.member("subject", note.subject);
    json.member("problem", note.problem);
    json.member("remedy", note.remedy);
    json.end_object();
  }
  json.end_array();
}

void write_check_json(std::ostream& out, std::span<const CheckedFile> files) {
  JsonStream json{out};
  json.begin_array(JsonLayout::Lines);
  for (const CheckedFile& checked : files) {
    json.begin_object().member("file", checked.file).member("ok", checked.ok);
    json.key("ledger");
    write_ledger(json, checked.ledger);
    json.end_object();
  }
  json.end_array();
}

void write_failure_json(std::ostream& out, std::span<const Diagnostic> ledger) {
  JsonStream json{out};
  json.begin_object().key("ledger");
  write_ledger(json, ledger);
  json.end_object();
}

}  // namespace pantin

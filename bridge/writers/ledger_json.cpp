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

namespace {

void write_account(JsonStream& json, const Account& account, AccountDetail detail) {
  json.key("counts").begin_object();
  const std::array<std::size_t, kFates> counts = count_fates(account);
  for (std::size_t i = 0; i < kFates; ++i)
    json.member(to_string(static_cast<Fate>(i)), static_cast<std::int64_t>(counts[i]));
  json.end_object();
  if (detail == AccountDetail::Counts) return;
  json.key("account").begin_array(JsonLayout::Lines);
  for (const AccountEntry& entry : account) {
    json.begin_object().member("fate", to_string(entry.fate)).member("place", entry.place);
    json.member("subject", entry.subject).member("item", entry.item).member("why", entry.why);
    json.member("count", static_cast<std::int64_t>(entry.count)).end_object();
  }
  json.end_array();
}

}  // namespace

void write_check_json(std::ostream& out, std::span<const CheckedFile> files, AccountDetail detail) {
  JsonStream json{out};
  json.begin_array(JsonLayout::Lines);
  for (const CheckedFile& checked : files) {
    json.begin_object().member("file", checked.file).member("ok", checked.ok);
    json.key("ledger");
    write_ledger(json, checked.ledger);
    write_account(json, checked.account, detail);
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

#include <pantin/bridge/diagnostic.hpp>

#include <algorithm>

namespace pantin {
namespace {

/// Names come from files: what could move a terminal's cursor or break the line is written as an escape. C1
/// controls are two bytes in UTF-8, C2 80 to C2 9F.
void append_escaped(std::string& out, std::string_view text) {
  constexpr std::string_view kHex = "0123456789abcdef";
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto byte = static_cast<unsigned char>(text[i]);
    const bool c1 = byte == 0xC2 && i + 1 < text.size() && static_cast<unsigned char>(text[i + 1]) >= 0x80 &&
                    static_cast<unsigned char>(text[i + 1]) <= 0x9F;
    if (byte == '\n') {
      out += "\\n";
    } else if (byte == '\t') {
      out += "\\t";
    } else if (byte < 0x20 || byte == 0x7F || c1) {
      const auto code = c1 ? static_cast<unsigned char>(text[++i]) : byte;
      out += {'\\', 'x', kHex[code >> 4], kHex[code & 15]};
    } else {
      out += text[i];
    }
  }
}

}  // namespace

std::string_view to_string(Severity severity) noexcept {
  switch (severity) {
    case Severity::Note:
      return "note";
    case Severity::Warning:
      return "warning";
    case Severity::Error:
      break;
  }
  return "error";
}

std::string to_string(const Diagnostic& diagnostic) {
  std::string out;
  for (const std::string_view part :
       {std::string_view{diagnostic.place}, to_string(diagnostic.severity),
        std::string_view{diagnostic.subject}, std::string_view{diagnostic.problem}}) {
    if (part.empty()) continue;
    if (!out.empty()) out += ": ";
    append_escaped(out, part);
  }
  if (!diagnostic.remedy.empty()) {
    out += "; ";
    append_escaped(out, diagnostic.remedy);
  }
  return out;
}

std::string printable(std::string_view text) {
  std::string out;
  append_escaped(out, text);
  return out;
}

bool has_error(const std::vector<Diagnostic>& notes) noexcept {
  return std::any_of(notes.begin(), notes.end(),
                     [](const Diagnostic& note) { return note.severity == Severity::Error; });
}

}  // namespace pantin

#pragma once
// The findings about one URDF file, collected by line. A robot of 130 links has the same finding dozens of
// times: alike ones are counted, and only the first few of a kind are written.
#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include <pantin/bridge/diagnostic.hpp>

namespace pantin::urdf_loader {

/// One finding before it has a place: what Diagnostic holds, without the file's name.
struct Finding {
  int line{0};  ///< of the file; 0 = the file as a whole
  std::string subject{};
  std::string problem{};
  std::string remedy{};
};

class Ledger {
 public:
  /// `file` is how the user named the file; it begins every place.
  explicit Ledger(std::string file) : file_{std::move(file)} {}

  void error(Finding finding) { add(Severity::Error, std::move(finding)); }
  void warning(Finding finding) { add(Severity::Warning, std::move(finding)); }
  void note(Finding finding) { add(Severity::Note, std::move(finding)); }

  /// A finding that may come many times: of one `kind` the first `most` are written, of notes one; the last
  /// of them says how many more there were.
  void alike(Severity severity, const std::string& kind, Finding finding, std::size_t most = 5);

  /// An element of the file, or an attribute of it, that nothing in the model depends on.
  struct Loss {
    std::size_t element{0};   ///< its number in the inventory
    std::string attribute{};  ///< empty: the element with all in it
    std::string why{};
  };
  /// What is taken where the file says nothing.
  struct Supplied {
    std::size_t element{0};  ///< where it would stand
    std::string item{};      ///< "/axis@xyz"
    std::string why{};       ///< "'1 0 0' is used"
  };
  void lose(Loss loss) { losses_.push_back(std::move(loss)); }
  void supply(Supplied supplied) { supplied_.push_back(std::move(supplied)); }
  [[nodiscard]] const std::vector<Loss>& losses() const noexcept { return losses_; }
  [[nodiscard]] const std::vector<Supplied>& supplied() const noexcept { return supplied_; }

  [[nodiscard]] bool has_error() const noexcept { return has_error_; }
  /// "file:line"
  [[nodiscard]] std::string place(int line) const;
  /// All findings in order of lines; the ledger is empty afterwards.
  [[nodiscard]] std::vector<Diagnostic> take();

 private:
  struct Entry {
    int line{0};
    Diagnostic diagnostic{};
  };
  struct Kind {
    std::size_t shown{0};
    std::size_t last_entry{0};  ///< position in entries_ of the last one written out
    std::size_t more{0};
  };
  void add(Severity severity, Finding finding);

  std::string file_;
  std::vector<Entry> entries_{};
  std::map<std::string, Kind> kinds_{};
  std::vector<Loss> losses_{};
  std::vector<Supplied> supplied_{};
  bool has_error_{false};
};

}  // namespace pantin::urdf_loader

#pragma once
// What assimp says while it reads, for the ledger.
#include <memory>
#include <string>
#include <vector>

#include <pantin/bridge/diagnostic.hpp>

namespace pantin::assimp_loader {

/// Listens to assimp's logger, which is one for the process, as long as it lives.
class LogCapture {
 public:
  LogCapture();
  ~LogCapture();
  LogCapture(const LogCapture&) = delete;
  LogCapture& operator=(const LogCapture&) = delete;

  /// Its warnings and errors as notes (assimp's words say nothing about what is lost), each text once, the
  /// first few; the last says how many there are more.
  void append_to(std::vector<Diagnostic>& notes, const std::string& place) const;

 private:
  std::shared_ptr<std::vector<std::string>> lines_;
};

}  // namespace pantin::assimp_loader

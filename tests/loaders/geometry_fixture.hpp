#pragma once
// Small mesh files, and what is said of them.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include <pantin/bridge/loaders/load_geometry.hpp>

#include "support/temporary_folder.hpp"

namespace pantin::test {

class LoadGeometry : public testing::Test {
 protected:
  Loaded<Model> load(const std::string& name, const std::string& content,
                     const LoadOptions& options = {}) const {
    return load_geometry(folder_.write(name, content), options);
  }
  Model model(const std::string& name, const std::string& content) const {
    Loaded<Model> loaded = load(name, content);
    if (!loaded.value) throw std::runtime_error{to_string(loaded.notes.at(0))};
    return *std::move(loaded.value);
  }
  /// "file-name:line: problem" of the one error.
  std::string refusal(const std::string& name, const std::string& content) const {
    const Loaded<Model> loaded = load(name, content);
    if (loaded.value || loaded.notes.size() != 1) return "(not refused)";
    const Diagnostic& note = loaded.notes[0];
    return note.place.substr(folder_.path().string().size() + 1) + ": " + note.problem;
  }
  static std::vector<std::string> said(const Loaded<Model>& loaded) {
    std::vector<std::string> all;
    for (const Diagnostic& note : loaded.notes)
      all.push_back(std::string{to_string(note.severity)} + ": " + note.subject + ": " + note.problem);
    return all;
  }
  TemporaryFolder folder_{};
};

}  // namespace pantin::test

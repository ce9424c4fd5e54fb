#include <gtest/gtest.h>

#include <pantin/bridge/diagnostic.hpp>
#include <pantin/bridge/model.hpp>

namespace pantin {
namespace {

TEST(Diagnostic, IsOneLineOfPlaceSeveritySubjectProblemRemedy) {
  // The form is the one that DESIGN fixes for every message of the program, so that editors can jump to the
  // place.
  const Diagnostic full{Severity::Error, "robot.urdf:41", "joint 'grip'",
                        "mimic names 'palm', which does not exist", "name an existing joint"};
  EXPECT_EQ(
      to_string(full),
      "robot.urdf:41: error: joint 'grip': mimic names 'palm', which does not exist; name an existing joint");
}

TEST(Diagnostic, LeavesOutWhatIsEmpty) {
  // No separators stand around parts that are not there.
  EXPECT_EQ(to_string(Diagnostic{Severity::Warning, "", "", "odd", ""}), "warning: odd");
  EXPECT_EQ(to_string(Diagnostic{Severity::Note, "a:1", "", "odd", "mend it"}), "a:1: note: odd; mend it");
}

TEST(Diagnostic, EscapesControlCharactersOfTheInput) {
  // A name from a file may hold escape sequences; none of their control bytes (C0, DEL, C1) may reach the
  // terminal, and ordinary UTF-8 must pass unchanged.
  const Diagnostic hostile{Severity::Error, "f:1", "link 'a\x1b[2J\n\tb\x7f\xc2\x9b'",
                           "name \xc3\xa9t\xc3\xa9", ""};
  EXPECT_EQ(to_string(hostile), "f:1: error: link 'a\\x1b[2J\\n\\tb\\x7f\\x9b': name \xc3\xa9t\xc3\xa9");
}

TEST(Diagnostic, HasErrorLooksForErrorsOnly) {
  // Warnings and notes leave a model usable.
  EXPECT_FALSE(has_error({}));
  EXPECT_FALSE(has_error({{Severity::Note, "", "", "", ""}, {Severity::Warning, "", "", "", ""}}));
  EXPECT_TRUE(has_error({{Severity::Note, "", "", "", ""}, {Severity::Error, "", "", "", ""}}));
}

TEST(Diagnostic, NamesSeveritiesAndAxes) {
  // These words are part of the JSON output.
  EXPECT_EQ(to_string(Severity::Note), "note");
  EXPECT_EQ(to_string(Severity::Warning), "warning");
  EXPECT_EQ(to_string(Severity::Error), "error");
  EXPECT_EQ(to_string(UpAxis::X), "X");
  EXPECT_EQ(to_string(UpAxis::Y), "Y");
  EXPECT_EQ(to_string(UpAxis::Z), "Z");
}

}  // namespace
}  // namespace pantin

#pragma once
// How the program ends.

namespace pantin::cli {

enum class ExitCode : int {
  Fine = 0,
  BadInput = 1,          ///< a file or a name in it cannot be used, or output cannot be written
  BadUsage = 2,          ///< the command line itself is wrong
  NumericalFailure = 3,  ///< numbers went wrong while simulating
};

}  // namespace pantin::cli

#pragma once
// Contracts: what a caller must have right. Always on. A broken contract prints expression, values and place
// and calls the handler, which aborts unless it was replaced (by one that throws, say); it is never ignored.
// The same text stands in scenegraph/ and physics/, which never include each other; the handler is one.
#ifndef PANTIN_EXPECTS
#include <cstdio>
#include <cstdlib>
#include <source_location>
#include <string>

namespace pantin {

/// A contract that did not hold.
struct ContractViolation {
  std::string expression;        ///< the condition as written in the source
  std::string what;              ///< which rule, with the values that broke it and the remedy
  std::source_location where{};  ///< file, line and function of the check
};

/// Receives a broken contract; must not return normally (abort, throw or exit). One that returns is followed
/// by abort.
using ContractHandler = void (*)(const ContractViolation&);

/// Prints the violation on stderr and aborts: the default handler.
inline void abort_on_violation(const ContractViolation& v) {
  std::fprintf(stderr, "%s:%u: contract broken in %s: %s [%s]\n", v.where.file_name(), v.where.line(),
               v.where.function_name(), v.what.c_str(), v.expression.c_str());
  std::abort();
}

/// The handler in use; assign to replace it. The only global of the library.
inline ContractHandler& contract_handler() {
  static ContractHandler handler = &abort_on_violation;
  return handler;
}

[[noreturn]] inline void contract_broken(ContractViolation violation) {
  contract_handler()(violation);
  std::abort();
}

}  // namespace pantin

#define PANTIN_EXPECTS(condition, what) \
  (static_cast<bool>(condition)         \
       ? void(0)                        \
       : ::pantin::contract_broken({#condition, (what), std::source_location::current()}))
#endif

#pragma once
// Turns broken contracts into exceptions for the life of a guard, so that a test can see them.
#include <stdexcept>

#include <pantin/scenegraph/expects.hpp>

namespace pantin::test {

struct ContractError : std::logic_error {
  using std::logic_error::logic_error;
};

class ThrowOnContract {
 public:
  ThrowOnContract() : saved_{contract_handler()} {
    contract_handler() = [](const ContractViolation& v) {
      throw ContractError{v.what + " [" + v.expression + "]"};
    };
  }
  ~ThrowOnContract() { contract_handler() = saved_; }
  ThrowOnContract(const ThrowOnContract&) = delete;
  ThrowOnContract& operator=(const ThrowOnContract&) = delete;

 private:
  ContractHandler saved_;
};

}  // namespace pantin::test

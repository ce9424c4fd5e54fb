#pragma once
// Expects that a call breaks a contract, and what the text says.
#include <gtest/gtest.h>

#include <string>
#include <support/contracts.hpp>

namespace pantin::test {

/// `call()` must break a contract whose text contains `text`.
template <class Call>
void expect_contract(const Call& call, const std::string& text) {
  const ThrowOnContract guard;
  try {
    call();
    ADD_FAILURE() << "no contract was broken; expected: " << text;
  } catch (const ContractError& error) {
    EXPECT_NE(std::string{error.what()}.find(text), std::string::npos) << "the text was: " << error.what();
  }
}

}  // namespace pantin::test

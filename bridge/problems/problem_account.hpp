#pragma once
// The end of reading a problem: what became of every value of its JSON. Private to load_rigid_ref.
#include <string>
#include <vector>

#include <pantin/bridge/account.hpp>
#include <pantin/bridge/diagnostic.hpp>

#include "json_document.hpp"

namespace pantin::reference {

/// Sums up in `ledger` what is known and not needed, and warns of what nobody looked at. `account` gets an
/// entry for every member of an object and every object in a list; it may be null.
void settle(const JsonValue& root, const std::string& file, std::vector<Diagnostic>& ledger,
            Account* account);

}  // namespace pantin::reference

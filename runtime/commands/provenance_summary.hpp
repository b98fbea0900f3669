#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace samara {

/// What the cases of a table have in common.
struct ProvenanceSummary {
    std::size_t cases = 0;
    /// Each key of the cases, with its one value, its range, or how many values it takes.
    std::vector<std::pair<std::string, std::string>> keys;
};

/// Summarises a JSON array with one object a case. A text that is no such array gives no cases.
ProvenanceSummary summarise_provenance(std::string_view json);

}  // namespace samara

#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <vector>

#include "converter/cases/case_reduction.hpp"
#include "converter/falls/fall_identification.hpp"
#include "samara/analysis/verdicts/case_records.hpp"
#include "samara/core/body/body.hpp"

namespace samara {

/// The result of converting a folder of solved cases.
struct Conversion {
    Body body;                      ///< body.body.h5 of the folder with its tables filled
    std::vector<SolvedCase> cases;  ///< in the plan's order, case axes, as used for the tables: without the
                                    ///< components that the symmetry forbids, which widen the errors
    std::vector<LoadEntryError> sampling_errors;   ///< of the tables' entries (fill_tables)
    std::vector<LeftOutCase> left_out;             ///< cases and falls that could not be solved
    std::optional<Identification> identification;  ///< of the dynamic coefficients, where falls are solved
};

/// Reads a folder of cases that `samara bake` made and solved (docs/file-formats), reduces every case and
/// fills the tables over all directions by the body's symmetry. The tables' errors hold the tail of the
/// iterations and what the symmetry forbids; of the errors of mesh, closure and interpolation they know
/// nothing. Where the plan has free falls, the dynamic coefficients are identified from those that are solved
/// (identify_motion); falls that failed are left out, and without any the body has none. `progress` is called
/// with the number of cases done and their total, `identifying` with the share of the identification done.
/// Throws Error where the folder holds no cases, is of another body than its body file, lacks a direction, or
/// has a case that is not solved (the message names the first) or diverged, or a fall that is neither solved
/// nor failed.
Conversion convert_folder(const std::filesystem::path& folder,
                          const std::function<void(std::size_t done, std::size_t total)>& progress = {},
                          const std::function<void(double share)>& identifying = {});

}  // namespace samara

#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace samara {

/// What an OpenFOAM function object wrote at every iteration: a table with named columns.
struct FoamHistory {
    std::filesystem::path file;
    std::vector<std::string> columns;       ///< "Time", "total_x", "volAverage(k)", ...
    std::vector<std::vector<double>> rows;  ///< one for each time, as long as `columns`

    /// The values of a column in the rows whose Time is at least `start`. Throws Error where there is no such
    /// column.
    [[nodiscard]] std::vector<double> column(const std::string& name, double start) const;
};

/// Reads postProcessing/NAME/TIME/*.dat: comments that begin with '#', of which the last before the numbers
/// names the columns; brackets around vectors are passed over, so that the layouts of OpenFOAM v1912 (vectors
/// in brackets) and v2112 (none) read alike. Throws Error with file and line.
FoamHistory read_history(const std::filesystem::path& file);

}  // namespace samara

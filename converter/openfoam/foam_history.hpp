#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace samara {

/// A folder that OpenFOAM named by a time, such as "0", "100", "0.25" or "1e-05".
struct TimeFolder {
    double time;
    std::filesystem::path path;
};

/// Returns the time by which a folder is named; nothing where its name is no number.
std::optional<double> time_of(const std::filesystem::path& folder);

/// Returns the time folders in a folder by ascending time; none where the folder does not exist.
std::vector<TimeFolder> time_folders(const std::filesystem::path& folder);

/// The files that a history was read from.
class HistoryFiles {
  public:
    /// Appends a file whose times begin with `first`; it replaces later times of earlier files.
    void add(double first, std::filesystem::path file);
    /// Returns the file that holds a time of the history. There must be at least one file.
    [[nodiscard]] const std::filesystem::path& at(double time) const;

  private:
    std::vector<std::pair<double, std::filesystem::path>> files_;  // by ascending first times
};

/// The output of an OpenFOAM function object: a table with named columns and a row for each iteration.
struct FoamHistory {
    std::filesystem::path file;             ///< the last that was read
    std::vector<std::string> columns;       ///< "Time", "total_x", "volAverage(k)", ...
    std::vector<std::vector<double>> rows;  ///< one for each time, as long as `columns`; times ascend
    HistoryFiles files;

    [[nodiscard]] bool has(const std::string& name) const;
    /// Returns the index of a column. Throws Error where there is none.
    [[nodiscard]] std::size_t index(const std::string& name) const;
    /// Returns the values of a column in the rows whose Time is at least `start`. Throws Error where there is
    /// no such column.
    [[nodiscard]] std::vector<double> column(const std::string& name, double start) const;
};

/// Whether a history that ends within a line, as after its writer was killed, is rejected or loses that line.
enum class CutLine { reject, drop };

/// Reads one file postProcessing/NAME/TIME/FILE.dat: comments that begin with '#', of which the last before
/// the numbers names the columns; brackets around vectors are ignored, so that the layouts of OpenFOAM v1912
/// (with brackets) and v2112 (without) give the same result. The heading "forces(pressure viscous)" of
/// OpenFOAM 8 to 11 names the vectors forces_pressure_x, forces_pressure_y, ... Throws Error with file and
/// line, and where the times do not ascend.
FoamHistory read_history(const std::filesystem::path& file, CutLine cut_line = CutLine::reject);

/// Returns the files of a history in the order of the solver's runs: FOLDER/TIME/NAME.dat for every start
/// time TIME in ascending order, each followed by NAME_TIME.dat, which OpenFOAM writes where a run starts at
/// a time from which another had started. Empty where there is none.
std::vector<std::filesystem::path> history_files(const std::filesystem::path& folder,
                                                 const std::string& name);

/// Reads history_files as one history: from its first time on, a file replaces the values of earlier ones. A
/// line that a killed run left incomplete is dropped where a later run continued; at the end of the history
/// it is an error. Throws Error where there is no such file, where none has values, where they differ in
/// their columns, or where a file begins before the start time of its folder.
FoamHistory read_joined_history(const std::filesystem::path& folder, const std::string& name);

}  // namespace samara

// The files of OpenFOAM cases. The first letter of the input is the reader's, the rest is the file; what
// begins as a gzip file is read as one. Of a whole folder of cases (x) the rest is its files: each begins
// with a line
// "@ NAME", and "@ NAME -> TARGET" is a link.

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>

#include "converter/cases/case_plan.hpp"
#include "converter/cases/case_reduction.hpp"
#include "converter/cases/samples_csv.hpp"
#include "converter/falls/free_fall.hpp"
#include "converter/openfoam/foam_dictionary.hpp"
#include "converter/openfoam/foam_file.hpp"
#include "converter/openfoam/foam_history.hpp"
#include "harness.hpp"
#include "samara/core/files/content_hash.hpp"
#include "samara/core/files/folders.hpp"

namespace samara::fuzz {
namespace {

struct Kind {
    char letter;
    const char* name;  ///< of the file
    void (*read)(const std::filesystem::path& file);
};

void read_faces_of_mesh(const std::filesystem::path& file) {
    const FoamFaces faces = read_faces(file);
    require(faces.starts.back() == static_cast<std::int64_t>(faces.points.size()), "faces fit their points");
}

void read_rows(const std::filesystem::path& file) {
    for (const CutLine cut : {CutLine::reject, CutLine::drop}) {
        const auto history = accepted([&] { return read_history(file, cut); });
        if (!history) continue;
        for (const auto& row : history->rows) {
            require(row.size() == history->columns.size(), "rows have a value for each column");
        }
    }
}

void read_dictionary(const std::filesystem::path& file) {
    const FoamDictionary dictionary(file);
    accepted([&] { return dictionary.number("rho"); });
    accepted([&] { return dictionary.vector("U"); });
}

bool stays_within(const std::filesystem::path& name) {
    if (name.empty() || name.is_absolute() || name.native().size() > 200) return false;
    return std::none_of(name.begin(), name.end(),
                        [](const std::filesystem::path& part) { return part == ".."; });
}

void add_to_folder(const std::filesystem::path& folder, std::string_view line, std::string_view bytes) {
    const std::size_t arrow = line.find(" -> ");
    const std::filesystem::path name(line.substr(0, arrow));
    if (!stays_within(name) || name.native().find('\0') != std::string::npos) return;
    std::error_code taken;  // by a folder, or a file in the way
    std::filesystem::create_directories((folder / name).parent_path(), taken);
    if (arrow == std::string_view::npos) {
        std::ofstream(folder / name, std::ios::binary) << bytes;
    } else if (line.find('\0') == std::string_view::npos) {
        std::filesystem::create_symlink(line.substr(arrow + 4), folder / name, taken);
    }
}

/// Cases as they stand in a folder: plan, dictionaries, histories, fields and links together.
void read_folder(const std::filesystem::path& archive) {
    std::string text = read_bytes(archive);
    const std::filesystem::path folder = archive.parent_path() / "cases";
    std::filesystem::remove_all(folder);
    std::filesystem::create_directory(folder);
    for (std::size_t at = text.starts_with("@ ") ? 0 : text.find("\n@ "); at < text.size();) {
        const std::size_t name = at + (at == 0 ? 2 : 3);
        const std::size_t line_end = std::min(text.find('\n', name), text.size());
        const std::size_t next = std::min(text.find("\n@ ", line_end), text.size());
        const std::string_view rest(text);
        const std::size_t start = std::min(line_end + 1, text.size());
        add_to_folder(folder, rest.substr(name, line_end - name),
                      rest.substr(start, std::max(next, start) - start));
        at = next;
    }
    const FolderReduction reduction =
        reduce_folder(folder, read_case_plan(folder), {}, UnsolvedCases::leave_out);
    for (const SolvedCase& solved : reduction.cases) {
        require(solved.sample.entry.force.allFinite() && solved.sample.error.force.allFinite(),
                "loads are finite");
        require(-solved.sample.entry.force.dot(solved.sample.direction) > 0.0, "drag is positive");
    }
}

constexpr Kind kinds[] = {
    {'x', "archive", read_folder},
    {'a', "p", [](const std::filesystem::path& file) { require_foam_data(file); }},
    {'s', "k", [](const std::filesystem::path& file) { read_scalar_field(file); }},
    {'v', "U", [](const std::filesystem::path& file) { read_vector_field(file); }},
    {'z', "cellZones", [](const std::filesystem::path& file) { read_cell_zone(file, "shell"); }},
    {'l', "owner", [](const std::filesystem::path& file) { read_labels(file); }},
    {'p', "points", [](const std::filesystem::path& file) { read_points(file); }},
    {'f', "faces", read_faces_of_mesh},
    {'h', "force.dat", read_rows},
    {'d', "transportProperties", read_dictionary},
    {'c', "samples.csv", [](const std::filesystem::path& file) { read_samples_csv(file); }},
    {'j', "plan.json", [](const std::filesystem::path& file) { read_case_plan(file.parent_path()); }},
    {'g', "fall.json", [](const std::filesystem::path& file) { read_free_fall(file.parent_path()); }},
};

}  // namespace

void feed(std::string_view input) {
    static const TemporaryFolder folder;
    for (const Kind& kind : kinds) {
        if (!input.starts_with(kind.letter)) continue;
        const std::string_view bytes = input.substr(1);
        const std::filesystem::path file = folder / kind.name;
        std::filesystem::path stored = file;
        if (bytes.starts_with("\x1f\x8b")) stored += ".gz";
        std::ofstream(stored, std::ios::binary) << bytes;
        accepted([&] { kind.read(file); });
        std::filesystem::remove(stored);
    }
}

}  // namespace samara::fuzz

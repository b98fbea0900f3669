// The files of OpenFOAM cases. The first letter of the input is the reader's, the rest is the file; what
// begins as a gzip file is read as one.

#include <filesystem>
#include <fstream>

#include "converter/cases/case_plan.hpp"
#include "converter/cases/samples_csv.hpp"
#include "converter/falls/free_fall.hpp"
#include "converter/openfoam/foam_dictionary.hpp"
#include "converter/openfoam/foam_file.hpp"
#include "converter/openfoam/foam_history.hpp"
#include "harness.hpp"
#include "internal/files/temporary_folder.hpp"

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
    for (const CutLine cut : {CutLine::refuse, CutLine::drop}) {
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

constexpr Kind kinds[] = {
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

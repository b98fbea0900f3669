#include <algorithm>
#include <cctype>
#include <string_view>

#include <fmt/format.h>

#include "converter/openfoam/foam_file.hpp"
#include "converter/openfoam/foam_history.hpp"
#include "foam-cases/farm/case_folder.hpp"
#include "samara/core/base/error.hpp"
#include "samara/core/files/content_hash.hpp"

namespace samara {
namespace {

namespace fs = std::filesystem;

// The files beside the folders of meshes, cases and falls.
constexpr std::string_view files_beside[] = {".lock",     ".cluster",     "README",
                                             "plan.json", "body.body.h5", "log.snakemake"};
// Snakemake's folder, which is removed before it runs.
constexpr std::string_view notes_of_snakemake = ".snakemake";
// The names of folders that other plans may have made there begin so.
constexpr std::string_view names_of_cases[] = {"direction_", "probe_", "fall_", "mesh"};

// The files that solving leaves in a case's folder.
constexpr std::string_view records[] = {"case.foam",       "round",       "rounds.json", "attempts.json",
                                        "provenance.json", "failed.json", "mesh.json"};
constexpr std::string_view made_by_surface_features[] = {"constant/triSurface/body.eMesh",
                                                         "constant/extendedFeatureEdgeMesh"};

bool is_one_of(std::string_view name, const auto& names) {
    return std::ranges::find(names, name) != std::end(names);
}

// Whether the name is of a temporary file of samara, its scripts or a network file system.
bool is_temporary(const std::string& name) {
    return (name.starts_with(".samara.") && name.ends_with(".tmp")) || name.ends_with(".json.part") ||
           name.starts_with(".nfs");  // kept by a network file system until the file is closed
}

bool is_time(const std::string& name) {
    return std::isdigit(static_cast<unsigned char>(name.front())) != 0 && time_of(name);
}

bool is_of_processor(const std::string& name) {
    constexpr std::string_view prefix = "processor";
    return name.starts_with(prefix) && name.size() > prefix.size() &&
           std::all_of(name.begin() + prefix.size(), name.end(),
                       [](char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; });
}

/// Checks one folder against what is planned in it.
class FolderInspection {
  public:
    FolderInspection(fs::path folder, const InputFolder& planned)
        : folder_(std::move(folder)), planned_(planned) {}

    void run() const { inspect(fs::path()); }

  private:
    [[nodiscard]] Error error(const fs::path& file, const std::string& what) const {
        return Error(fmt::format("{}: {}; remove it, or all of {}, which is then solved again", file.string(),
                                 what, folder_.string()));
    }

    void inspect(const fs::path& inside) const {
        for (const auto& entry : fs::directory_iterator(folder_ / inside)) {
            const fs::path name = inside / entry.path().filename();
            const fs::file_status status = entry.symlink_status();
            if (status.type() == fs::file_type::symlink && is_known_link(name)) continue;
            if (status.type() == fs::file_type::directory && is_known_folder(name)) {
                inspect(name);
            } else if (status.type() == fs::file_type::regular && is_known_file(name)) {
                if (is_read_by_solver(name)) require_data(name);
            } else {
                throw error(entry.path(), what_it_is(status.type()));
            }
        }
    }

    static std::string what_it_is(fs::file_type type) {
        if (type == fs::file_type::symlink) return "is a link, which is not followed here";
        if (type == fs::file_type::directory)
            return "is a folder that neither samara nor OpenFOAM creates here";
        if (type == fs::file_type::regular) return "is a file that neither samara nor OpenFOAM writes here";
        return "is neither a file nor a folder";
    }

    /// Whether the link is one that samara made: a link to a mesh is replaced, one to a start is removed.
    [[nodiscard]] bool is_known_link(const fs::path& name) const {
        if (planned_.type == FolderType::mesh) return false;
        return name == "startCase" || name == "constant/polyMesh" ||
               (planned_.type == FolderType::flow && name == "constant/triSurface");
    }

    /// Whether the path is in a folder of the solver (a time, a mesh or a history), which may contain any
    /// file.
    [[nodiscard]] bool is_of_solver(const fs::path& name) const {
        const std::string first = name.begin()->string();
        const bool is_solved = planned_.type != FolderType::mesh;
        if (is_solved) return is_time(first) || first == "postProcessing" || is_of_processor(first);
        return (name / "").string().starts_with("constant/polyMesh/");
    }

    [[nodiscard]] bool is_known_folder(const fs::path& name) const {
        if (is_of_solver(name) || (planned_.type == FolderType::mesh && name == made_by_surface_features[1]))
            return true;
        return std::ranges::any_of(planned_.files, [&](const auto& file) {
            return file.first.string().starts_with(name.string() + "/");
        });
    }

    [[nodiscard]] bool is_known_file(const fs::path& name) const {
        if (planned_.files.contains(name) || is_temporary(name.filename().string())) return true;
        if (name.has_parent_path()) {
            const std::string path = name.string();
            const bool is_edge = planned_.type == FolderType::mesh &&
                                 std::ranges::any_of(made_by_surface_features, [&](std::string_view made) {
                                     return path.starts_with(made);
                                 });
            return is_edge || (is_of_solver(name) && name.extension() != ".gz");
        }
        const std::string only = name.string();
        // The file is included by `parameters`; flows have none.
        if (only == "remedy") return planned_.type != FolderType::flow;
        return is_one_of(only, records) || only.starts_with("log.");
    }

    [[nodiscard]] bool is_read_by_solver(const fs::path& name) const {
        const std::string first = name.begin()->string();
        return !planned_.files.contains(name) && name.has_parent_path() && is_of_solver(name) &&
               first != "postProcessing" && !is_of_processor(first);
    }

    void require_data(const fs::path& name) const {
        // The start is a copy of a planned file.
        const auto start = planned_.files.find(fs::path("0.orig") / name.filename());
        const fs::path file = folder_ / name;
        if (*name.begin() == "0" && start != planned_.files.end() && read_bytes(file) == start->second)
            return;
        try {
            require_foam_data(file);
        } catch (const Error& reason) {
            throw Error(fmt::format("{}; remove the folder {}, which is then solved again", reason.what(),
                                    folder_.string()));
        }
    }

    fs::path folder_;
    const InputFolder& planned_;
};

}  // namespace

void require_known_files(const fs::path& cases, const InputFolders& planned) {
    const fs::file_type type = fs::symlink_status(cases).type();
    if (type == fs::file_type::not_found) return;
    if (type != fs::file_type::directory) {
        throw Error(fmt::format(
            "{}: is {}, but cases are solved in a folder; remove it, or choose another name for the output",
            cases.string(), type == fs::file_type::symlink ? "a link" : "a file"));
    }
    for (const auto& entry : fs::directory_iterator(cases)) {
        const std::string name = entry.path().filename().string();
        const fs::file_type entry_type = entry.symlink_status().type();
        const auto found = planned.find(name);
        if (entry_type == fs::file_type::directory) {
            if (found != planned.end()) {
                FolderInspection(entry.path(), found->second).run();
                continue;
            }
            if (name == notes_of_snakemake) continue;
            if (std::ranges::any_of(names_of_cases,
                                    [&](std::string_view start) { return name.starts_with(start); })) {
                continue;
            }
        }
        if (entry_type == fs::file_type::regular && (is_one_of(name, files_beside) || is_temporary(name)))
            continue;
        throw Error(fmt::format(
            "{}: is {}; move it out of {}, or remove that folder, whose cases are then solved again",
            entry.path().string(),
            entry_type == fs::file_type::symlink ? "a link, which is not followed here"
                                                 : "not created by samara",
            cases.string()));
    }
}

}  // namespace samara

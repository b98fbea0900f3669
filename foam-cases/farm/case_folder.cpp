#include "foam-cases/farm/case_folder.hpp"

#include <fstream>
#include <iterator>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "foam-cases/farm/case_records.hpp"
#include "samara/core/base/error.hpp"
#include "samara/core/body/body_file.hpp"
#include "samara/core/files/content_hash.hpp"
#include "samara/core/files/folders.hpp"
#include "samara/core/files/replace_file.hpp"

namespace samara {
namespace {

namespace fs = std::filesystem;

// The Python module that the scripts in a case share with those of the farm; a copy is put into each case. It
// reads files and words errors, and so is no input of a solution.
constexpr const char* helper_file = "case_files.py";

// The README of a folder of cases.
constexpr const char* folder_notes =
    "OpenFOAM cases and their meshes, by samara (docs/explanation/bake.md, docs/reference/file-formats.md). "
    "ParaView opens each by its file\n"
    "case.foam. The folder may be moved and copied as a whole: it has no links to outside. A case's mesh is "
    "a link to the\n"
    "mesh's own folder beside it; to copy a single case, use 'cp -rL CASE ELSEWHERE', which copies the mesh "
    "too.\n";

// The files that a fall's case shares with the flow's: the fluid and its turbulence.
constexpr const char* shared_files[] = {"0.orig/k",
                                        "0.orig/epsilon",
                                        "0.orig/omega",
                                        "0.orig/gammaInt",
                                        "0.orig/ReThetat",
                                        "0.orig/nut",
                                        "constant/transportProperties",
                                        "constant/turbulenceProperties"};

// The inputs of a mesh besides its parameters.
constexpr const char* mesh_files[] = {"Allrun",
                                      "constant/triSurface/body.stl",
                                      "system/blockMeshDict",
                                      "system/snappyHexMeshDict",
                                      "system/surfaceFeatureExtractDict",
                                      "system/topoSetDict"};

CaseFiles read_template(const fs::path& folder) {
    CaseFiles files;
    for (const auto& entry : fs::recursive_directory_iterator(folder)) {
        // Python's compiled files are no part of a case.
        if (entry.is_regular_file() && entry.path().parent_path().filename() != "__pycache__") {
            files[fs::relative(entry.path(), folder)] = read_bytes(entry.path());
        }
    }
    if (!files.contains("parameters") || !files.contains("Allrun")) {
        throw Error(fmt::format("{}: is not a case template: it needs the files parameters and Allrun",
                                folder.string()));
    }
    files[helper_file] = read_bytes(folder.parent_path() / helper_file);
    return files;
}

std::string hash_of(const CaseFiles& files) {
    std::string bytes;
    for (const auto& [path, content] : files) {
        if (path == helper_file) continue;
        bytes += fmt::format("{}\n{}\n", path.generic_string(), content.size());
        bytes += content;
    }
    return content_hash(bytes);
}

std::string mesh_hash(const CaseFiles& files) {
    CaseFiles inputs;
    for (const char* name : mesh_files) {
        if (const auto found = files.find(name); found != files.end()) inputs.insert(*found);
    }
    inputs["parameters"] = mesh_parameters_of(files.at("parameters"));
    return hash_of(inputs);
}

void write_plan(const fs::path& path, const nlohmann::json& json) {
    replace_file(path, [&](const fs::path& temporary) {
        std::ofstream file(temporary, std::ios::binary);
        file << json.dump(2) << '\n';
        if (!file.flush()) throw Error(fmt::format("{}: cannot be written", path.string()));
    });
}

bool holds(const fs::path& path, const std::string& bytes) {
    std::error_code unknown;
    return fs::file_size(path, unknown) == bytes.size() && !unknown && read_bytes(path) == bytes;
}

void write_files(const fs::path& folder, const CaseFiles& files) {
    for (const auto& [name, bytes] : files) {
        const fs::path path = folder / name;
        if (!holds(path, bytes)) {
            fs::create_directories(path.parent_path());
            fs::remove(path);  // a hard link elsewhere keeps its content
            // Not synced: a file that a crash truncated differs, and is written again.
            std::ofstream file(path, std::ios::binary);
            file << bytes;
            if (!file.flush()) throw Error(fmt::format("{}: cannot be written", path.string()));
        }
        // Also for complete files: an earlier call may have been killed before this.
        if (bytes.starts_with("#!")) {
            fs::permissions(path, fs::perms::owner_exec | fs::perms::group_exec | fs::perms::others_exec,
                            fs::perm_options::add);
        }
    }
}

void link_to_mesh(const fs::path& folder, const std::string& mesh, const char* name) {
    const fs::path link = folder / "constant" / name;
    const fs::path target = fs::path("../..") / mesh / "constant" / name;
    std::error_code none;
    if (fs::is_symlink(link) && fs::read_symlink(link, none) == target) return;
    fs::remove_all(link);
    fs::create_directory_symlink(target, link);
}

// The empty file by which ParaView opens a case or a mesh.
void write_foam_file(const fs::path& folder) {
    const fs::path file = folder / "case.foam";
    if (!fs::exists(file)) replace_file_with(file, "");
}

// Returns whether a record exists and belongs to these inputs.
bool is_of_inputs(const fs::path& record, const std::string& hash) {
    const nlohmann::json json = read_record(record);
    return !json.empty() && text_in(json, "inputs_hash") == hash;
}

// Removes a record that belongs to other inputs or cannot be read; returns whether it did.
bool discard_stale(const fs::path& record, const std::string& hash) {
    return fs::exists(record) && !is_of_inputs(record, hash) && fs::remove(record);
}

// Returns whether a mesh was not removed.
bool has_mesh(const fs::path& folder) {
    return fs::exists(folder / "constant/polyMesh/cellZones");
}

void remove_unplanned_cases(const fs::path& folder, const BakePlan& plan) {
    std::vector<fs::path> unplanned;
    for (const auto& entry : fs::directory_iterator(folder)) {
        const std::string name = entry.path().filename().string();
        bool planned = !name.starts_with("direction_") && !name.starts_with("probe_") &&
                       !name.starts_with("fall_") && !name.starts_with("mesh");
        for (const FlowMesh& mesh : plan.all_meshes()) planned = planned || mesh.name == name;
        for (const BakeCase& one : plan.cases) planned = planned || one.name == name;
        for (const FreeFall& fall : plan.falls) planned = planned || fall.name == name;
        if (!planned) unplanned.push_back(entry.path());
    }
    for (const fs::path& path : unplanned) fs::remove_all(path);
}

void write_mesh_case(const fs::path& folder, const InputFolder& mesh) {
    // A mesh that was removed is made again.
    const std::string needed = has_mesh(folder) ? mesh.hash : "";
    discard_stale(folder / "mesh.json", needed);
    discard_stale(folder / "failed.json", mesh.hash);
    write_files(folder, mesh.files);
    write_foam_file(folder);
}

void write_case(const fs::path& folder, const InputFolder& one) {
    const bool solved_before = discard_stale(folder / "provenance.json", one.hash);
    const bool failed_before = discard_stale(folder / "failed.json", one.hash);
    if (solved_before || failed_before) {
        // Its histories would count as progress, and the records of attempts are useless without them.
        for (const char* name : {"postProcessing", "rounds.json", "attempts.json"})
            fs::remove_all(folder / name);
    }
    write_files(folder, one.files);
    write_foam_file(folder);
    link_to_mesh(folder, one.mesh, "polyMesh");
    if (one.type == FolderType::flow) link_to_mesh(folder, one.mesh, "triSurface");
}

// Returns all planned folders, without the body file and the plan beside them.
InputFolders input_folders(const Body& body, const BakePlan& plan, const fs::path& foam_cases) {
    const CaseFiles body_flow = read_template(foam_cases / "templates/body-flow");
    const std::string stl = case_surface_stl(body, plan);
    InputFolders folders;
    for (const FlowMesh& mesh : plan.all_meshes()) {
        CaseFiles files = body_flow;
        files["parameters"] = mesh_case_parameters(files.at("parameters"), mesh);
        files["constant/triSurface/body.stl"] = stl;
        const std::string hash = mesh_hash(files);
        folders[mesh.name] = {FolderType::mesh, std::move(files), "", hash};
    }
    for (const BakeCase& entry : plan.cases) {
        CaseFiles files = body_flow;
        files["parameters"] = case_parameters(files.at("parameters"), plan, entry);
        std::string& ranks = files["system/decomposeParDict"];
        ranks = decomposition(ranks, plan.ranks);
        const std::string start = entry.start_from.empty() ? "" : folders.at(entry.start_from).hash;
        const std::string hash = content_hash(folders.at(entry.mesh).hash + start + hash_of(files));
        folders[entry.name] = {FolderType::flow, std::move(files), entry.mesh, hash};
    }
    if (plan.falls.empty()) return folders;
    const CaseFiles fall_template = read_template(foam_cases / "templates/free-fall");
    for (const FreeFall& fall : plan.falls) {
        CaseFiles files = fall_template;
        for (const char* name : shared_files) files[name] = body_flow.at(name);
        files["parameters"] = fall_parameters(files.at("parameters"), plan, fall);
        files["fall.json"] = free_fall_json(fall);
        const std::string hash = content_hash(folders.at(fall.mesh).hash + hash_of(files));
        folders[fall.name] = {FolderType::fall, std::move(files), fall.mesh, hash};
    }
    return folders;
}

}  // namespace

fs::path foam_cases_folder() {
    return find_share_folder({"foam-cases", "the case templates", "SAMARA_FOAM_CASES", "farm/Snakefile",
                              SAMARA_FOAM_CASES_SOURCE});
}

void require_cases_of(CaseType type, const fs::path& folder) {
    const fs::path plan = folder / "plan.json";
    const nlohmann::json json = read_record(plan);
    if (json.empty()) return;
    const CaseType found = type_of_plan(json);
    if (found == type) return;
    throw Error(
        fmt::format("{}: holds the cases of samara {}, which would be overwritten; choose another name for "
                    "the output, or remove the folder",
                    folder.string(), found == CaseType::fall ? "validate" : "bake"));
}

std::set<std::string> made_folders(const fs::path& folder, const Body& body, const BakePlan& plan,
                                   const fs::path& foam_cases) {
    std::set<std::string> made;
    if (!fs::exists(folder)) return made;
    for (const auto& [name, planned] : input_folders(body, plan, foam_cases)) {
        const bool is_mesh = planned.type == FolderType::mesh;
        if (is_mesh && !has_mesh(folder / name)) continue;
        if (is_of_inputs(folder / name / (is_mesh ? "mesh.json" : "provenance.json"), planned.hash))
            made.insert(name);
    }
    return made;
}

void write_case_folder(const fs::path& folder, const Body& body, const BakePlan& plan,
                       const fs::path& foam_cases, Unplanned unplanned) {
    const InputFolders folders = input_folders(body, plan, foam_cases);
    require_known_files(folder, folders);
    fs::create_directories(folder);
    write_body_file(folder / case_body_name, body);
    if (unplanned == Unplanned::removed) remove_unplanned_cases(folder, plan);

    nlohmann::json json = plan_json(plan);
    for (const char* list : {"meshes", "cases", "falls"}) {
        if (!json.contains(list)) continue;
        for (nlohmann::json& entry : json[list]) {
            const auto name = entry["name"].get<std::string>();
            const InputFolder& one = folders.at(name);
            entry["inputs_hash"] = one.hash;
            if (one.type == FolderType::mesh) {
                write_mesh_case(folder / name, one);
            } else {
                write_case(folder / name, one);
            }
        }
    }
    if (!holds(folder / "README", folder_notes)) replace_file_with(folder / "README", folder_notes);
    write_plan(folder / "plan.json", json);
}

namespace {

void append_facet(std::string& text, const Vector3d& a, const Vector3d& b, const Vector3d& c) {
    const auto out = std::back_inserter(text);
    const Vector3d normal = (b - a).cross(c - a).normalized();
    fmt::format_to(out, "  facet normal {:.6g} {:.6g} {:.6g}\n    outer loop\n", normal.x(), normal.y(),
                   normal.z());
    for (const Vector3d* corner : {&a, &b, &c}) {
        fmt::format_to(out, "      vertex {:.9g} {:.9g} {:.9g}\n", corner->x(), corner->y(), corner->z());
    }
    text += "    endloop\n  endfacet\n";
}

}  // namespace

std::string case_surface_stl(const Body& body, const BakePlan& plan) {
    const Surface& surface = body.surface;
    const auto in_case_axes = [&](std::int32_t vertex) -> Vector3d {
        return plan.axes.transpose() *
               (surface.vertices[static_cast<std::size_t>(vertex)] - body.moments.centroid) /
               plan.reference_length;
    };
    std::string text = "solid body\n";
    for (std::size_t triangle = 0; triangle < surface.triangle_count(); ++triangle) {
        const auto& corners = surface.corners[triangle];
        const Vector3d a = in_case_axes(corners[0]);
        const Vector3d b = in_case_axes(corners[1]);
        const Vector3d c = in_case_axes(corners[2]);
        if (surface.order() == 1) {
            append_facet(text, a, b, c);
            continue;
        }
        const auto& middles = surface.edge_nodes[triangle];
        const Vector3d ab = in_case_axes(middles[0]);
        const Vector3d bc = in_case_axes(middles[1]);
        const Vector3d ca = in_case_axes(middles[2]);
        append_facet(text, a, ab, ca);
        append_facet(text, b, bc, ab);
        append_facet(text, c, ca, bc);
        append_facet(text, ab, bc, ca);
    }
    return text + "endsolid body\n";
}

}  // namespace samara

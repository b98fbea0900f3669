#include "foam-cases/farm/case_folder.hpp"

#include <fstream>
#include <map>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "foam-cases/farm/case_parameters.hpp"
#include "foam-cases/farm/case_record.hpp"
#include "foam-cases/farm/case_surface.hpp"
#include "internal/base/content_hash.hpp"
#include "internal/files/replace_file.hpp"
#include "internal/files/share_folder.hpp"
#include "samara/base/error.hpp"
#include "samara/body/body_file.hpp"

namespace samara {
namespace {

namespace fs = std::filesystem;

// What the scripts in a case share with those of the farm, beside the foam_cases; a copy goes into each case.
// It says how files are read and faults are worded, and so is no input of a solution.
constexpr const char* helper_file = "case_files.py";

// What stands in the folder for who opens or copies its cases.
constexpr const char* folder_notes =
    "OpenFOAM cases and their meshes, by samara (docs/bake.md, docs/file-formats.md). ParaView opens each by "
    "its file\n"
    "case.foam. The folder may be moved and copied as a whole: no link leads out of it. A case's mesh is a "
    "link to the\n"
    "mesh's own folder beside it; to copy one case alone take 'cp -rL CASE ELSEWHERE', which copies the mesh "
    "too.\n";

// What a fall's case has from the flow's: the fluid and its turbulence.
constexpr const char* shared_files[] = {"0.orig/k",
                                        "0.orig/epsilon",
                                        "0.orig/omega",
                                        "0.orig/gammaInt",
                                        "0.orig/ReThetat",
                                        "0.orig/nut",
                                        "constant/transportProperties",
                                        "constant/turbulenceProperties"};

using CaseFiles = std::map<fs::path, std::string>;  // content by the path inside a case

// What the mesh depends on beside the parameters of the mesh.
constexpr const char* mesh_files[] = {"Allrun",
                                      "constant/triSurface/body.stl",
                                      "system/blockMeshDict",
                                      "system/snappyHexMeshDict",
                                      "system/surfaceFeatureExtractDict",
                                      "system/topoSetDict"};

CaseFiles read_template(const fs::path& folder) {
    CaseFiles files;
    for (const auto& entry : fs::recursive_directory_iterator(folder)) {
        // What Python compiled is no part of a case.
        if (entry.is_regular_file() && entry.path().parent_path().filename() != "__pycache__") {
            files[fs::relative(entry.path(), folder)] = read_bytes(entry.path());
        }
    }
    if (!files.contains("parameters") || !files.contains("Allrun")) {
        throw Error(fmt::format("{}: is no case template: it needs the files parameters and Allrun",
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
            // Not synced one by one: a file that a crash cut short differs, and is written again.
            std::ofstream file(path, std::ios::binary);
            file << bytes;
            if (!file.flush()) throw Error(fmt::format("{}: cannot be written", path.string()));
        }
        // Also where the file is whole: a kill may have come between the two.
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

// Removes a record that belongs to other inputs, or that cannot be read; says whether it did.
bool discard_stale(const fs::path& record, const std::string& hash) {
    if (!fs::exists(record)) return false;
    const nlohmann::json json = read_record(record);
    return (json.empty() || text_in(json, "inputs_hash") != hash) && fs::remove(record);
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

std::string write_mesh_case(const fs::path& folder, const CaseFiles& template_files, const std::string& stl,
                            const FlowMesh& mesh) {
    CaseFiles files = template_files;
    files["parameters"] = mesh_case_parameters(files.at("parameters"), mesh);
    files["constant/triSurface/body.stl"] = stl;
    const std::string hash = mesh_hash(files);
    // A mesh that was removed since is made again.
    const std::string needed = fs::exists(folder / "constant/polyMesh/cellZones") ? hash : "";
    discard_stale(folder / "mesh.json", needed);
    discard_stale(folder / "failed.json", hash);
    write_files(folder, files);
    write_foam_file(folder);
    return hash;
}

void write_case(const fs::path& folder, const CaseFiles& files, const std::string& mesh,
                const std::string& hash) {
    const bool solved_before = discard_stale(folder / "provenance.json", hash);
    const bool failed_before = discard_stale(folder / "failed.json", hash);
    if (solved_before || failed_before) {
        // Its histories would pass for progress, and the record of how they came about is of no use without
        // them.
        for (const char* name : {"postProcessing", "rounds.json", "attempts.json"})
            fs::remove_all(folder / name);
    }
    write_files(folder, files);
    write_foam_file(folder);
    link_to_mesh(folder, mesh, "polyMesh");
}

void write_falls(const fs::path& folder, const BakePlan& plan, const CaseFiles& body_flow,
                 const fs::path& foam_cases, const std::map<std::string, std::string>& mesh_hashes,
                 nlohmann::json& json) {
    const CaseFiles fall_template = read_template(foam_cases / "templates/free-fall");
    for (std::size_t i = 0; i < plan.falls.size(); ++i) {
        const FreeFall& fall = plan.falls[i];
        CaseFiles files = fall_template;
        for (const char* name : shared_files) files[name] = body_flow.at(name);
        files["parameters"] = fall_parameters(files.at("parameters"), plan, fall);
        files["fall.json"] = free_fall_json(fall);
        const std::string hash = content_hash(mesh_hashes.at(fall.mesh) + hash_of(files));
        json[i]["inputs_hash"] = hash;
        write_case(folder / fall.name, files, fall.mesh, hash);
    }
}

}  // namespace

fs::path foam_cases_folder() {
    return find_share_folder({"foam-cases", "the case templates", "SAMARA_FOAM_CASES", "farm/Snakefile",
                              SAMARA_FOAM_CASES_SOURCE});
}

void require_cases_of(CaseKind kind, const fs::path& folder) {
    const fs::path plan = folder / "plan.json";
    const nlohmann::json json = read_record(plan);
    if (json.empty()) return;
    const CaseKind found = kind_of_plan(json);
    if (found == kind) return;
    throw Error(fmt::format(
        "{}: holds the cases of samara {}, which would be lost; choose another name for the output, "
        "or remove the folder",
        folder.string(), found == CaseKind::fall ? "validate" : "bake"));
}

void write_case_folder(const fs::path& folder, const Body& body, const BakePlan& plan,
                       const fs::path& foam_cases, Unplanned unplanned) {
    const CaseFiles template_files = read_template(foam_cases / "templates/body-flow");
    fs::create_directories(folder);
    write_body_file(folder / case_body_name, body);
    if (unplanned == Unplanned::removed) remove_unplanned_cases(folder, plan);

    nlohmann::json json = plan_json(plan);
    const std::string stl = case_surface_stl(body, plan);
    std::map<std::string, std::string> hashes;  // of the inputs, by the name of the mesh or case
    const std::vector<FlowMesh> meshes = plan.all_meshes();
    for (std::size_t i = 0; i < meshes.size(); ++i) {
        const FlowMesh& mesh = meshes[i];
        hashes[mesh.name] = write_mesh_case(folder / mesh.name, template_files, stl, mesh);
        json["meshes"][i]["inputs_hash"] = hashes[mesh.name];
    }
    for (std::size_t i = 0; i < plan.cases.size(); ++i) {
        const BakeCase& entry = plan.cases[i];
        CaseFiles files = template_files;
        files["parameters"] = case_parameters(files.at("parameters"), plan, entry);
        const std::string start = entry.start_from.empty() ? "" : hashes.at(entry.start_from);
        const std::string hash = content_hash(hashes.at(entry.mesh) + start + hash_of(files));
        hashes[entry.name] = hash;
        json["cases"][i]["inputs_hash"] = hash;
        write_case(folder / entry.name, files, entry.mesh, hash);
        link_to_mesh(folder / entry.name, entry.mesh, "triSurface");
    }
    if (!plan.falls.empty()) write_falls(folder, plan, template_files, foam_cases, hashes, json["falls"]);
    if (!holds(folder / "README", folder_notes)) replace_file_with(folder / "README", folder_notes);
    write_plan(folder / "plan.json", json);
}

}  // namespace samara

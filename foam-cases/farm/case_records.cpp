#include "foam-cases/farm/case_records.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <sys/resource.h>

#include "converter/cases/case_reduction.hpp"
#include "samara/core/base/error.hpp"
#include "samara/core/files/content_hash.hpp"
#include "samara/formats/json_text.hpp"

namespace samara {

nlohmann::json read_record(const std::filesystem::path& file) {
    if (!std::filesystem::is_regular_file(file)) return nlohmann::json::object();
    nlohmann::json record = parse_json_or_discard(read_bytes(file));
    return record.is_object() ? record : nlohmann::json::object();
}

std::string text_in(const nlohmann::json& record, const char* name) {
    const auto found = record.find(name);
    return found != record.end() && found->is_string() ? found->get<std::string>() : std::string();
}

double number_in(const nlohmann::json& record, const char* name) {
    const auto found = record.find(name);
    return found != record.end() && found->is_number() ? found->get<double>() : 0.0;
}

namespace {

namespace fs = std::filesystem;

// Adds a record, where it exists.
void add_record(CpuPart& part, const fs::path& file) {
    const nlohmann::json record = read_record(file);
    if (record.empty()) return;
    ++part.count;
    part.seconds += number_in(record, "cpu_seconds");
}

// Returns the solved cases or falls on a mesh.
template <class Entry>
CpuPart solved_on(const std::string& mesh, const std::string& what, const fs::path& folder,
                  const std::vector<Entry>& entries) {
    CpuPart part{fmt::format("{} on {}", what, mesh), 0, 0.0};
    for (const Entry& entry : entries) {
        if (entry.mesh == mesh) add_record(part, folder / entry.name / "provenance.json");
    }
    return part;
}

double seconds(const timeval& time) {
    return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

}  // namespace

CpuAccount cpu_account(const fs::path& folder, const BakePlan& plan) {
    CpuAccount account = {{"meshes", 0, 0.0}};
    for (const FlowMesh& mesh : plan.all_meshes()) {
        add_record(account.front(), folder / mesh.name / "mesh.json");
        for (CpuPart& part : std::vector{solved_on(mesh.name, "cases", folder, plan.cases),
                                         solved_on(mesh.name, "falls", folder, plan.falls)}) {
            if (part.count > 0) account.push_back(std::move(part));
        }
    }
    return account;
}

double cpu_seconds_of(const CpuAccount& account) {
    double sum = 0.0;
    for (const CpuPart& part : account) sum += part.seconds;
    return sum;
}

double cpu_seconds_so_far() {
    double sum = 0.0;
    for (const auto whose : {RUSAGE_SELF, RUSAGE_CHILDREN}) {
        rusage usage{};
        ::getrusage(whose, &usage);
        sum += seconds(usage.ru_utime) + seconds(usage.ru_stime);
    }
    return sum;
}

nlohmann::json account_as_json(const CpuAccount& account) {
    nlohmann::json json = nlohmann::json::array();
    for (const CpuPart& part : account) {
        json.push_back({{"part", part.what}, {"count", part.count}, {"cpu_seconds", part.seconds}});
    }
    return json;
}

std::string account_as_text(const CpuAccount& account) {
    const double all = cpu_seconds_of(account);
    std::string text =
        fmt::format("{:<28} {:>7} {:>9} {:>7}\n", "where the CPU seconds went", "number", "CPU s", "share");
    const auto add = [&](const std::string& what, const std::string& count, double spent) {
        text += fmt::format("  {:<26} {:>7} {:>9.1f} {:>5.0f} %\n", what, count, spent,
                            all > 0.0 ? 100.0 * spent / all : 0.0);
    };
    for (const CpuPart& part : account)
        add(part.what, part.count > 0 ? fmt::format("{}", part.count) : "", part.seconds);
    add("all", "", all);
    return text;
}

namespace {

namespace fs = std::filesystem;

// Measured on the meshes and cases of a sphere's preview, 5,400 and 18,700 cells: fields in binary, histories
// and logs.
constexpr double bytes_of_mesh = 1.5e6;
constexpr double bytes_of_mesh_per_cell = 200.0;
constexpr double bytes_of_case = 3e5;
constexpr double bytes_of_case_per_cell = 270.0;
// Two states are kept; histories and log grow with the steps.
constexpr double bytes_of_fall_per_cell = 600.0;
constexpr double bytes_of_fall_per_step = 2500.0;

}  // namespace

double bytes_to_solve(const fs::path& folder, const BakePlan& plan) {
    double bytes = 0.0;
    const std::vector<FlowMesh> meshes = plan.all_meshes();
    for (std::size_t i = 0; i < meshes.size(); ++i) {
        if (fs::exists(folder / meshes[i].name / "mesh.json")) continue;
        bytes += bytes_of_mesh + bytes_of_mesh_per_cell * plan.cells[i];
    }
    for (const BakeCase& entry : plan.cases) {
        if (is_solved(folder / entry.name)) continue;
        bytes += bytes_of_case + bytes_of_case_per_cell * cells_of(plan, entry.mesh);
    }
    for (const FreeFall& fall : plan.falls) {
        if (is_solved(folder / fall.name)) continue;
        bytes += bytes_of_fall_per_cell * cells_of(plan, fall.mesh) +
                 bytes_of_fall_per_step * fall.duration / fall.time_step;
    }
    return bytes;
}

void require_room(const fs::path& folder, double bytes) {
    std::error_code unknown;
    const auto free = static_cast<double>(fs::space(folder, unknown).available);
    if (unknown || free > 0.5 * bytes) return;
    throw Error(
        fmt::format("{}: the cases need about {:.3g} MB, but {:.3g} MB are free on this disk; free some "
                    "space, or choose another output",
                    folder.string(), 1e-6 * bytes, 1e-6 * free));
}

}  // namespace samara

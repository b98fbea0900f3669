#include "foam-cases/farm/cpu_account.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <sys/resource.h>

#include "foam-cases/farm/case_record.hpp"

namespace samara {
namespace {

namespace fs = std::filesystem;

// Counts a record, where it is there.
void add_record(CpuPart& part, const fs::path& file) {
    const nlohmann::json record = read_record(file);
    if (record.empty()) return;
    ++part.count;
    part.seconds += number_in(record, "cpu_seconds");
}

// The cases or falls on a mesh that are solved.
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

}  // namespace samara

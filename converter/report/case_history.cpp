#include <cstdlib>
#include <fstream>
#include <numbers>
#include <string>

#include "converter/cases/load_fluctuations.hpp"
#include "converter/cases/turbulence_means.hpp"
#include "converter/report/case_parts.hpp"

namespace samara {
namespace {

namespace fs = std::filesystem;

/// Returns the solver's log; an empty path where the folder has none.
fs::path solver_log(const fs::path& folder) {
    for (const char* name : {"log.simpleFoam", "log.pimpleFoam"}) {
        if (fs::exists(folder / name)) return folder / name;
    }
    return {};
}

/// Reads the first residual of the pressure after each "Time = ".
void read_residuals(const fs::path& log, CaseHistory& history) {
    std::ifstream stream(log);
    constexpr std::string_view time = "Time = ";
    constexpr std::string_view residual = "Solving for p, Initial residual = ";
    double now = 0.0;
    bool wanted = false;
    for (std::string line; std::getline(stream, line);) {
        if (line.starts_with(time)) {
            now = std::strtod(line.c_str() + time.size(), nullptr);
            wanted = true;
        } else if (const auto at = line.find(residual); wanted && at != std::string::npos) {
            history.residual_iterations.push_back(now);
            history.residuals.push_back(std::strtod(line.c_str() + at + residual.size(), nullptr));
            wanted = false;
        }
    }
}

}  // namespace

CaseHistory read_case_history(const fs::path& folder, const CasePlan& plan, const PlannedCase& planned) {
    const CaseScales& scales = planned.scales;
    const double force_unit = 0.125 * std::numbers::pi * scales.density * scales.speed * scales.speed *
                              scales.length * scales.length;
    const LoadHistory loads = read_load_history(folder / "postProcessing/forces");
    CaseHistory history{.name = planned.name,
                        .iterations = loads.force.times,
                        .drag = {},
                        .moment = {},
                        .k = {},
                        .residual_iterations = {},
                        .residuals = {}};
    for (const Vector3d& force : loads.force.values) {
        history.drag.push_back(-(plan.to_map_axes() * force).dot(planned.direction) / force_unit);
    }
    for (const Vector3d& moment : loads.moment.values) {
        history.moment.push_back(moment.norm() / (force_unit * scales.length));
    }
    history.moment.resize(history.drag.size());
    const auto has_means = [&](const char* name) {
        return !history_files(folder / "postProcessing" / name, "volFieldValue").empty();
    };
    if (planned.closure != Closure::laminar && (has_means("nearWake") || has_means("shell"))) {
        const TurbulenceHistory turbulence = read_turbulence_history(folder);
        for (const std::vector<double>& row : turbulence.means.rows) {
            history.k.push_back(row[turbulence.k_column] / (scales.speed * scales.speed));
        }
        history.k.resize(history.drag.size());
    }
    read_residuals(solver_log(folder), history);
    return history;
}

}  // namespace samara

#include "foam-cases/farm/unbalanced_falls.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "converter/falls/fall_record.hpp"
#include "foam-cases/farm/case_records.hpp"
#include "samara/commands/shared/print.hpp"
#include "samara/core/files/replace_file.hpp"

namespace samara {

namespace fs = std::filesystem;

std::vector<std::string> restart_unbalanced_falls(const fs::path& folder, const BakePlan& plan) {
    std::vector<std::string> restarted;
    for (const FreeFall& planned : plan.falls) {
        const fs::path own = folder / planned.name;
        if (!fs::exists(own / "provenance.json")) continue;
        nlohmann::json record = read_record(own / "attempts.json");
        if (!record.contains("attempts") || record["attempts"].size() != 1) continue;
        const FallBalance balance = balance_of(read_fall_record(own));
        if (!is_unbalanced(balance)) continue;
        const std::string reason =
            fmt::format("its momenta do not balance: force off by {:.0f} %, moment by {:.0f} %",
                        100.0 * balance.force, 100.0 * balance.moment);
        // fall.py then takes up the next attempt. A kill between the two leaves a fall that is judged again.
        fs::remove(own / "provenance.json");
        record["attempts"].back()["end"] = reason;
        record["verdict"] = nullptr;
        replace_file_with(own / "attempts.json", record.dump(1) + "\n");
        restarted.push_back(
            fmt::format("{}: {}; it is solved again with half the step", planned.name, reason));
    }
    return restarted;
}

std::vector<LeftOutCase> solve_until_balanced(const fs::path& folder, const BakePlan& plan,
                                              const FarmOptions& options, const fs::path& foam_cases) {
    std::vector<LeftOutCase> left_out = solve_cases(folder, plan, options, foam_cases);
    const std::vector<std::string> restarted = restart_unbalanced_falls(folder, plan);
    if (restarted.empty()) return left_out;
    for (const std::string& line : restarted) print_note("{}\n", line);
    return solve_cases(folder, plan, options, foam_cases);
}

}  // namespace samara

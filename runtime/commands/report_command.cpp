// samara report: a bake judged by its body file. Where the baking tools are installed, samara-report runs in
// its place, which also reads the cases.

#include "samara/commands/commands.hpp"
#include "samara/reports/report_program.hpp"

namespace samara {

int report_command(int argc, const char* const* argv) {
    return run_report(argc, argv, {});
}

}  // namespace samara

#include "samara/commands/shared/motion_output.hpp"

#include <array>
#include <filesystem>
#include <string_view>

#include <fmt/format.h>

#include "samara/core/base/error.hpp"
#include "samara/core/body/body_file.hpp"

namespace samara {
namespace {

struct MadeFromMotion {
    std::string_view ending;
    std::string_view command;
};

constexpr std::array<MadeFromMotion, 7> others = {{{".glb", "export"},
                                                   {".usda", "export"},
                                                   {".chan", "export"},
                                                   {".html", "export"},
                                                   {".csv", "export"},
                                                   {".png", "plot"},
                                                   {".svg", "plot"}}};

}  // namespace

void require_motion_file_name(const std::string& output) {
    const std::filesystem::path file = output;
    const std::string ending = file.extension().string();
    for (const MadeFromMotion& other : others) {
        if (ending != other.ending) continue;
        const std::string motion = std::filesystem::path(file).replace_extension(".h5").string();
        throw Error(fmt::format("{}: the output is a motion file; write {}, then 'samara {} {} -o {}'",
                                output, motion, other.command, motion, output));
    }
    if (is_body_file_name(file)) {
        throw Error(fmt::format("{}: is the name of a body file; name the motion file NAME.h5", output));
    }
    if (ending != ".h5") throw Error(fmt::format("{}: the name of a motion file ends in .h5", output));
}

}  // namespace samara

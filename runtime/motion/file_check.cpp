#include "samara/motion/file_check.hpp"

#include <string>

#include <fmt/format.h>

#include "samara/core/base/error.hpp"
#include "samara/core/body/body_file.hpp"
#include "samara/core/files/confined_process.hpp"
#include "samara/core/files/content_hash.hpp"
#include "samara/core/files/hdf5_reader.hpp"
#include "samara/core/wind/wind_file.hpp"
#include "samara/motion/motion_file.hpp"

namespace samara {
namespace {

std::string type_of(const std::filesystem::path& file) {
    const Hdf5Reader reader(file);
    if (reader.has("/surface")) return "body";
    if (reader.has("/bodies")) return "motion";
    if (reader.has("/wind")) return "wind";
    throw Error(fmt::format("{}: is an HDF5 file, but not a body, motion or wind file; give one of these",
                            file.string()));
}

/// Reads all of the file, or all but a motion's poses. Returns its type: "body", "motion" or "wind".
std::string read_through(const std::filesystem::path& file, bool poses) {
    const std::string type = type_of(file);
    if (type == "body") {
        (void)read_body_file(file);
        return type;
    }
    if (type == "wind") {
        (void)read_wind_file(file);
        return type;
    }
    const MotionReader motion(file);
    for (std::size_t i = 0; poses && i < motion.motion().bodies.size(); ++i) {
        motion.for_each_block(i, [](const Motion& /*part*/, const PoseBlock& /*block*/) {});
    }
    return type;
}

CheckedFile check(const InputFile& input, bool poses) {
    const std::filesystem::path& file = input.path();
    const std::string type = check_confined(input, [&] { return read_through(file, poses); });
    if (type != "body" && type != "motion" && type != "wind") {
        throw Error(fmt::format("{}: its reader returned an invalid answer; do not use it", file.string()));
    }
    return {type, has_digest(input)};
}

}  // namespace

CheckedFile check_file(const std::filesystem::path& file) {
    return check(InputFile(file), true);
}

CheckBeforeReading::CheckBeforeReading() {
    if (offers_confinement()) Hdf5Reader::set_check([](const InputFile& file) { (void)check(file, false); });
}

CheckBeforeReading::~CheckBeforeReading() {
    Hdf5Reader::set_check(nullptr);
}

}  // namespace samara

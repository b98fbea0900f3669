#include "samara/commands/shared/load_body.hpp"

#include <csignal>
#include <cstdlib>
#include <fstream>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "samara/commands/shared/subprocess.hpp"
#include "samara/core/base/error.hpp"
#include "samara/core/body/body_file.hpp"
#include "samara/core/files/folders.hpp"
#include "samara/core/files/input_file.hpp"

namespace samara {
namespace {

/// While it lives, Ctrl-C ends the program that is waited for, not this one, which then cleans up. A handler
/// rather than SIG_IGN, since the other program would inherit that.
class InterruptsForTheOther {
  public:
    InterruptsForTheOther() {
        struct sigaction action = {};
        action.sa_handler = [](int) {};
        ::sigaction(SIGINT, &action, &old_);
    }
    ~InterruptsForTheOther() { ::sigaction(SIGINT, &old_, nullptr); }
    InterruptsForTheOther(const InterruptsForTheOther&) = delete;
    InterruptsForTheOther& operator=(const InterruptsForTheOther&) = delete;

  private:
    struct sigaction old_ = {};
};

/// Returns the last line that the program wrote, without its name, which may be that of the command.
std::string last_line(const std::filesystem::path& log) {
    std::ifstream stream(log);
    std::string last;
    for (std::string line; std::getline(stream, line);) {
        if (!line.empty()) last = line;
    }
    constexpr std::string_view name = "samara mesh: ";
    return last.starts_with(name) ? last.substr(name.size()) : last;
}

Body meshed(const std::filesystem::path& shape, const ShapeReading& reading) {
    const auto program = find_program("samara-mesh");
    if (!program) {
        throw Error(
            fmt::format("{}: is a shape, and samara-mesh, which meshes shapes, is not installed; give a "
                        ".body.h5 file, install the package samara-baking, or build with SAMARA_BAKING=ON",
                        shape.string()));
    }
    const TemporaryFolder folder;
    const std::filesystem::path output = folder.path() / (body_name_of(shape) + ".body.h5");
    const std::filesystem::path log = folder.path() / "log";
    std::vector<std::string> words = {program->string(), std::filesystem::absolute(shape).string(), "-o",
                                      output.string()};
    for (const std::string& word : words_of(reading)) words.push_back(word);
    const InterruptsForTheOther guard;
    const int status = run_subprocess(words, log);
    if (status == 128 + SIGINT) throw Error(fmt::format("{}: meshing was interrupted", shape.string()));
    if (status != 0) {
        const std::string reason = last_line(log);
        throw Error(reason.empty() ? fmt::format("{}: cannot be meshed (samara-mesh ended with status {})",
                                                 shape.string(), status)
                                   : reason);
    }
    return naming(shape.string(), output.string(), [&] { return read_body_file(output); });
}

}  // namespace

ShapeReading reading_of(const SceneBody& body) {
    return {.scale = body.scale, .thickness = body.thickness};
}

std::vector<std::string> words_of(const ShapeReading& reading) {
    std::vector<std::string> words;
    if (reading.triangles > 0) words.insert(words.end(), {"--triangles", std::to_string(reading.triangles)});
    if (reading.scale != 1.0) words.insert(words.end(), {"--scale", fmt::format("{}", reading.scale)});
    if (reading.thickness > 0.0) {
        words.insert(words.end(), {"--thickness", fmt::format("{}", reading.thickness)});
    }
    return words;
}

bool is_hdf5(const std::filesystem::path& file) {
    constexpr std::string_view beginning = "\x89HDF\r\n\x1a\n";
    std::string start(beginning.size(), '\0');
    try {
        start.resize(InputFile(file).read_at(0, start.data(), start.size()));
    } catch (const Error&) {
        return false;
    }
    return start == beginning;
}

Body load_body(const std::filesystem::path& body_or_shape, const ShapeReading& reading) {
    const std::string name = body_or_shape.string();
    static_cast<void>(InputFile(body_or_shape));  // which says what is wrong with it
    if (!is_body_file_name(body_or_shape) && !is_hdf5(body_or_shape)) {
        return meshed(body_or_shape, reading);
    }
    if (reading.triangles > 0) {
        throw Error(
            fmt::format("{}: already holds a mesh; leave --triangles out, or give the shape file", name));
    }
    if (reading.scale != 1.0) {
        throw Error(
            fmt::format("{}: is already in metres; leave the scale out, or give the shape file", name));
    }
    if (reading.thickness > 0.0) {
        throw Error(
            fmt::format("{}: is a solid already; leave the thickness out, or give the open sheet", name));
    }
    return read_body_file(body_or_shape);
}

}  // namespace samara

#include "foam-cases/bake/body_preparation.hpp"

#include <sstream>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "samara/commands/shared/subprocess.hpp"
#include "samara/core/base/error.hpp"
#include "samara/core/body/body_file.hpp"
#include "samara/core/files/content_hash.hpp"

namespace samara {
namespace {

namespace fs = std::filesystem;

fs::path require_program(const std::string& name) {
    if (auto program = find_program(name)) return *program;
    throw Error(fmt::format(
        "the program {} is not installed beside this one nor on PATH; install samara again", name));
}

// The last line that a program of samara printed is what went wrong; its own name before it is dropped.
std::string error_in(const fs::path& log, const std::string& program) {
    std::istringstream lines(read_bytes(log));
    std::string last;
    for (std::string line; std::getline(lines, line);) {
        if (!line.empty()) last = line;
    }
    const std::string prefix = program + ": ";
    if (last.empty()) return fmt::format("{} failed without a word", program);
    return last.starts_with(prefix) ? last.substr(prefix.size()) : last;
}

void run_stage(const std::vector<std::string>& words, const fs::path& log, const std::string& program) {
    if (run_subprocess(words, log) != 0) throw Error(error_in(log, program));
}

}  // namespace

Body prepare_body(const fs::path& shape, double scale, const fs::path& folder) {
    if (is_body_file_name(shape)) {
        if (scale != 1.0) {
            throw Error(fmt::format("{}: a body file is in metres and takes no scale; scale the shape file",
                                    shape.string()));
        }
        return read_body_file(shape);
    }
    if (!fs::is_regular_file(shape)) throw Error(fmt::format("{}: there is no such file", shape.string()));
    const fs::path meshed = folder / "shape.body.h5";
    const std::string name = shape.string().starts_with('-') ? "./" + shape.string() : shape.string();
    std::vector<std::string> words = {require_program("samara-mesh").string(), name, "-o", meshed.string()};
    if (scale != 1.0) words.insert(words.end(), {"--scale", fmt::format("{}", scale)});
    run_stage(words, folder / "log.mesh", "samara mesh");
    Body body = naming(shape.string(), meshed.string(), [&] { return read_body_file(meshed); });
    body.name = body_name_of(shape);
    return body;
}

void add_kirchhoff_tensor(Body& body, const fs::path& shape, const fs::path& earlier,
                          const fs::path& folder) {
    if (body.kirchhoff && body.surface_loads) return;
    if (fs::is_regular_file(fs::symlink_status(earlier))) {
        const Body known = read_body_file(earlier);
        if (known.kirchhoff && known.surface_loads &&
            surface_hash(known.surface) == surface_hash(body.surface)) {
            body.kirchhoff = known.kirchhoff;
            body.surface_loads = known.surface_loads;
            return;
        }
    }
    const fs::path file = folder / "kirchhoff.body.h5";
    write_body_file(file, body);
    naming(shape.string(), file.string(), [&] {
        run_stage({require_program("samara").string(), "kirchhoff", file.string(), "-o", file.string()},
                  folder / "log.kirchhoff", "samara kirchhoff");
    });
    const Body solved = read_body_file(file);
    body.kirchhoff = solved.kirchhoff;
    body.surface_loads = solved.surface_loads;
    if (!body.kirchhoff) throw Error(fmt::format("{}: has no Kirchhoff tensor", body.name));
}

}  // namespace samara

// samara check: whether a file from elsewhere is sound, found out in a process of its own.

#include <filesystem>
#include <string>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "samara/commands/commands.hpp"
#include "samara/commands/shared/arguments.hpp"
#include "samara/commands/shared/load_body.hpp"
#include "samara/commands/shared/print.hpp"
#include "samara/core/base/error.hpp"
#include "samara/core/files/content_hash.hpp"
#include "samara/core/files/replace_file.hpp"
#include "samara/motion/file_check.hpp"

namespace samara {
namespace {

/// Checks a file. A shape is checked by meshing: samara-mesh reads it in a process of its own.
CheckedFile check(const std::string& file) {
    if (is_hdf5(file)) return check_file(file);
    (void)load_body(file);
    return {"surface", false};
}

void add_digest(const std::filesystem::path& file) {
    replace_file(file, [&](const std::filesystem::path& temporary) {
        std::filesystem::copy_file(file, temporary, std::filesystem::copy_options::overwrite_existing);
        append_digest(temporary);
    });
}

}  // namespace

int check_command(int argc, const char* const* argv) {
    std::string file;
    bool seal = false;
    Arguments arguments("samara check", "Validates a body, motion, wind or surface file in a sandbox.");
    arguments.positional("FILE", file, "body file (.body.h5), motion or wind file (.h5), or shape");
    arguments.flag("--add-digest", seal,
                   "append a digest of the content to a valid body, motion or wind file that has none");
    arguments.footer(
        "Exit status 0: the file is valid. 1: it is rejected, or its reader crashed, took too long or too "
        "much\n"
        "memory. JSON: kind (body, motion, wind or surface), digest (true if the file has a correct one).");
    return run_program(argc, argv, arguments, [&] {
        CheckedFile found = check(file);
        if (seal && found.kind == "surface")
            throw Error(fmt::format("{}: a shape cannot have a digest; leave --add-digest out", file));
        if (seal && !found.has_digest) {
            add_digest(file);
            found.has_digest = true;
        }
        if (!arguments.json()) {
            print_result("{}: a valid {}{}\n", file, found.kind,
                         found.kind == "surface" ? ""
                         : found.has_digest      ? " file, with a digest of its content"
                                                 : " file, without a digest (--add-digest writes one)");
        }
        return nlohmann::json{{"kind", found.kind}, {"digest", found.has_digest}};
    });
}

}  // namespace samara

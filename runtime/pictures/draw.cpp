#include "samara/pictures/draw.hpp"

#include <cstdlib>
#include <fstream>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "samara/commands/shared/subprocess.hpp"
#include "samara/core/base/error.hpp"
#include "samara/core/base/text.hpp"
#include "samara/core/files/content_hash.hpp"
#include "samara/core/files/folders.hpp"
#include "samara/core/files/replace_file.hpp"
#include "samara/formats/json_text.hpp"

namespace samara {
namespace {

namespace fs = std::filesystem;

constexpr int module_missing = 3;  // exit status of draw.py

/// Returns the interpreters to try: the system's, which has what apt installs, before that of PATH.
std::vector<fs::path> interpreters() {
    const char* chosen = std::getenv("SAMARA_PYTHON");
    if (chosen != nullptr && *chosen != '\0') {
        const auto found = find_program(chosen);
        if (found) return {*found};
        throw Error(fmt::format(
            "SAMARA_PYTHON names {}, which is not a program; unset it, or name a python3 with matplotlib",
            chosen));
    }
    std::vector<fs::path> found;
    std::error_code unknown;
    if (fs::exists("/usr/bin/python3", unknown)) found.emplace_back("/usr/bin/python3");
    if (const auto on_path = find_program("python3")) found.push_back(*on_path);
    return found;
}

/// Makes all texts printable(): names are no commands to whoever shows them.
void make_printable(nlohmann::json& value) {
    if (value.is_string()) value = printable(value.get<std::string>());
    if (!value.is_structured()) return;
    for (nlohmann::json& part : value) make_printable(part);
}

std::string last_line(const std::string& text) {
    const std::size_t end = text.find_last_not_of(" \n");
    if (end == std::string::npos) return "";
    const std::size_t begin = text.rfind('\n', end);
    return text.substr(begin == std::string::npos ? 0 : begin + 1, end - begin);
}

/// Runs draw.py on a job in `folder` by the first interpreter that has its modules.
void run_python(const TemporaryFolder& folder, const char* what, const fs::path& output) {
    const fs::path modules =
        find_share_folder({"python", "the modules that draw pictures", "SAMARA_PYTHON_MODULES",
                           "samara/draw.py", SAMARA_PYTHON_SOURCE});
    std::string missing = "matplotlib";
    for (const fs::path& python : interpreters()) {
        const int status = run_subprocess({python, "-I", "-B", modules / "samara/draw.py",
                                           folder / "job.json", fs::absolute(output), folder / "shown.json"},
                                          folder / "messages", folder.path());
        if (status == 0 && !fs::is_empty(output)) return;
        const std::string reason = last_line(read_bytes(folder / "messages"));
        if (status != module_missing) {
            throw Error(fmt::format("{} failed to make {}: {}", python.string(), what,
                                    reason.empty() ? "no reason was given" : reason));
        }
        missing = reason;
    }
    throw Error(
        fmt::format("{} needs Python's {}, which is not installed: apt install python3-matplotlib "
                    "python3-jinja2, or name a python3 that has both in SAMARA_PYTHON",
                    what, missing));
}

nlohmann::json draw(const fs::path& file, nlohmann::json job, const char* what) {
    make_printable(job);
    const TemporaryFolder folder;
    std::ofstream stream(folder / "job.json");
    stream << job.dump(-1, ' ', true, nlohmann::json::error_handler_t::replace);
    stream.close();
    if (!stream) throw Error(fmt::format("{}: cannot be written", (folder / "job.json").string()));
    replace_file(file, [&](const fs::path& temporary) { run_python(folder, what, temporary); });
    return parse_json(read_bytes(folder / "shown.json"));
}

}  // namespace

nlohmann::json draw_picture(const fs::path& file, nlohmann::json picture) {
    const char* format = file.extension() == ".svg" ? "svg" : "png";
    return draw(file, {{"format", format}, {"picture", std::move(picture)}}, "the picture");
}

void draw_page(const fs::path& file, nlohmann::json page) {
    draw(file, {{"format", "html"}, {"page", std::move(page)}}, "the page");
}

void require_picture_format(const fs::path& file) {
    const std::string format = file.extension().string();
    if (format == ".png" || format == ".svg") return;
    throw Error(
        fmt::format("{}: the format '{}' is unknown; end the name in .png or .svg", file.string(), format));
}

}  // namespace samara

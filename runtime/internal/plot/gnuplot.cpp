#include "samara/internal/plot/gnuplot.hpp"

#include <fstream>

#include <fmt/format.h>

#include "samara/commands/shared/subprocess.hpp"
#include "samara/core/base/error.hpp"
#include "samara/core/files/content_hash.hpp"
#include "samara/core/files/replace_file.hpp"
#include "samara/core/files/temporary_folder.hpp"
#include "samara/internal/plot/canvas.hpp"

namespace samara {
namespace {

std::string preamble(bool as_svg) {
    return "set encoding utf8\nset minussign\n" + terminal(as_svg) +
           "set output ARG1\n"
           "set border 3 lw 1.5 lc rgb '#808080'\n"
           "set tics nomirror out scale 0.6 textcolor rgb '#1a1a1a'\n"
           "set grid lw 1 lt 1 lc rgb '#e4e4e4'\n"
           "unset key\n";
}

std::string last_line(const std::string& text) {
    const std::size_t end = text.find_last_not_of(" \n");
    if (end == std::string::npos) return "it gave no reason";
    const std::size_t begin = text.rfind('\n', end);
    return text.substr(begin == std::string::npos ? 0 : begin + 1, end - begin);
}

void run_gnuplot(const std::string& script, const std::filesystem::path& output) {
    const auto gnuplot = find_program("gnuplot");
    if (!gnuplot) {
        throw Error(
            "gnuplot is not installed, which draws the pictures; install it, on Debian by 'apt install "
            "gnuplot-nox'");
    }
    const TemporaryFolder folder;
    std::ofstream stream(folder / "plot.gnuplot");
    stream << script;
    stream.close();
    if (!stream) throw Error(fmt::format("{}: cannot be written", (folder / "plot.gnuplot").string()));
    const int status = run_subprocess(
        {gnuplot->string(), "--default-settings", "-c", (folder / "plot.gnuplot").string(), output.string()},
        folder / "messages");
    if (status != 0 || std::filesystem::is_empty(output)) {
        throw Error(fmt::format("gnuplot failed: {}", last_line(read_bytes(folder / "messages"))));
    }
}

}  // namespace

void draw_picture(const std::filesystem::path& file, const std::string& commands) {
    const std::string script = preamble(file.extension() == ".svg") + commands;
    replace_file(file, [&](const std::filesystem::path& temporary) { run_gnuplot(script, temporary); });
}

void require_picture_format(const std::filesystem::path& file) {
    const std::string format = file.extension().string();
    if (format == ".png" || format == ".svg") return;
    throw Error(
        fmt::format("{}: the format '{}' is unknown; end the name in .png or .svg", file.string(), format));
}

}  // namespace samara

// The pictures of docs/speed-against-error, drawn from their tables as SVG: what holds for that holds for the
// PNG, whose letters gnuplot gives the same size in points.

#include <regex>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "paths.hpp"
#include "samara/commands/shared/subprocess.hpp"
#include "samara/core/files/content_hash.hpp"
#include "support/picture_faults.hpp"
#include "support/temporary_folder.hpp"

namespace samara {
namespace {

using std::filesystem::path;

const path documents = path(SAMARA_SOURCE_DIRECTORY) / "docs/speed-against-error";

std::vector<std::string> names_of_pictures() {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(documents)) {
        if (entry.path().extension() == ".gp") names.push_back(entry.path().stem());
    }
    std::sort(names.begin(), names.end());
    return names;
}

/// The script with an SVG of the same size and type in place of the PNG. SVG counts letters in pixels.
std::string as_svg(const std::string& script) {
    static const std::regex terminal(R"(set terminal pngcairo (size \d+, \d+) font "DejaVu Sans,(\d+)\")");
    std::smatch found;
    if (!std::regex_search(script, found, terminal)) throw std::runtime_error("no terminal is set");
    return found.prefix().str() +
           fmt::format("set terminal svg {} font \"DejaVu Sans,{:.4g}\"", found[1].str(),
                       std::stod(found[2]) * 4.0 / 3.0) +
           found.suffix().str();
}

class DocsPicture : public testing::TestWithParam<std::string> {};

TEST_P(DocsPicture, CanBeReadOff) {
    const test::TemporaryFolder folder;
    const path script = folder.file("picture.gp", as_svg(read_bytes(documents / (GetParam() + ".gp"))));
    const std::string names =
        fmt::format("rows='{}'; picture='{}'", (documents / (GetParam() + ".csv")).string(),
                    (folder / "picture.svg").string());
    ASSERT_EQ(run_subprocess({"gnuplot", "-e", names, script}, folder / "log"), 0)
        << read_bytes(folder / "log");
    EXPECT_THAT(read_bytes(folder / "log"), testing::IsEmpty());
    EXPECT_THAT(test::faults_of(test::read_svg(folder / "picture.svg")), testing::IsEmpty());
}

INSTANTIATE_TEST_SUITE_P(All, DocsPicture, testing::ValuesIn(names_of_pictures()),
                         [](const auto& one) { return one.param; });

}  // namespace
}  // namespace samara

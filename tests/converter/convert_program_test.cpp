// The program samara-convert.
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "converted_box.hpp"
#include "paths.hpp"
#include "samara/commands/shared/subprocess.hpp"
#include "samara/core/body/body_file.hpp"
#include "samara/core/files/content_hash.hpp"
#include "support/temporary_folder.hpp"

namespace samara {
namespace {

using testing::EndsWith;
using testing::HasSubstr;

/// Runs samara-convert; returns its exit status and output.
class ConvertProgram : public test::ConvertedBox {
  protected:
    std::pair<int, std::string> run(std::vector<std::string> words) const {
        words.insert(words.begin(), std::string(SAMARA_PROGRAMS) + "/samara-convert");
        const std::filesystem::path output = scratch_.path() / "output";
        const int status = run_subprocess(words, output);
        return {status, read_bytes(output)};
    }

    test::TemporaryFolder scratch_;
};

TEST_F(ConvertProgram, WritesTheBodyFileAndOneJsonObject) {
    const std::string file = scratch_.path() / "b.body.h5";
    const auto [status, text] = run({folder_.path().string(), "-o", file, "--json"});
    ASSERT_EQ(status, 0) << text;
    const nlohmann::json result = nlohmann::json::parse(text);
    EXPECT_EQ(result["cases"].size(), 12U);
    EXPECT_EQ(result["nodes"], 50);
    EXPECT_NEAR(result["cases"][0]["drag_coefficient"].get<double>(), 2.0 * 0.6, 1e-9);
    EXPECT_EQ(result["reynolds_numbers"], (nlohmann::json{1e3, 1e4}));
    const Body body = read_body_file(file);
    ASSERT_TRUE(body.tables);
    EXPECT_NEAR(look_up(*body.tables, Vector3d::UnitZ(), 1e4).force.z(), -1.1 * 1.9, 1e-9);
}

TEST_F(ConvertProgram, EqualCasesGiveEqualTablesToTheLastBit) {
    const std::string file = scratch_.path() / "a.body.h5";
    ASSERT_EQ(run({folder_.path().string(), "-o", file}).first, 0);
    const LoadTables written = read_body_file(file).tables.value();
    const LoadTables again = convert_folder(folder_.path()).body.tables.value();
    ASSERT_EQ(written.entries.size(), again.entries.size());
    for (std::size_t i = 0; i < again.entries.size(); ++i) {
        EXPECT_EQ(test::difference(written.entries[i], again.entries[i]), 0.0);
        EXPECT_EQ(test::difference(written.errors[i], again.errors[i]), 0.0);
    }
    EXPECT_EQ(written.provenance, again.provenance);
}

TEST_F(ConvertProgram, PrintsATableWithErrors) {
    const auto [status, text] = run({folder_.path().string(), "-o", scratch_.path() / "b.body.h5"});
    ASSERT_EQ(status, 0) << text;
    EXPECT_THAT(text, HasSubstr("12 solved cases -> 50 table nodes"));
    EXPECT_THAT(text, HasSubstr("(1.0000, 0.0000, 0.0000)"));
    EXPECT_THAT(text, HasSubstr("1.200 +- 0.012"));
}

TEST_F(ConvertProgram, AnswersForeignFoldersWithOneLine) {
    const std::string output = scratch_.path() / "b.body.h5";
    for (const std::string& folder : {scratch_.path().string(), std::string("/no/such/folder")}) {
        const auto [status, text] = run({folder, "-o", output});
        EXPECT_EQ(status, 1);
        EXPECT_THAT(text, testing::StartsWith("samara convert: " + folder + ": is not a folder"));
        EXPECT_THAT(text, EndsWith("give the folder NAME.cases that 'samara bake' made\n"));
    }
    EXPECT_FALSE(std::filesystem::exists(output));
    const auto [status, text] = run({folder_.path().string(), "-o", "b.h5"});
    EXPECT_EQ(status, 1);
    EXPECT_THAT(text, HasSubstr("name it NAME.body.h5"));
}

}  // namespace
}  // namespace samara

#include "samara/core/files/folders.hpp"

#include <cstdlib>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/expect_error.hpp"
#include "support/temporary_folder.hpp"

namespace samara {
namespace {

using testing::HasSubstr;

class FoundShareFolder : public testing::Test {
  protected:
    FoundShareFolder() { std::filesystem::create_directories(folder_ / "source/farm"); }
    ~FoundShareFolder() override { ::unsetenv(variable); }

    [[nodiscard]] std::filesystem::path found(const char* mark) const {
        return find_share_folder({"none-such", "the parts", variable, mark, source_.c_str()});
    }
    [[nodiscard]] std::string error(const char* mark) const {
        return test::error_of([&] { static_cast<void>(found(mark)); });
    }

    static constexpr const char* variable = "SAMARA_PARTS_OF_THIS_TEST";
    const test::TemporaryFolder folder_;
    const std::string source_ = (folder_ / "source").string();
};

TEST_F(FoundShareFolder, IsInTheSourcesWhereNoneIsInstalled) {
    EXPECT_EQ(found(""), source_);
    EXPECT_EQ(found("farm"), source_);
}

TEST_F(FoundShareFolder, IsTheOneThatTheEnvironmentNames) {
    ::setenv(variable, folder_.path().c_str(), 1);
    EXPECT_EQ(found("source"), folder_.path());
    EXPECT_THAT(error("farm"), HasSubstr("which holds no farm; unset it, or name the folder of the parts"));
    ::setenv(variable, "nowhere", 1);
    EXPECT_THAT(error(""),
                HasSubstr("SAMARA_PARTS_OF_THIS_TEST names nowhere, which is not a folder; unset"));
    ::setenv(variable, "", 1);
    EXPECT_EQ(found(""), source_);
}

TEST_F(FoundShareFolder, IsMissedWithTheRemedy) {
    EXPECT_THAT(error("Snakefile"),
                testing::AllOf(HasSubstr("share/samara/none-such: the parts are not installed there"),
                               HasSubstr("or name their folder in SAMARA_PARTS_OF_THIS_TEST")));
}

}  // namespace
}  // namespace samara

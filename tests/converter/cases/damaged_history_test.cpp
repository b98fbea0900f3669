// Histories of a solved case that were damaged afterwards: each error is reported in one line that names
// file, time and remedy, and none is averaged.

#include <numbers>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "converter/cases/case_reduction.hpp"
#include "load_laws.hpp"
#include "samara/core/files/content_hash.hpp"
#include "solved_folder.hpp"
#include "support/expect_error.hpp"

namespace samara {
namespace {

using testing::EndsWith;
using testing::HasSubstr;

const std::string forces = "case_01/postProcessing/forces/";
const std::string means = "case_01/postProcessing/nearWake/";
const std::vector<std::string> history_names = {forces + "0/force.dat", forces + "0/moment.dat",
                                                means + "0/volFieldValue.dat"};

/// Six cases, solved in two runs: from 0, and from 14 on to 20. The means are of the times from 10 on.
class DamagedHistory : public testing::Test {
  protected:
    void SetUp() override {
        for (const std::string& name : history_names) {
            const std::string text = text_of(name);
            const std::size_t later = text.find("\n15\t") + 1;
            folder_.write(name, text.substr(0, later));
            folder_.write(in_second_run(name), text.substr(0, text.find("\n1\t") + 1) + text.substr(later));
        }
        ASSERT_EQ(reduced().size(), 6U);
    }

    [[nodiscard]] static std::string in_second_run(std::string name) {
        return name.replace(name.find("/0/"), 3, "/14/");
    }
    [[nodiscard]] std::string text_of(const std::string& name) const {
        return read_bytes(folder_.path() / name);
    }
    [[nodiscard]] std::vector<SolvedCase> reduced() const {
        return reduce_folder(folder_.path(), read_case_plan(folder_.path())).cases;
    }
    [[nodiscard]] std::string error() const {
        const std::string message = test::error_of([&] { static_cast<void>(reduced()); });
        EXPECT_EQ(message.find('\n'), std::string::npos) << message;
        return message;
    }
    /// The row of a time, with the values of all columns.
    void set_row(const std::string& name, int time, const std::string& values) const {
        std::string text = text_of(name);
        const std::size_t begin = text.find(fmt::format("\n{}\t", time)) + 1;
        const std::size_t end = text.find('\n', begin) + 1;
        folder_.write(name, text.replace(begin, end - begin,
                                         values.empty() ? "" : fmt::format("{}\t{}\n", time, values)));
    }
    /// provenance.json as the check of a solution writes it.
    void note_means() const {
        const LoadEntry entry = reduced().at(1).sample.entry;
        const Vector3d force = std::numbers::pi / 8.0 * entry.force;
        const Vector3d moment = std::numbers::pi / 8.0 * entry.moment;
        const nlohmann::json noted = {
            {"closure", "kEpsilon"},
            {"averaging_start", 10},
            {"force", {force.x(), force.y(), force.z()}},
            {"moment", {moment.x(), moment.y(), moment.z()}},
            {"near_wake", {{"k", entry.turbulent_kinetic_energy}, {"epsilon", entry.dissipation_rate}}}};
        folder_.write("case_01/provenance.json", noted.dump());
    }

    test::SolvedFolder folder_{test::box_body(Vector3d(0.01, 0.02, 0.04)), 2, {1e4}, test::box_law};
};

TEST_F(DamagedHistory, OneAbsurdValueIsNamedByFileAndTime) {
    const std::string file = in_second_run(history_names[2]);
    const std::string whole = text_of(file);
    set_row(file, 17, "0.014 1e20");
    EXPECT_EQ(error(), (folder_.path() / file).string() +
                           ": the epsilon is 1e+20 at the time 17, above the largest plausible value (1000): "
                           "diverged or damaged; remove the folder case_01 and run 'samara bake' again");
    folder_.write(file, whole);
    set_row(file, 17, "-0.014 0.02");
    EXPECT_THAT(error(),
                HasSubstr("14/volFieldValue.dat: the k is -0.014 at the time 17, but cannot be negative"));
    folder_.write(file, whole);
    set_row(file, 17, "14 0.02");
    EXPECT_THAT(error(), HasSubstr("the k is 14 at the time 17, far from the others (about 0.012"));
}

TEST_F(DamagedHistory, OneAbsurdForceOrMomentIsNamedByFileAndTime) {
    for (const std::string& name : {history_names[0], history_names[1]}) {
        const std::string whole = text_of(name);
        for (const char* value : {"1e20", "30"}) {
            set_row(name, 12, fmt::format("({} 0 0) (0 0 0) (0 0 0)", value));
            EXPECT_THAT(error(), HasSubstr((folder_.path() / name).string() + ": the ")) << value;
            EXPECT_THAT(error(), HasSubstr(" at the time 12, "));
        }
        for (const char* value : {"nan", "1e400"}) {
            set_row(name, 12, fmt::format("({} 0 0) (0 0 0) (0 0 0)", value));
            EXPECT_THAT(error(), HasSubstr("case_01: diverged: " + name.substr(8) + " holds ")) << value;
        }
        folder_.write(name, whole);
    }
}

TEST_F(DamagedHistory, AFileOfTheLastRunThatIsEmptiedOrMissingIsNamed) {
    for (const std::string& name : history_names) {
        const std::string file = in_second_run(name);
        const std::string whole = text_of(file);
        for (const std::string& left : {std::string(), whole.substr(0, whole.find("\n15\t") + 1)}) {
            folder_.write(file, left);
            EXPECT_THAT(error(), HasSubstr(" at the time 15, but ")) << file;
            EXPECT_THAT(error(), HasSubstr((folder_.path() / name).parent_path().parent_path().string()));
        }
        std::filesystem::remove(folder_.path() / file);
        EXPECT_THAT(error(), HasSubstr("it was emptied or truncated, or its run's file is missing; remove"));
        folder_.write(file, whole);
    }
    EXPECT_EQ(reduced().size(), 6U);
}

TEST_F(DamagedHistory, ALastRunWithoutAnyHistoryIsFoundByItsFields) {
    for (const std::string& name : history_names) folder_.write(in_second_run(name), "");
    EXPECT_THAT(error(), HasSubstr("case_01: the fields were last written at the time 20"));
    folder_.replace("case_01/provenance.json", "kEpsilon", "laminar");
    EXPECT_THAT(error(),
                HasSubstr("case_01: the fields were last written at the time 20, but postProcessing/forces "
                          "ends at the time 14"));
}

TEST_F(DamagedHistory, TimesThatAreMissingFromAllAreAGap) {
    for (const std::string& name : history_names) {
        set_row(name, 12, "");
        set_row(name, 13, "");
    }
    EXPECT_THAT(error(), HasSubstr("0/force.dat: has nothing between the times 11 and 14"));
}

TEST_F(DamagedHistory, ACopyOfAnotherRunIsRejected) {
    folder_.write(forces + "16/force.dat", text_of(in_second_run(history_names[0])));
    EXPECT_THAT(error(), EndsWith("forces/16/force.dat: begins at the time 15, before its folder's start "
                                  "time, so it belongs to another run; remove it"));
}

TEST_F(DamagedHistory, AnyChangeSinceTheCaseWasSolvedIsFoundByTheMeansThatWereNoted) {
    note_means();
    ASSERT_EQ(reduced().size(), 6U);
    for (const std::string& name : history_names) {
        const std::string whole = text_of(name);
        const std::string row = whole.substr(whole.find("\n13\t") + 4);
        std::string values = row.substr(0, row.find('\n'));
        // The first digit that is not zero.
        const std::size_t digit = values.find_first_of("123456789");
        if (digit == std::string::npos) continue;
        values[digit] = values[digit] == '1' ? '2' : '1';
        set_row(name, 13, values);
        EXPECT_THAT(error(), HasSubstr("case_01: the mean ")) << name;
        EXPECT_THAT(error(), HasSubstr("since the case was solved")) << name;
        folder_.write(name, whole);
    }
    folder_.write("case_01/provenance.json", R"({"averaging_start": 10, "force": [1, "x", 2]})");
    EXPECT_THAT(error(), HasSubstr("case_01: in provenance.json an entry is missing or of the wrong type"));
}

}  // namespace
}  // namespace samara

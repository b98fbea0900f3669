// What is wrong with a folder of cases or its plan, in one line.
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <sys/stat.h>

#include "converted_box.hpp"
#include "converter/openfoam/foam_history.hpp"
#include "samara/core/body/body_file.hpp"
#include "samara/core/files/content_hash.hpp"
#include "support/temporary_folder.hpp"

namespace samara {
namespace {

using testing::EndsWith;
using testing::HasSubstr;
using ConvertRejections = test::ConvertedBox;

TEST_F(ConvertRejections, NamesTheCaseThatDiverged) {
    const std::filesystem::path forces = "case_02/postProcessing/forces/0/force.dat";
    const std::string text = read_bytes(folder_.path() / forces);
    folder_.write(forces, text.substr(0, text.rfind("20\t(")) + "20\t(nan nan nan)\t(0 0 0)\t(0 0 0)\n");
    EXPECT_THAT(
        error(),
        HasSubstr("case_02: diverged: postProcessing/forces/0/force.dat holds nan at the time 20; remove"));
}

TEST_F(ConvertRejections, RejectsThrust) {
    std::string rows = "# Time total_x total_y total_z\n";
    for (int i = 1; i <= 20; ++i) rows += fmt::format("{} 1 0 0\n", i);
    folder_.write("case_00/postProcessing/forces/0/force.dat", rows);
    EXPECT_THAT(error(), HasSubstr("case_00: diverged: the drag coefficient is -2.546, not positive"));
}

TEST_F(ConvertRejections, RejectsFieldsAndHistoriesOfDifferentRuns) {
    std::string rows = "# Time weightedVolAverage(k) weightedVolAverage(epsilon)\n";
    for (int i = 1; i <= 20; ++i) rows += fmt::format("{} 1 1\n", i);
    folder_.write("case_01/postProcessing/nearWake/0/volFieldValue.dat", rows);
    EXPECT_THAT(error(), HasSubstr("case_01: the mean k over the near wake at the time 20 is"));
    EXPECT_THAT(error(), HasSubstr("they are from different runs"));
}

TEST_F(ConvertRejections, RejectsCasesOfAnotherDirectionOrReynoldsNumberThanPlanned) {
    folder_.replace("case_01/parameters", "reynoldsNumber 1000", "reynoldsNumber 2000");
    EXPECT_THAT(error(),
                HasSubstr("case_01: was solved for the Reynolds number 2000, but plan.json has 1000"));
    folder_.replace("case_00/parameters", "direction (1 ", "direction (-1 ");
    EXPECT_THAT(error(),
                HasSubstr("case_00: was solved for the direction (-1, 0, 0), but plan.json has (1, 0, 0)"));
}

TEST_F(ConvertRejections, RejectsCasesWhoseKIsOfDifferentMeans) {
    folder_.replace("case_01/postProcessing/nearWake/0/volFieldValue.dat", "weightedVolAverage(k)",
                    "volAverage(k)");
    folder_.replace("case_01/postProcessing/nearWake/0/volFieldValue.dat", "weightedVolAverage(epsilon)",
                    "volAverage(epsilon)");
    std::filesystem::rename(folder_.path() / "case_01/postProcessing/nearWake",
                            folder_.path() / "case_01/postProcessing/shell");
    folder_.replace("mesh/constant/polyMesh/cellZones", "1\n(\nnearWake",
                    "2\n(\nshell\n{\n    type cellZone;\ncellLabels "
                    "List<label> 2(1 4);\n}\nnearWake");
    // Of (1.5, 0.5) m in cells of volumes 1 and 3 the mean by volume is 0.75 m.
    std::string rows = "# Time volAverage(k) volAverage(epsilon)\n";
    const FoamHistory whole =
        read_history(folder_.path() / "case_01/postProcessing/shell/0/volFieldValue.dat");
    for (const std::vector<double>& row : whole.rows) {
        rows += fmt::format("{} {} {}\n", row[0], 0.75 * row[1], 0.75 * row[2]);
    }
    folder_.write("case_01/postProcessing/shell/0/volFieldValue.dat", rows);
    EXPECT_THAT(error(),
                HasSubstr("k and epsilon of case_00 are of the mean 'near wake', those of case_01 of "
                          "'shell': tables hold one of them"));
}

TEST_F(ConvertRejections, RejectsTooFewIterations) {
    folder_.replace("case_00/provenance.json", "\"averaging_start\": 10", "\"averaging_start\": 18");
    EXPECT_THAT(error(), HasSubstr("force.dat: has 3 iterations from 18 on, too few"));
}

TEST_F(ConvertRejections, RejectsMeshesAndFieldsThatDoNotBelongTogether) {
    folder_.replace("mesh/constant/polyMesh/cellZones", "3(1 2 4)", "3(1 2 5)");
    EXPECT_THAT(error(), HasSubstr("/V: has no value for cell 5 of the near wake"));
    folder_.replace("mesh/constant/polyMesh/cellZones", "3(1 2 5)", "0()");
    EXPECT_THAT(error(), HasSubstr("cellZones: the zone 'nearWake' has no cells"));
}

TEST_F(ConvertRejections, RejectsAPlanOfAnotherBody) {
    write_body_file(folder_.path() / "body.body.h5", test::box_body(Vector3d(0.01, 0.02, 0.05)));
    EXPECT_THAT(error(), HasSubstr("plan.json and body.body.h5 belong to different bodies"));
}

TEST_F(ConvertRejections, NamesADirectionThatThePlanForgot) {
    nlohmann::json plan = nlohmann::json::parse(read_bytes(folder_.path() / "plan.json"));
    plan["cases"].erase(6);
    plan["cases"].erase(0);
    folder_.write("plan.json", plan.dump());
    EXPECT_THAT(error(),
                HasSubstr("plan.json: Reynolds number 1000: no case in the direction (1, 0, 0), which"));
}

TEST_F(ConvertRejections, RejectsDamagedPlansInOneLine) {
    const std::string plan = read_bytes(folder_.path() / "plan.json");
    const auto error_of = [&](const std::string& text) {
        folder_.write("plan.json", text);
        std::string message = error();
        EXPECT_EQ(message.find('\n'), std::string::npos) << message;
        EXPECT_THAT(message,
                    EndsWith("make the cases again with 'samara bake', or correct the plan if you wrote it"));
        return message;
    };
    const auto changed = [&](const std::string& entry, const nlohmann::json& value) {
        nlohmann::json content = nlohmann::json::parse(plan);
        content[nlohmann::json::json_pointer(entry)] = value;
        return content.dump();
    };
    EXPECT_THAT(error_of(plan.substr(0, 100)), HasSubstr("plan.json: is not valid JSON ("));
    EXPECT_THAT(error_of("{}"), HasSubstr("an entry is missing or of the wrong type"));
    EXPECT_THAT(error_of(changed("/quality", 3)), HasSubstr("an entry is missing or of the wrong type"));
    EXPECT_THAT(error_of(changed("/subdivisions", 0)), HasSubstr("'subdivisions' is not from 1 to 1024"));
    EXPECT_THAT(error_of(changed("/reference_length", -1)), HasSubstr("'reference_length' is not positive"));
    EXPECT_THAT(error_of(changed("/axes/0/0", 2)), HasSubstr("'axes' is not a rotation"));
    EXPECT_THAT(error_of(changed("/cases", nlohmann::json::array())), HasSubstr("'cases' is empty"));
    EXPECT_THAT(error_of(changed("/cases/1/name", "case_00")), HasSubstr("two cases are named case_00"));
    EXPECT_THAT(error_of(changed("/cases/1/direction", {1, 1, 0})),
                HasSubstr("case_01 is not a unit vector"));
    EXPECT_THAT(error_of(changed("/cases/1/reynolds_number", 0)), HasSubstr("case_01 is not positive"));
}

TEST_F(ConvertRejections, ReadsThroughNoLinkOutOfTheFolderAndWaitsForNoPipe) {
    const test::TemporaryFolder elsewhere;
    const std::filesystem::path force = folder_.case_path(0) / "postProcessing/forces/0/force.dat";
    std::filesystem::rename(force, elsewhere / "force.dat");
    std::filesystem::create_symlink(elsewhere / "force.dat", force);
    EXPECT_EQ(error(), force.string() + ": is a link to outside of " + folder_.path().string() +
                           ", which is not followed; replace it by a copy, or remove it");
    std::filesystem::remove(force);
    ASSERT_EQ(::mkfifo(force.c_str(), 0600), 0);
    EXPECT_EQ(error(), force.string() + ": is neither a file nor a folder; remove it");
    std::filesystem::remove(force);
    std::filesystem::rename(elsewhere / "force.dat", folder_.path() / "kept.dat");
    std::filesystem::create_symlink(folder_.path() / "kept.dat", force);
    EXPECT_NO_THROW(convert_folder(folder_.path()));
}

TEST_F(ConvertRejections, ReadsNoFolderBesideTheCases) {
    for (const char* name : {"../case_00", "/tmp", ""}) {
        for (const char* key : {"name", "mesh"}) {
            folder_.change_plan([&](nlohmann::json& plan) { plan["cases"][0][key] = name; });
            EXPECT_THAT(error(), HasSubstr("' is not the name of a folder beside plan.json"));
            folder_.change_plan([&](nlohmann::json& plan) { plan["cases"][0][key] = "case_00"; });
        }
    }
}

TEST_F(ConvertRejections, NamesAKeyOfThePlanThatItDoesNotKnow) {
    folder_.change_plan([](nlohmann::json& plan) { plan["cases"][0]["lenght"] = 2.0; });
    EXPECT_THAT(error(), HasSubstr("plan.json: a case has the unknown key 'lenght'; did you mean 'length'?"));
    folder_.change_plan([](nlohmann::json& plan) {
        plan["cases"][0].erase("lenght");
        plan["sub_divisions"] = 2;
    });
    EXPECT_THAT(
        error(),
        HasSubstr("plan.json: the plan has the unknown key 'sub_divisions'; did you mean 'subdivisions'?"));
}

}  // namespace
}  // namespace samara

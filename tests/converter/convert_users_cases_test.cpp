// Cases that the user solved, held against the plan that the user wrote.
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "converted_box.hpp"
#include "samara/core/files/content_hash.hpp"

namespace samara {
namespace {

using testing::HasSubstr;

/// A folder that the user solved, in units in which L is 2, the speed 3 and the density 5.
class ConvertOfAUsersCases : public test::ConvertedBox {
  protected:
    void SetUp() override {
        folder_.change_plan([](nlohmann::json& plan) {
            plan["solved_by"] = "user";
            plan["length"] = 2.0;
            plan["speed"] = 3.0;
            plan["density"] = 5.0;
        });
        set_up("uniform (-3 0 0)", "nu [0 2 -1 0 0 0 0] 6e-3", "rhoInf 5");
        // A cube around the origin whose area is that of a sphere of diameter 2.
        const double half = std::sqrt(4.0 * std::numbers::pi / 6.0) / 2.0;
        std::string points = header("vectorField") + "8\n(\n";
        for (int i = 0; i < 8; ++i) {
            points += fmt::format("({} {} {})\n", (i & 1) != 0 ? half : -half, (i & 2) != 0 ? half : -half,
                                  (i & 4) != 0 ? half : -half);
        }
        const std::string mesh = "mesh/constant/polyMesh/";
        folder_.write(mesh + "points", points + ")\n");
        folder_.write(mesh + "faces", header("faceList") +
                                          "6(4(0 2 3 1) 4(4 5 7 6) 4(0 1 5 4) 4(2 6 7 3) 4(0 4 6 2) "
                                          "4(1 3 7 5))\n");
        folder_.write(mesh + "owner", header("labelList") + "6(0 0 0 0 0 0)\n");
        folder_.write(mesh + "neighbour", header("labelList") + "0()\n");
        folder_.write(mesh + "boundary",
                      header("polyBoundaryMesh") + "1(cube { type wall; nFaces 6; startFace 0; })\n");
    }
    static std::string header(const std::string& kind) {
        return "FoamFile { version 2.0; format ascii; class " + kind + "; object x; }\n";
    }
    /// The flow that the first case sets up.
    void set_up(const std::string& flow, const std::string& viscosity, const std::string& density) {
        folder_.write("case_00/0/U", header("volVectorField") +
                                         "internalField uniform (0 0 0);\nboundaryField { far { type "
                                         "freestreamVelocity; freestreamValue " +
                                         flow + "; } cube { type noSlip; } }\n");
        folder_.write("case_00/constant/transportProperties",
                      header("dictionary") + "transportModel Newtonian;\n" + viscosity + ";\n");
        folder_.write("case_00/system/controlDict",
                      header("dictionary") +
                          "functions { forces { type forces; patches (cube); rho rhoInf; " + density +
                          "; } }\n");
    }
    std::string error_with(const char* key, const nlohmann::json& value) {
        nlohmann::json before;
        folder_.change_plan([&](nlohmann::json& plan) { before = std::exchange(plan[key], value); });
        std::string said = error();
        folder_.change_plan([&](nlohmann::json& plan) { plan[key] = before; });
        EXPECT_THAT(said, testing::StartsWith(folder_.case_path(0).string() + ": "));
        return said;
    }
};

TEST_F(ConvertOfAUsersCases, TakesThePlanThatIsOfThem) {
    EXPECT_NO_THROW(convert_folder(folder_.path()));
    folder_.write("case_00/numbers", "speed 3;\nflowVelocity (-3 0 0);\nviscosity 6e-3;\n");
    set_up("uniform $flowVelocity", "nu $viscosity", "rhoInf 5");
    for (const char* file : {"case_00/0/U", "case_00/constant/transportProperties"}) {
        folder_.write(file, read_bytes(folder_.path() / file) + "#include \"../numbers\"\n");
    }
    EXPECT_NO_THROW(convert_folder(folder_.path()));
    EXPECT_THAT(error_with("speed", 5.0),
                HasSubstr("the speed of the flow far from the body is 3, but plan.json has the "
                          "'speed' 5; correct the plan, or solve the case for it"));
}

TEST_F(ConvertOfAUsersCases, RejectsAPlanWhoseNumbersAreNotTheirs) {
    EXPECT_THAT(error_with("length", 13.8),
                HasSubstr("sqrt(S/pi) of the body's area S in the mesh is 2, but plan.json has "
                          "the 'length' 13.8"));
    EXPECT_THAT(error_with("speed", 5.0), HasSubstr("is 3, but plan.json has the 'speed' 5"));
    EXPECT_THAT(error_with("density", 1.0),
                HasSubstr("(rhoInf of the function object forces) is 5, but plan.json has the "
                          "'density' 1"));
    set_up("uniform (-3 0 0)", "nu 0.01", "rhoInf 5");
    EXPECT_THAT(
        error(),
        HasSubstr("with its viscosity of 0.01, the length 2 and the speed 3 the Reynolds number is 600, but "
                  "plan.json has the 'reynolds_number' 1000"));
}

TEST_F(ConvertOfAUsersCases, SaysWhichDirectionTheirFlowHas) {
    set_up("uniform (3 0 0)", "nu 6e-3", "rhoInf 5");
    EXPECT_THAT(
        error(),
        HasSubstr("case_00: the flow has the opposite direction: along [1, 0, 0], so the body moves along "
                  "[-1, 0, 0], but plan.json has the 'direction' [1, 0, 0] of the body's velocity"));
    set_up("uniform (0 -3 0)", "nu 6e-3", "rhoInf 5");
    EXPECT_THAT(error(),
                HasSubstr("the flow has the direction [0, -1, 0], so the body moves along [0, 1, 0], but"));
}

TEST_F(ConvertOfAUsersCases, HoldsNothingAgainstWhatTheyDoNotSayPlainly) {
    set_up("uniform $unknown", "nu #calc \"1\"", "rhoInf $unknown");
    EXPECT_NO_THROW(convert_folder(folder_.path()));
    for (const char* file :
         {"case_00/0/U", "case_00/constant/transportProperties", "case_00/system/controlDict"}) {
        folder_.write(file, "neither { this\nnor");
    }
    EXPECT_NO_THROW(convert_folder(folder_.path()));
}

}  // namespace
}  // namespace samara

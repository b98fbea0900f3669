#include "samara/core/base/nearest_word.hpp"

#include <gtest/gtest.h>

namespace samara {
namespace {

const std::vector<std::string> keys = {"name", "shape", "scale", "mass", "density", "center_of_mass"};

TEST(NearestWord, IsTheOneThatWasMisspelt) {
    for (const char* written : {"densty", "desnity", "Density", "densitty", "denzity", "DENSTY"}) {
        EXPECT_EQ(nearest_word(written, keys), "density") << written;
    }
    EXPECT_EQ(nearest_word("center-of-mas", keys), "center_of_mass");
    EXPECT_EQ(nearest_word("nmae", keys), "name");
    EXPECT_EQ(did_you_mean("shap", keys), "; did you mean 'shape'?");
}

TEST(NearestWord, IsNoneWhereNoneIsNear) {
    for (const char* written : {"colour", "radius", "x", "", "viscosity"}) {
        EXPECT_EQ(nearest_word(written, keys), "") << written;
        EXPECT_EQ(did_you_mean(written, keys), "") << written;
    }
    EXPECT_EQ(nearest_word("scale", {"shape"}), "") << "two letters of five are another word";
    EXPECT_EQ(nearest_word(std::string(100000, 'a'), keys), "");
}

TEST(NearestWord, IsTheNearestOfSeveral) {
    EXPECT_EQ(nearest_word("--trheads", {"--three", "--threads", "--thread"}), "--threads");
    EXPECT_EQ(nearest_word("anything", {}), "");
}

}  // namespace
}  // namespace samara

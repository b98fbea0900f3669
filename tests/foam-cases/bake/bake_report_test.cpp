#include "foam-cases/bake/bake_report.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace samara {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

/// Returns the notes of a bake about falls with these balances, fall_00 and so on.
std::string said_of(const std::vector<FallBalance>& balances) {
    BakeRequest request;
    request.output = "rubber.body.h5";
    BakeResult result;
    result.conversion.emplace();
    auto& falls = result.conversion->identification.emplace().falls;
    for (const FallBalance& balance : balances) {
        SimulatedFall& fall = falls.emplace_back();
        fall.name = "fall_0" + std::to_string(falls.size() - 1);
        fall.balance = balance;
    }
    testing::internal::CaptureStderr();
    warn_of_unbalanced_falls(request, result);
    return testing::internal::GetCapturedStderr();
}

TEST(BakeReport, NotesTheFallsWhoseMomentaDoNotBalanceAndTheirRemedy) {
    EXPECT_THAT(said_of({{0.02, 0.10}, {0.012, 0.16}}),
                AllOf(HasSubstr("rubber.body.h5"), HasSubstr("fall_01"), HasSubstr("moment by 16 %"),
                      HasSubstr("--fall-step 0.25"), Not(HasSubstr("fall_00"))));
    EXPECT_THAT(said_of({{0.06, 0.10}}), HasSubstr("force off by 6 %"));
    EXPECT_THAT(said_of({{0.049, 0.149}}), IsEmpty());
    EXPECT_THAT(said_of({}), IsEmpty());
}

}  // namespace
}  // namespace samara

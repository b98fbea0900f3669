#include "foam-cases/farm/case_record.hpp"

#include <gtest/gtest.h>

#include "support/temporary_folder.hpp"

namespace samara {
namespace {

TEST(CaseRecord, OfAMissingOrDamagedFileIsEmpty) {
    const test::TemporaryFolder folder;
    EXPECT_TRUE(read_record(folder / "failed.json").empty());
    EXPECT_TRUE(read_record(folder.path()).empty());
    for (const char* text : {"", "{\"reason\": ", "[1, 2]", "null", "\xff"}) {
        EXPECT_TRUE(read_record(folder.file("failed.json", text)).empty()) << text;
    }
}

TEST(CaseRecord, EntriesOfAnotherKindAreNone) {
    const test::TemporaryFolder folder;
    const nlohmann::json record = read_record(
        folder.file("failed.json", R"({"reason": "diverged", "cpu_seconds": 2.5, "cells": "many"})"));
    EXPECT_EQ(text_in(record, "reason"), "diverged");
    EXPECT_EQ(text_in(record, "cpu_seconds"), "");
    EXPECT_EQ(text_in(record, "absent"), "");
    EXPECT_EQ(number_in(record, "cpu_seconds"), 2.5);
    EXPECT_EQ(number_in(record, "cells"), 0.0);
    EXPECT_EQ(number_in(record, "absent"), 0.0);
}

}  // namespace
}  // namespace samara

#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "converter/convert.hpp"
#include "load_laws.hpp"
#include "solved_folder.hpp"
#include "support/expect_error.hpp"

namespace samara::test {

/// The law of a box whose force falls with the Reynolds number.
inline LoadEntry box_law_by_reynolds_number(const Vector3d& direction, double reynolds_number) {
    LoadEntry entry = BoxLaw{}(direction);
    entry.force *= 1.0 + 1000.0 / reynolds_number;
    return entry;
}

/// A solved folder of a box at two Reynolds numbers, to be converted.
class ConvertedBox : public testing::Test {
  protected:
    /// Returns the text of the error of the conversion.
    [[nodiscard]] std::string error() const {
        return error_of([&] { convert_folder(folder_.path()); });
    }

    SolvedFolder folder_{box_body(Vector3d(0.01, 0.02, 0.04)), 2, {1e3, 1e4}, box_law_by_reynolds_number};
};

}  // namespace samara::test

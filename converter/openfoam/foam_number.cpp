#include "converter/openfoam/foam_number.hpp"

#include <charconv>
#include <cstdlib>
#include <string>
#include <system_error>

namespace samara {

const char* read_foam_number(const char* first, const char* last, double& value) {
    const auto [end, status] = std::from_chars(first, last, value);
    // std::from_chars leaves the value as it was there.
    if (status == std::errc::result_out_of_range)
        value = std::strtod(std::string(first, end).c_str(), nullptr);
    return status == std::errc::invalid_argument ? first : end;
}

}  // namespace samara

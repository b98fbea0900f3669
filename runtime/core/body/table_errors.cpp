#include "samara/core/body/table_errors.hpp"

namespace samara {
namespace {

constexpr const char* names[error_source_count] = {"tail", "symmetry", "mesh", "closure", "interpolation"};

}  // namespace

const char* name_of(ErrorSource source) {
    return names[static_cast<std::size_t>(source)];
}

std::optional<ErrorSource> error_source(std::string_view name) {
    for (std::size_t i = 0; i < error_source_count; ++i) {
        if (name == names[i]) return static_cast<ErrorSource>(i);
    }
    return std::nullopt;
}

}  // namespace samara

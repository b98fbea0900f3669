#include "samara/commands/option_values.hpp"

#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <string_view>

#include <fmt/format.h>

#include "samara/commands/shared/arguments.hpp"
#include "samara/core/base/error.hpp"

namespace samara {

const BodyMotion& find_body(const std::string& input, const Motion& motion, const std::string& name) {
    if (name.empty()) return motion.bodies.front();
    std::string names;
    for (const BodyMotion& body : motion.bodies) {
        if (body.name == name) return body;
        names += (names.empty() ? "" : ", ") + body.name;
    }
    throw Error(fmt::format("{}: holds no body '{}'; it holds: {}", input, name, names));
}

void require_run(const std::string& input, const Motion& motion, int run) {
    if (run < motion.runs) return;
    throw Error(motion.runs == 1 ? fmt::format("{}: holds only run 0, not run {}; give run 0", input, run)
                                 : fmt::format("{}: holds runs 0 to {}, not run {}; give one of these", input,
                                               motion.runs - 1, run));
}

void require_copy(const std::string& input, const BodyMotion& body, int copy) {
    if (copy < body.copies) return;
    throw Error(
        body.copies == 1
            ? fmt::format("{}: holds only copy 0 of {}, not copy {}; give copy 0", input, body.name, copy)
            : fmt::format("{}: holds copies 0 to {} of {}, not copy {}; give one of these", input,
                          body.copies - 1, body.name, copy));
}

CopyRange copy_range(const std::string& option, const std::string& words) {
    const std::size_t dash = words.find('-');
    const auto number = [&](std::string_view text) {
        int value = -1;
        const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
        return error == std::errc() && end == text.data() + text.size() ? value : -1;
    };
    CopyRange range;
    range.first = number(std::string_view(words).substr(0, dash));
    range.last = dash == std::string::npos ? range.first : number(std::string_view(words).substr(dash + 1));
    if (range.first >= 0 && range.last >= range.first) return range;
    throw Error(
        fmt::format("{} {}: is no copy and no range of copies; give a number from 0 on, or two such as 10-19",
                    option, words));
}

std::vector<Vector3d> colors_of_words(const std::string& option, const std::string& words) {
    std::vector<Vector3d> colors;
    for (const std::string& word : comma_separated(words)) {
        const std::string_view digits = std::string_view(word).substr(word.front() == '#' ? 1 : 0);
        std::uint32_t value = 0;
        const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value, 16);
        if (digits.size() != 6 || error != std::errc() || end != digits.data() + digits.size()) {
            throw Error(
                fmt::format("{} {}: is no colour; give red, green and blue in hexadecimal, such as c8553d",
                            option, word));
        }
        const auto linear = [&](unsigned shift) {
            const double part = static_cast<double>((value >> shift) & 0xffU) / 255.0;
            return part <= 0.04045 ? part / 12.92 : std::pow((part + 0.055) / 1.055, 2.4);
        };
        colors.emplace_back(linear(16), linear(8), linear(0));
    }
    if (colors.empty())
        throw Error(fmt::format("{}: names no colour; give some such as c8553d,e09f3e", option));
    return colors;
}

std::optional<Vector3d> vector_of_words(const std::string& words) {
    Vector3d vector;
    int end = 0;
    const int found =
        std::sscanf(words.c_str(), "%lf,%lf,%lf%n", &vector.x(), &vector.y(), &vector.z(), &end);
    if (found != 3 || static_cast<std::size_t>(end) != words.size() || !vector.allFinite())
        return std::nullopt;
    return vector;
}

}  // namespace samara

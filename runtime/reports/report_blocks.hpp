#pragma once

#include <string>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace samara {

/// A part of a report: a title unlike those of the other parts, and blocks as samara.report.page() of the
/// Python package takes them.
struct ReportPart {
    std::string title;
    std::vector<nlohmann::json> blocks;
};

using Rows = std::vector<std::vector<std::string>>;

/// Returns a block of a paragraph.
inline nlohmann::json text_block(const std::string& text) {
    return {{"text", text}};
}

/// Returns a block of a table: rows of texts, the first of which names the row, below headings where there
/// are some.
inline nlohmann::json table_block(const std::vector<std::string>& headings, const Rows& rows) {
    return {{"table", {{"headings", headings}, {"rows", rows}}}};
}

/// Returns a block that is folded until the reader opens it.
inline nlohmann::json folded_block(const std::string& summary, nlohmann::json block) {
    block["summary"] = summary;
    return block;
}

/// Returns a block of a picture as draw_picture() takes it, with its description.
inline nlohmann::json picture_block(const std::string& words, const nlohmann::json& picture) {
    return {{"picture", picture}, {"words", words}};
}

/// Returns a share as text: "0.12 %", "17 %" or "120 %".
inline std::string per_cent(double share) {
    return share < 0.995 ? fmt::format("{:.2g} %", 100.0 * share) : fmt::format("{:.0f} %", 100.0 * share);
}

/// Returns a number as text of about four digits, without an exponent from 1e-3 to 1e9.
inline std::string in_plain_digits(double number) {
    return number >= 1000.0 && number < 1e9 ? fmt::format("{:.0f}", number) : fmt::format("{:.4g}", number);
}

}  // namespace samara

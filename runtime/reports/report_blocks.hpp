#pragma once

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace samara {

/// A part of a report: a title unlike those of the other parts, and blocks as samara.report.page() of the
/// Python package takes them.
struct ReportPart {
    std::string title;
    std::vector<nlohmann::json> blocks;
};

using Rows = std::vector<std::vector<std::string>>;

/// A paragraph.
inline nlohmann::json text_block(const std::string& text) {
    return {{"text", text}};
}

/// Rows of texts, the first of which names the row, below headings where there are some.
inline nlohmann::json table_block(const std::vector<std::string>& headings, const Rows& rows) {
    return {{"table", {{"headings", headings}, {"rows", rows}}}};
}

/// A block that is folded until it is asked for.
inline nlohmann::json folded_block(const std::string& summary, nlohmann::json block) {
    block["summary"] = summary;
    return block;
}

/// A picture as draw_picture() takes it, with what it shows in words.
inline nlohmann::json picture_block(const std::string& words, const nlohmann::json& picture) {
    return {{"picture", picture}, {"words", words}};
}

}  // namespace samara

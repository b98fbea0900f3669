#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace samara {

/// The text as it is shown in a page: made printable(), with what HTML reads as its own escaped.
std::string html_text(const std::string& text);

/// A table: a row of headings, where there are some, and rows of cells, all texts; the first cell of a row
/// names it. Wide tables scroll by themselves.
std::string html_table(const std::vector<std::string>& headings,
                       const std::vector<std::vector<std::string>>& rows);

/// A paragraph of plain text.
std::string html_paragraph(const std::string& text);

/// What is folded until it is asked for.
std::string html_details(const std::string& summary, const std::string& html);

/// A picture within the page, with what it shows in words. `draw` draws it into the .svg file it is given.
std::string html_picture(const std::string& words,
                         const std::function<void(const std::filesystem::path& file)>& draw);

}  // namespace samara

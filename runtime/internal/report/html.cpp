#include "samara/internal/report/html.hpp"

#include <fmt/format.h>

#include "samara/core/base/base64.hpp"
#include "samara/core/base/printable.hpp"
#include "samara/core/files/content_hash.hpp"
#include "samara/core/files/temporary_folder.hpp"

namespace samara {

std::string html_text(const std::string& text) {
    std::string escaped;
    for (const char letter : printable(text)) {
        switch (letter) {
            case '&':
                escaped += "&amp;";
                break;
            case '<':
                escaped += "&lt;";
                break;
            case '>':
                escaped += "&gt;";
                break;
            case '"':
                escaped += "&quot;";
                break;
            default:
                escaped += letter;
        }
    }
    return escaped;
}

std::string html_table(const std::vector<std::string>& headings,
                       const std::vector<std::vector<std::string>>& rows) {
    std::string html = "<div class=\"wide\"><table>\n";
    if (!headings.empty()) {
        html += "<thead><tr>";
        for (const std::string& heading : headings) html += "<th>" + html_text(heading) + "</th>";
        html += "</tr></thead>\n";
    }
    html += "<tbody>\n";
    for (const std::vector<std::string>& row : rows) {
        html += "<tr>";
        for (std::size_t i = 0; i < row.size(); ++i) {
            html += fmt::format("<{0}>{1}</{0}>", i == 0 ? "th" : "td", html_text(row[i]));
        }
        html += "</tr>\n";
    }
    return html + "</tbody></table></div>\n";
}

std::string html_paragraph(const std::string& text) {
    return "<p>" + html_text(text) + "</p>\n";
}

std::string html_details(const std::string& summary, const std::string& html) {
    return "<details><summary>" + html_text(summary) + "</summary>\n" + html + "</details>\n";
}

std::string html_picture(const std::string& words,
                         const std::function<void(const std::filesystem::path& file)>& draw) {
    const TemporaryFolder folder;
    const std::filesystem::path file = folder / "picture.svg";
    draw(file);
    return fmt::format("<figure><img src=\"data:image/svg+xml;base64,{}\" alt=\"{}\"></figure>\n",
                       base64(read_bytes(file)), html_text(words));
}

}  // namespace samara

#include "samara/internal/report/report_page.hpp"

#include <ostream>

#include <fmt/format.h>

#include "samara/base/version.hpp"
#include "samara/core/files/replace_file.hpp"
#include "samara/internal/report/html.hpp"
#include "samara/internal/report/report_style.hpp"

namespace samara {
namespace {

std::string list_of(const char* title, const char* grade, const std::vector<std::string>& uses) {
    std::string html = fmt::format("<div><h3 class=\"{}\">{}</h3><ul>\n", grade, title);
    for (const std::string& use : uses) html += "<li>" + html_text(use) + "</li>\n";
    if (uses.empty()) html += "<li>nothing</li>\n";
    return html + "</ul></div>\n";
}

std::string verdict_html(const BakeVerdict& verdict) {
    std::string html =
        fmt::format("<section class=\"verdict {}\" id=\"verdict\">\n<p>{}</p>\n<div class=\"uses\">\n",
                    name_of(verdict.grade), html_text(verdict.headline));
    html += list_of("Good for", "good", verdict.good_for);
    if (!verdict.not_for.empty()) html += list_of("Not for", "bad", verdict.not_for);
    html += "</div>\n<h3>Why</h3>\n<dl>\n";
    for (const Finding& finding : verdict.findings) {
        html += fmt::format("<dt class=\"{}\">{}</dt><dd>{}</dd>\n", name_of(finding.grade),
                            html_text(finding.what), html_text(finding.text));
    }
    return html + "</dl>\n</section>\n";
}

}  // namespace

void write_report_page(const std::filesystem::path& file, const std::string& name, const std::string& below,
                       const BakeVerdict& verdict, const std::vector<ReportPart>& parts) {
    std::string navigation;
    std::string body;
    for (std::size_t i = 0; i < parts.size(); ++i) {
        navigation += fmt::format("<a href=\"#part{}\">{}</a>\n", i, html_text(parts[i].title));
        body += fmt::format("<section>\n<h2 id=\"part{}\">{}</h2>\n{}</section>\n", i,
                            html_text(parts[i].title), parts[i].html);
    }
    replace_file_by_stream(file, [&](std::ostream& stream) {
        stream << "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
               << "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>"
               << html_text(name) << ": is the bake to be trusted?</title>\n<style>" << report_style
               << "</style>\n</head>\n<body>\n<header>\n<h1>" << html_text(name)
               << "</h1>\n<p class=\"below\">" << html_text(below) << "</p>\n</header>\n"
               << verdict_html(verdict) << "<nav>\n"
               << navigation << "</nav>\n<main>\n"
               << body << "</main>\n<footer>samara " << version << "</footer>\n</body>\n</html>\n";
    });
}

}  // namespace samara

#include <iostream>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <CGAL/IO/OFF.h>
#include <CGAL/IO/PLY.h>
#include <CGAL/Simple_cartesian.h>
#include <fmt/format.h>

#include "meshes/reading/shape_reader.hpp"
#include "samara/core/base/error.hpp"
#include "samara/core/files/input_file.hpp"
#include "samara/core/surface/mesh_text.hpp"
#include "samara/core/surface/obj_file.hpp"
#include "samara/core/surface/polygon_triangles.hpp"

namespace samara {
namespace {

using Point = CGAL::Simple_cartesian<double>::Point_3;
using Polygon = std::vector<std::size_t>;

// Captures standard error, where CGAL reports what is wrong with a file.
class CaughtErrors {
  public:
    CaughtErrors() : old_(std::cerr.rdbuf(stream_.rdbuf())) {}
    ~CaughtErrors() { std::cerr.rdbuf(old_); }
    CaughtErrors(const CaughtErrors&) = delete;
    CaughtErrors& operator=(const CaughtErrors&) = delete;

    [[nodiscard]] std::string first_line() const {
        std::string text = stream_.str();
        return text.substr(0, text.find('\n'));
    }

  private:
    std::ostringstream stream_;
    std::streambuf* old_;
};

// Returns the text as CGAL reads it: without a byte order mark, and with Unix line ends.
std::string plain(const std::string& bytes, const std::string& label, ShapeFormat format) {
    std::string text(without_byte_order_mark(bytes, label));
    const bool is_binary =
        format == ShapeFormat::ply && text.substr(0, 200).find("format binary") != std::string::npos;
    if (!is_binary) {
        std::string lines;
        constexpr bool continued = false;
        visit_lines(text, continued, [&](std::string_view line, int) { lines.append(line) += '\n'; });
        text = std::move(lines);
    }
    const std::size_t start = text.find_first_not_of(" \t\n");
    const bool begins_with_counts = start != std::string::npos && text.find_first_of("0123456789") == start;
    if (format == ShapeFormat::off && begins_with_counts) text.insert(0, "OFF\n");
    return text;
}

}  // namespace

Surface read_polygon_file(const std::filesystem::path& file, ShapeFormat format) {
    const std::string label = file.string();
    std::istringstream stream(plain(read_at_most(file, most_mesh_bytes), label, format));
    std::vector<Point> points;
    std::vector<Polygon> polygons;
    const char* const name = format == ShapeFormat::ply ? "PLY" : "OFF";
    const auto fail = [&](const std::string& reason) {
        throw Error(fmt::format("{}: is not a valid {} file{}{}; export it again, or as .stl", label, name,
                                reason.empty() ? "" : ": ", reason));
    };
    {
        const CaughtErrors errors;
        bool read = false;
        try {
            read = format == ShapeFormat::ply ? CGAL::IO::read_PLY(stream, points, polygons)
                                              : CGAL::IO::read_OFF(stream, points, polygons);
        } catch (const std::exception&) {
        }
        if (!read) fail(errors.first_line());
    }
    Surface surface;
    for (const Point& point : points) surface.vertices.emplace_back(point.x(), point.y(), point.z());
    for (std::size_t i = 0; i < polygons.size(); ++i) {
        const Polygon& polygon = polygons[i];
        std::vector<std::int32_t> corners;
        for (const std::size_t corner : polygon) {
            if (corner >= points.size()) {
                fail(fmt::format("face {} uses vertex {}, but there are {}", i + 1, corner + 1,
                                 points.size()));
            }
            corners.push_back(static_cast<std::int32_t>(corner));
        }
        if (corners.size() > most_obj_corners) {
            fail(
                fmt::format("face {} has {} corners, more than {}", i + 1, corners.size(), most_obj_corners));
        }
        if (corners.size() < 3) continue;  // a line or a point
        const auto triangles = polygon_triangles(surface.vertices, corners);
        surface.corners.insert(surface.corners.end(), triangles.begin(), triangles.end());
    }
    return surface;
}

}  // namespace samara

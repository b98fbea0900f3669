#include "samara/export/csv_file.hpp"

#include <iterator>
#include <ostream>

#include <fmt/format.h>

#include "samara/core/base/text.hpp"
#include "samara/core/files/replace_file.hpp"
#include "samara/export/shape_pose.hpp"

namespace samara {
namespace {

constexpr const char* column_names =
    "run,body,copy,time,position_x,position_y,position_z,orientation_w,orientation_x,orientation_y,"
    "orientation_z,velocity_x,velocity_y,velocity_z,angular_velocity_x,angular_velocity_y,"
    "angular_velocity_z";

/// Returns the line of the columns' names.
std::string header_of(const Motion& motion) {
    std::string header = column_names;
    for (const auto& [part, member] : parts_of_fluid_forces) {
        if (!motion.has_forces) break;
        for (const char* quantity : {"moment", "force"}) {
            for (const char axis : {'x', 'y', 'z'}) header += fmt::format(",{}_{}_{}", part, quantity, axis);
        }
    }
    return header + '\n';
}

/// Returns a field of RFC 4180: in quotes where it holds a comma or a quote. An apostrophe before it tells
/// spreadsheets that a text that begins like a formula is none.
std::string csv_field(const std::string& name) {
    std::string text = printable(name);
    if (text.find_first_of("=+-@") == 0) text.insert(0, 1, '\'');
    if (text.find_first_of(",\"") == std::string::npos) return text;
    std::string quoted = "\"";
    for (const char letter : text) {
        if (letter == '"') quoted += '"';
        quoted += letter;
    }
    return quoted + '"';
}

void append_rows(fmt::memory_buffer& rows, const Motion& motion, const BodyMotion& body, int run, int copy,
                 int first_copy) {
    const std::string field = csv_field(body.name);
    const std::vector<ShapePose> poses = shape_poses(motion, body, run, copy);
    for (std::size_t frame = 0; frame < poses.size(); ++frame) {
        const ShapePose& p = poses[frame];
        fmt::format_to(std::back_inserter(rows), "{},{},{},{}", run, field, first_copy + copy,
                       motion.times[frame]);
        for (const double value :
             {p.position.x(), p.position.y(), p.position.z(), p.orientation.w(), p.orientation.x(),
              p.orientation.y(), p.orientation.z(), p.velocity.x(), p.velocity.y(), p.velocity.z(),
              p.angular_velocity.x(), p.angular_velocity.y(), p.angular_velocity.z()}) {
            fmt::format_to(std::back_inserter(rows), ",{}", value);
        }
        for (const auto& [part, member] : parts_of_fluid_forces) {
            if (!motion.has_forces) break;
            const auto& forces = body.forces[motion.index(body, run, static_cast<int>(frame), copy)];
            const Wrench& wrench = forces.*member;
            for (const Vector3d* vector : {&wrench.moment, &wrench.force}) {
                fmt::format_to(std::back_inserter(rows), ",{},{},{}", vector->x(), vector->y(), vector->z());
            }
        }
        rows.push_back('\n');
    }
}

}  // namespace

std::size_t write_csv(const std::filesystem::path& file, const Motion& motion, const std::optional<int>& run,
                      const ExportProgress& progress, int first_copy) {
    const int first_run = run.value_or(0);
    const int end_run = run ? *run + 1 : motion.runs;
    std::size_t copies = 0;
    for (const BodyMotion& body : motion.bodies) copies += static_cast<std::size_t>(body.copies);
    const std::size_t total = static_cast<std::size_t>(end_run - first_run) * copies * motion.times.size();
    std::size_t done = 0;
    replace_file_by_stream(file, [&](std::ostream& stream) {
        stream << header_of(motion);
        fmt::memory_buffer rows;
        for (int r = first_run; r < end_run; ++r) {
            for (const BodyMotion& body : motion.bodies) {
                for (int copy = 0; copy < body.copies && stream; ++copy) {
                    rows.clear();
                    append_rows(rows, motion, body, r, copy, first_copy);
                    stream.write(rows.data(), static_cast<std::streamsize>(rows.size()));
                    done += motion.times.size();
                    if (progress) progress(static_cast<double>(done), static_cast<double>(total));
                }
            }
        }
    });
    return total;
}

}  // namespace samara

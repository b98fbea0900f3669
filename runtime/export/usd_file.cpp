#include "samara/export/usd_file.hpp"

#include <cctype>
#include <cmath>
#include <iterator>
#include <numbers>
#include <ostream>

#include <fmt/format.h>

#include "samara/core/base/numbers.hpp"
#include "samara/core/base/version.hpp"
#include "samara/core/files/replace_file.hpp"
#include "samara/core/surface/display_image.hpp"
#include "samara/export/float_range.hpp"
#include "samara/export/key_reduction.hpp"
#include "samara/export/shape_pose.hpp"
#include "samara/export/usd_mesh.hpp"

namespace samara {
namespace {

/// Returns the times in frames, rounded where they are whole but for rounding.
std::vector<double> time_codes(const Motion& motion) {
    std::vector<double> codes;
    for (const double time : motion.times) {
        const double code = time * motion.frame_rate;
        codes.push_back(std::abs(code - std::round(code)) < 1e-6 ? std::round(code) : code);
    }
    return codes;
}

/// Returns the files of the images of each body's display mesh, relative to the stage's folder.
using ImageFiles = std::vector<std::vector<std::string>>;

/// Writes the images of all display meshes into the folder STAGE.images beside the stage.
ImageFiles write_images(const std::filesystem::path& stage, const Motion& motion) {
    std::string folder = stage.stem().string() + ".images";
    for (char& letter : folder) {
        if (letter == '@' || std::iscntrl(static_cast<unsigned char>(letter)) != 0)
            letter = '_';  // ends a path in USD
    }
    PrimNames names;
    ImageFiles files;
    for (const BodyMotion& body : motion.bodies) {
        files.emplace_back();
        if (body.display == nullptr) continue;
        for (const DisplayImage& image : body.display->images) {
            const std::string name = names(image.name) + "." + image_type(image.bytes);
            const std::filesystem::path file = stage.parent_path() / folder / name;
            std::error_code error;  // the write reports it
            std::filesystem::create_directories(file.parent_path(), error);
            replace_file_with(file, image.bytes);
            files.back().push_back(fmt::format("./{}/{}", folder, name));
        }
    }
    return files;
}

/// Writes the stage of one run.
class Stage {
  public:
    Stage(std::ostream& stream, const Motion& motion, int run, const ImageFiles& images,
          const CopyStyle& style)
        : stream_(stream),
          motion_(motion),
          run_(run),
          images_(images),
          style_(style),
          codes_(time_codes(motion)) {}

    std::size_t write(const std::optional<double>& tolerance) {
        print(
            "#usda 1.0\n(\n    defaultPrim = \"motion\"\n    doc = \"samara {}\"\n    endTimeCode = {}\n"
            "    framesPerSecond = {}\n    metersPerUnit = 1\n    startTimeCode = {}\n"
            "    timeCodesPerSecond = {}\n    upAxis = \"Z\"\n)\n\ndef Xform \"motion\"\n{{\n",
            version, codes_.back(), motion_.frame_rate, codes_.front(), motion_.frame_rate);
        for (const BodyMotion& body : motion_.bodies) {
            if (body.copies > most_usd_transforms) {
                write_instancer(body);
            } else {
                write_transforms(body, key_tolerance(body, tolerance));
            }
        }
        for (const Obstacle& obstacle : motion_.obstacles) {
            write_obstacle(obstacle, key_tolerance(obstacle, tolerance));
        }
        print("}}\n");
        return samples_;
    }

  private:
    template <typename... Words>
    void print(fmt::format_string<Words...> format, Words&&... words) {
        text_.clear();
        fmt::format_to(std::back_inserter(text_), format, std::forward<Words>(words)...);
        stream_.write(text_.data(), static_cast<std::streamsize>(text_.size()));
    }

    [[nodiscard]] std::string shape_of(const BodyMotion& body, std::size_t indent) const {
        if (style_.colors_copies_of(body)) return usd_mesh(body.surface, indent, std::nullopt);
        if (body.display == nullptr) return usd_mesh(body.surface, indent);
        const auto number = static_cast<std::size_t>(&body - motion_.bodies.data());
        return usd_display(*body.display, images_[number], indent);
    }

    void write_transforms(const BodyMotion& body, const KeyTolerance& tolerance) {
        std::string first;
        for (int copy = 0; copy < body.copies; ++copy) {
            const std::string name = names_(style_.name(body, copy));
            print("    def Xform \"{}\"\n    {{\n", name);
            if (style_.colors_copies_of(body)) {
                print("        color3f[] primvars:displayColor = [{}]\n", usd_float3(style_.color(copy)));
            }
            write_samples(shape_poses(motion_, body, run_, copy), tolerance, body.size(run_, copy));
            if (copy == 0) {
                first = name;
                print("\n        def Xform \"shape\"\n        {{\n{}        }}\n", shape_of(body, 12));
            } else {
                print(
                    "\n        def Xform \"shape\" (\n            instanceable = true\n"
                    "            references = </motion/{}/shape>\n        )\n        {{\n        }}\n",
                    first);
            }
            print("    }}\n");
        }
    }

    void write_obstacle(const Obstacle& obstacle, const KeyTolerance& tolerance) {
        print("    def Xform \"{}\"\n    {{\n", names_(obstacle.name));
        write_samples(shape_poses(motion_, obstacle), tolerance, 1.0);
        print("\n        def Xform \"shape\"\n        {{\n{}        }}\n    }}\n",
              usd_mesh(obstacle.surface, 12, 0.5, true));
    }

    void write_samples(const std::vector<ShapePose>& poses, const KeyTolerance& tolerance, double size) {
        std::vector<Vector3d> positions;
        std::vector<Quaterniond> orientations;
        std::vector<Quaterniond> stored;
        for (const ShapePose& pose : poses) {
            positions.push_back(pose.position);
            orientations.push_back(pose.orientation);
            stored.emplace_back(pose.orientation.coeffs().cast<float>().cast<double>().normalized());
        }
        if (codes_.size() == 1) {
            const Vector3d& p = positions.front();
            print("        quatf xformOp:orient = {}\n        double3 xformOp:translate = ({}, {}, {})\n",
                  quatf(orientations.front()), p.x(), p.y(), p.z());
            samples_ += 2;
            write_order(size);
            return;
        }
        print("        quatf xformOp:orient.timeSamples = {{\n");
        for (const std::size_t key : kept_keys({codes_, orientations, codes_, stored}, tolerance.angle)) {
            print("            {}: {},\n", codes_[key], quatf(orientations[key]));
            ++samples_;
        }
        print("        }}\n        double3 xformOp:translate.timeSamples = {{\n");
        for (const std::size_t key : kept_keys({codes_, positions, codes_, positions}, tolerance.position)) {
            const Vector3d& p = positions[key];
            print("            {}: ({}, {}, {}),\n", codes_[key], p.x(), p.y(), p.z());
            ++samples_;
        }
        print("        }}\n");
        write_order(size);
    }

    /// Writes a size other than 1, and the order of an Xform's operations.
    void write_order(double size) {
        if (size == 1.0) {
            print("        uniform token[] xformOpOrder = [\"xformOp:translate\", \"xformOp:orient\"]\n");
            return;
        }
        print(
            "        double3 xformOp:scale = ({0}, {0}, {0})\n        uniform token[] xformOpOrder = "
            "[\"xformOp:translate\", \"xformOp:orient\", \"xformOp:scale\"]\n",
            size);
    }

    static std::string quatf(const Quaterniond& q) {
        return fmt::format("({}, {}, {}, {})", static_cast<float>(q.w()), static_cast<float>(q.x()),
                           static_cast<float>(q.y()), static_cast<float>(q.z()));
    }

    /// Returns a quaternion of halves as text, with more digits than a half has: the reader rounds.
    static std::string quath(const Quaterniond& q) {
        return fmt::format("({:.5g}, {:.5g}, {:.5g}, {:.5g})", q.w(), q.x(), q.y(), q.z());
    }

    void write_instancer(const BodyMotion& body) {
        std::vector<std::vector<ShapePose>> poses;  // by copy
        poses.reserve(as_index(body.copies));
        for (int copy = 0; copy < body.copies; ++copy) {
            poses.push_back(shape_poses(motion_, body, run_, copy));
        }
        const std::string name = names_(body.name);
        print("    def PointInstancer \"{}\"\n    {{\n", name);
        write_array("float3[] extent", 2, [&, reach = reach_of(body)](std::size_t end, std::size_t frame) {
            Eigen::AlignedBox3d box;
            for (const auto& copy : poses) box.extend(copy[frame].position);
            return usd_float3(end == 0 ? Vector3d(box.min().array() - reach)
                                       : Vector3d(box.max().array() + reach));
        });
        print("        int[] protoIndices = [0");
        for (int copy = 1; copy < body.copies; ++copy) print(", 0");
        print("]\n        rel prototypes = </motion/{}/prototypes/shape>\n", name);
        const std::size_t copies = poses.size();
        if (!body.sizes.empty()) {
            print("        float3[] scales = [");
            for (int copy = 0; copy < body.copies; ++copy) {
                const auto size = static_cast<float>(body.size(run_, copy));
                print("{}({}, {}, {})", copy == 0 ? "" : ", ", size, size, size);
            }
            print("]\n");
        }
        if (style_.colors_copies_of(body)) {
            print("        color3f[] primvars:displayColor = [");
            for (int copy = 0; copy < body.copies; ++copy) {
                print("{}{}", copy == 0 ? "" : ", ", usd_float3(style_.color(copy)));
            }
            print("] (\n            interpolation = \"vertex\"\n        )\n");
        }
        write_array("point3f[] positions", copies, [&](std::size_t copy, std::size_t frame) {
            return usd_float3(poses[copy][frame].position);
        });
        write_array("quath[] orientations", copies, [&](std::size_t copy, std::size_t frame) {
            return quath(poses[copy][frame].orientation);
        });
        write_array("quatf[] orientationsf", copies, [&](std::size_t copy, std::size_t frame) {
            return quatf(poses[copy][frame].orientation);
        });
        // Between the samples readers go on by these, and motion blur is drawn by them. A still has none.
        if (codes_.size() > 1) {
            write_array("vector3f[] velocities", copies, [&](std::size_t copy, std::size_t frame) {
                return usd_float3(poses[copy][frame].velocity);
            });
            write_array("vector3f[] angularVelocities", copies, [&](std::size_t copy, std::size_t frame) {
                return usd_float3(poses[copy][frame].angular_velocity * (180.0 / std::numbers::pi));
            });
        }
        samples_ += 2 * copies * codes_.size();
        print(
            "\n        def Scope \"prototypes\"\n        {{\n            def Xform \"shape\"\n"
            "            {{\n{}            }}\n        }}\n    }}\n",
            shape_of(body, 16));
    }

    /// Returns the farthest that a point of any copy is from the shape's origin (m).
    [[nodiscard]] double reach_of(const BodyMotion& body) const {
        double reach = 0.0;
        const DisplayMesh* display = body.display.get();
        const auto& shown = display == nullptr ? body.surface.vertices : display->positions;
        for (const Vector3d& vertex : shown) reach = std::max(reach, vertex.norm());
        double largest = body.size(run_, 0);
        for (int copy = 1; copy < body.copies; ++copy) largest = std::max(largest, body.size(run_, copy));
        return largest * reach;
    }

    /// Writes an array at every frame, or the value of a still, its values by value_at(item, frame).
    template <typename ValueAt>
    void write_array(const char* declaration, std::size_t items, const ValueAt& value_at) {
        const auto print_values = [&](std::size_t frame) {
            print("[{}", value_at(0, frame));
            for (std::size_t item = 1; item < items; ++item) print(", {}", value_at(item, frame));
            print("]");
        };
        if (codes_.size() == 1) {
            print("        {} = ", declaration);
            print_values(0);
            print("\n");
            return;
        }
        print("        {}.timeSamples = {{\n", declaration);
        for (std::size_t frame = 0; frame < codes_.size(); ++frame) {
            print("            {}: ", codes_[frame]);
            print_values(frame);
            print(",\n");
        }
        print("        }}\n");
    }

    std::ostream& stream_;
    const Motion& motion_;
    int run_;
    const ImageFiles& images_;
    const CopyStyle& style_;
    std::vector<double> codes_;
    PrimNames names_;
    fmt::memory_buffer text_;
    std::size_t samples_ = 0;
};

}  // namespace

std::size_t write_usda(const std::filesystem::path& file, const Motion& motion, int run,
                       const std::optional<double>& tolerance, const CopyStyle& style) {
    require_float_range(file, motion, run);
    std::size_t samples = 0;
    const ImageFiles images = write_images(file, motion);
    replace_file_by_stream(file, [&](std::ostream& stream) {
        samples = Stage(stream, motion, run, images, style).write(tolerance);
    });
    return samples;
}

}  // namespace samara

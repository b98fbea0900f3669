#include "samara/export/usd_mesh.hpp"

#include <array>
#include <iterator>
#include <map>
#include <vector>

#include <fmt/format.h>

#include "samara/export/shaded_mesh.hpp"

namespace samara {
namespace {

constexpr std::size_t items_in_line = 8;

/// Returns a list [a, b, c] over several lines.
std::string usd_list(const std::vector<std::string>& items, const std::string& indent) {
    std::string text = "[";
    for (std::size_t i = 0; i < items.size(); ++i) {
        if (items.size() > items_in_line && i % items_in_line == 0) text += "\n" + indent + "    ";
        text += items[i];
        if (i + 1 < items.size()) text += (i + 1) % items_in_line == 0 ? "," : ", ";
    }
    if (items.size() > items_in_line) text += "\n" + indent;
    return text + "]";
}

/// Returns for each position the index of the first equal one.
std::vector<std::size_t> welded(const std::vector<Vector3d>& positions, std::vector<std::string>& points) {
    std::map<std::array<double, 3>, std::size_t> known;
    std::vector<std::size_t> indices;
    for (const Vector3d& p : positions) {
        const auto [place, is_new] = known.try_emplace({p.x(), p.y(), p.z()}, points.size());
        if (is_new) points.push_back(usd_float3(p));
        indices.push_back(place->second);
    }
    return indices;
}

template <typename Values, typename InWords>
std::string list_of(const Values& values, const std::string& indent, const InWords& in_words) {
    std::vector<std::string> items;
    items.reserve(values.size());
    for (const auto& value : values) items.push_back(in_words(value));
    return usd_list(items, indent);
}

/// Returns the indices of the faces of each material in use, by its number.
std::map<std::int32_t, std::vector<std::size_t>> faces_by_slot(const DisplayMesh& display) {
    std::map<std::int32_t, std::vector<std::size_t>> faces;
    for (std::size_t i = 0; i < display.slots.size(); ++i) faces[display.slots[i]].push_back(i);
    return faces;
}

/// Returns a preview surface; where there is an image, its texture and what reads the UVs.
std::string usd_material(const std::string& name, const DisplayMaterial& material,
                         const std::vector<std::string>& image_files, const std::string& outer) {
    const std::string inner = outer + "    ";
    const std::string innermost = inner + "    ";
    const std::array<double, 4>& color = material.color;
    fmt::memory_buffer text;
    const auto line = std::back_inserter(text);
    fmt::format_to(line,
                   "\n{0}def Material \"{3}\"\n{0}{{\n{1}token outputs:surface.connect = "
                   "<preview.outputs:surface>\n\n"
                   "{1}def Shader \"preview\"\n{1}{{\n{2}uniform token info:id = \"UsdPreviewSurface\"\n",
                   outer, inner, innermost, name);
    if (material.image < 0) {
        fmt::format_to(
            line, "{0}color3f inputs:diffuseColor = ({1}, {2}, {3})\n{0}float inputs:opacity = {4}\n",
            innermost, usd_float(color[0]), usd_float(color[1]), usd_float(color[2]), usd_float(color[3]));
    } else {
        fmt::format_to(line, "{0}color3f inputs:diffuseColor.connect = <../image.outputs:rgb>\n", innermost);
        if (material.transparency != DisplayTransparency::none) {
            fmt::format_to(line, "{}float inputs:opacity.connect = <../image.outputs:a>\n", innermost);
        }
        if (material.transparency == DisplayTransparency::cut_out) {
            fmt::format_to(line, "{}float inputs:opacityThreshold = 0.5\n", innermost);
        }
    }
    fmt::format_to(line, "{1}float inputs:roughness = 0.6\n{1}token outputs:surface\n{0}}}\n", inner,
                   innermost);
    if (material.image >= 0) {
        fmt::format_to(line,
                       "\n{0}def Shader \"image\"\n{0}{{\n{1}uniform token info:id = \"UsdUVTexture\"\n"
                       "{1}asset inputs:file = @{2}@\n{1}float4 inputs:scale = ({3}, {4}, {5}, {6})\n"
                       "{1}token inputs:sourceColorSpace = \"sRGB\"\n"
                       "{1}float2 inputs:st.connect = <../uv.outputs:result>\n"
                       "{1}token inputs:wrapS = \"repeat\"\n{1}token inputs:wrapT = \"repeat\"\n"
                       "{1}float outputs:a\n{1}float3 outputs:rgb\n{0}}}\n"
                       "\n{0}def Shader \"uv\"\n{0}{{\n"
                       "{1}uniform token info:id = \"UsdPrimvarReader_float2\"\n"
                       "{1}string inputs:varname = \"st\"\n{1}float2 outputs:result\n{0}}}\n",
                       inner, innermost, image_files[static_cast<std::size_t>(material.image)],
                       usd_float(color[0]), usd_float(color[1]), usd_float(color[2]), usd_float(color[3]));
    }
    fmt::format_to(line, "{}}}\n", outer);
    return fmt::to_string(text);
}

}  // namespace

std::string usd_float(double value) {
    return fmt::format("{}", static_cast<float>(value));
}

std::string usd_float3(const Vector3d& vector) {
    return fmt::format("({}, {}, {})", static_cast<float>(vector.x()), static_cast<float>(vector.y()),
                       static_cast<float>(vector.z()));
}

std::string usd_mesh(const Surface& surface, std::size_t indent, const std::optional<double>& grey,
                     bool double_sided) {
    const ShadedMesh mesh = shaded_mesh(surface);
    std::vector<std::string> points;
    const std::vector<std::size_t> point_of = welded(mesh.positions, points);
    const bool smooth = points.size() == mesh.positions.size();
    std::vector<std::string> counts;
    std::vector<std::string> indices;
    std::vector<std::string> normals;
    for (const auto& triangle : mesh.triangles) {
        counts.emplace_back("3");
        for (const std::uint32_t corner : triangle) {
            indices.push_back(fmt::format("{}", point_of[corner]));
            if (!smooth) normals.push_back(usd_float3(mesh.normals[corner]));
        }
    }
    if (smooth) {
        for (const Vector3d& normal : mesh.normals) normals.push_back(usd_float3(normal));
    }
    Eigen::AlignedBox3d box;
    for (const Vector3d& position : mesh.positions) box.extend(position);

    const std::string outer(indent, ' ');
    const std::string inner = outer + "    ";
    fmt::memory_buffer text;
    const auto line = std::back_inserter(text);
    fmt::format_to(line, "{}def Mesh \"mesh\"\n{}{{\n", outer, outer);
    fmt::format_to(line, "{}float3[] extent = [{}, {}]\n", inner, usd_float3(box.min()),
                   usd_float3(box.max()));
    fmt::format_to(line, "{}int[] faceVertexCounts = {}\n", inner, usd_list(counts, inner));
    fmt::format_to(line, "{}int[] faceVertexIndices = {}\n", inner, usd_list(indices, inner));
    fmt::format_to(line, "{}normal3f[] normals = {} (\n{}    interpolation = \"{}\"\n{})\n", inner,
                   usd_list(normals, inner), inner, smooth ? "vertex" : "faceVarying", inner);
    fmt::format_to(line, "{}point3f[] points = {}\n", inner, usd_list(points, inner));
    if (grey) fmt::format_to(line, "{0}color3f[] primvars:displayColor = [({1}, {1}, {1})]\n", inner, *grey);
    if (double_sided) fmt::format_to(line, "{}uniform bool doubleSided = true\n", inner);
    fmt::format_to(line, "{}uniform token subdivisionScheme = \"none\"\n{}}}\n", inner, outer);
    return fmt::to_string(text);
}

std::string usd_display(const DisplayMesh& display, const std::vector<std::string>& image_files,
                        std::size_t indent) {
    const std::string outer(indent, ' ');
    const std::string inner = outer + "    ";
    const std::string innermost = inner + "    ";
    const auto faces = faces_by_slot(display);
    PrimNames prim_name;
    prim_name("mesh");
    std::map<std::int32_t, std::string> names;
    for (const auto& [slot, of_slot] : faces) {
        names[slot] = prim_name(display.materials[static_cast<std::size_t>(slot)].name);
    }
    std::vector<std::int32_t> indices;
    for (const auto& triangle : display.corners)
        indices.insert(indices.end(), triangle.begin(), triangle.end());
    Eigen::AlignedBox3d box;
    for (const Vector3d& position : display.positions) box.extend(position);
    const auto number = [](auto value) { return fmt::format("{}", value); };

    fmt::memory_buffer text;
    const auto line = std::back_inserter(text);
    fmt::format_to(line, "{}def Mesh \"mesh\"\n{}{{\n", outer, outer);
    fmt::format_to(line, "{}float3[] extent = [{}, {}]\n", inner, usd_float3(box.min()),
                   usd_float3(box.max()));
    fmt::format_to(line, "{}int[] faceVertexCounts = {}\n", inner,
                   list_of(display.corners, inner, [](const auto&) { return std::string("3"); }));
    fmt::format_to(line, "{}int[] faceVertexIndices = {}\n", inner, list_of(indices, inner, number));
    if (!display.normals.empty()) {
        fmt::format_to(line, "{}normal3f[] normals = {} (\n{}    interpolation = \"vertex\"\n{})\n", inner,
                       list_of(display.normals, inner, usd_float3), inner, inner);
    }
    fmt::format_to(line, "{}point3f[] points = {}\n", inner, list_of(display.positions, inner, usd_float3));
    if (!display.texture.empty()) {
        const auto place = [](const Eigen::Vector2d& uv) {
            return fmt::format("({}, {})", usd_float(uv.x()), usd_float(uv.y()));
        };
        fmt::format_to(line, "{}texCoord2f[] primvars:st = {} (\n{}    interpolation = \"vertex\"\n{})\n",
                       inner, list_of(display.texture, inner, place), inner, inner);
    }
    fmt::format_to(
        line, "{0}uniform bool doubleSided = true\n{0}uniform token subdivisionScheme = \"none\"\n", inner);
    fmt::format_to(line, "{}uniform token subsetFamily:materialBind:familyType = \"partition\"\n", inner);
    for (const auto& [slot, of_slot] : faces) {
        fmt::format_to(
            line,
            "\n{0}def GeomSubset \"{2}\" (\n{1}prepend apiSchemas = [\"MaterialBindingAPI\"]\n{0})\n{0}{{\n"
            "{1}uniform token elementType = \"face\"\n{1}uniform token familyName = \"materialBind\"\n"
            "{1}int[] indices = {3}\n{1}rel material:binding = <../../{2}>\n{0}}}\n",
            inner, innermost, names[slot], list_of(of_slot, innermost, number));
    }
    fmt::format_to(line, "{}}}\n", outer);
    for (const auto& [slot, name] : names) {
        const DisplayMaterial& material = display.materials[static_cast<std::size_t>(slot)];
        text.append(usd_material(name, material, image_files, outer));
    }
    return fmt::to_string(text);
}

}  // namespace samara

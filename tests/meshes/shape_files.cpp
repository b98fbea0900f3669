#include "meshes/shape_files.hpp"

#include <array>
#include <cstring>
#include <fstream>

#include <fmt/ostream.h>
#include <gmsh.h>

#include "meshes/reading/gmsh_session.hpp"
#include "paths.hpp"

namespace samara::test {
namespace {

const Vector3d& corner(const Surface& surface, std::size_t triangle, std::size_t index) {
    return surface.vertices[static_cast<std::size_t>(surface.corners[triangle][index])];
}

}  // namespace

void write_stl(const std::filesystem::path& file, const Surface& surface) {
    std::ofstream stream(file);
    stream << "solid test\n";
    for (std::size_t t = 0; t < surface.triangle_count(); ++t) {
        stream << "facet normal 0 0 0\nouter loop\n";
        for (std::size_t i = 0; i < 3; ++i) {
            const Vector3d& p = corner(surface, t, i);
            stream << fmt::format("vertex {} {} {}\n", p.x(), p.y(), p.z());
        }
        stream << "endloop\nendfacet\n";
    }
    stream << "endsolid test\n";
}

void write_binary_stl(const std::filesystem::path& file, const Surface& surface) {
    std::ofstream stream(file, std::ios::binary);
    std::array<char, 80> header{};
    std::memcpy(header.data(), "solid that is binary", 20);
    stream.write(header.data(), header.size());
    const auto count = static_cast<std::uint32_t>(surface.triangle_count());
    stream.write(reinterpret_cast<const char*>(&count), sizeof count);
    for (std::size_t t = 0; t < surface.triangle_count(); ++t) {
        std::array<float, 12> values{};
        for (std::size_t i = 0; i < 9; ++i) {
            values[3 + i] = static_cast<float>(corner(surface, t, i / 3)[static_cast<Eigen::Index>(i % 3)]);
        }
        stream.write(reinterpret_cast<const char*>(values.data()), sizeof values);
        stream.write("\0", 2);
    }
}

void write_obj(const std::filesystem::path& file, const Surface& surface) {
    std::ofstream stream(file);
    stream << "mtllib missing.mtl\n";
    for (const Vector3d& p : surface.vertices) stream << fmt::format("v {} {} {}\n", p.x(), p.y(), p.z());
    for (const auto& [a, b, c] : surface.corners) stream << fmt::format("f {} {} {}\n", a + 1, b + 1, c + 1);
}

void write_with_gmsh(const std::filesystem::path& file, const std::function<void()>& build) {
    const GmshSession session;
    build();
    gmsh::write(file.string());
}

std::filesystem::path shape_of_samara(const std::string& name) {
    return std::filesystem::path(SAMARA_SOURCE_DIRECTORY) / "meshes/shapes" / name;
}

std::filesystem::path shape_of_tests(const std::string& name) {
    return std::filesystem::path(SAMARA_SOURCE_DIRECTORY) / "tests/meshes/shapes" / name;
}

}  // namespace samara::test

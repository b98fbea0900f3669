#include "meshes/reading/shape_reader.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include <Model/COM/NMR_DLLInterfaces.h>
#include <fmt/format.h>

#include "meshes/reading/gmsh_session.hpp"
#include "samara/core/base/error.hpp"
#include "samara/core/body/body_file.hpp"
#include "samara/core/files/confined_process.hpp"
#include "samara/core/surface/obj_file.hpp"
#include "samara/core/surface/stl_file.hpp"
#include "samara/core/surface/welded_surface.hpp"
#include "samara/formats/display_mesh_file.hpp"

namespace samara {
namespace {

Surface read_msh_file(const std::filesystem::path& file) {
    const GmshSession session;
    Surface surface;
    GmshSession::open(file.string());
    GmshSession::run(file.string(), "gmsh cannot read it",
                     [&] { surface = surface_of_model(file.string()); });
    return surface;
}

}  // namespace

Surface read_triangles(const std::filesystem::path& file, ShapeFormat format, double time_limit) {
    if (format == ShapeFormat::body) return read_body_file(file).surface;
    if (format == ShapeFormat::stl) return read_stl_file(file);
    if (format == ShapeFormat::obj) return read_obj_file(file);
    if (format == ShapeFormat::gltf) return surface_of(read_gltf_file(file));
    require_beginning(file, format);
    return confined_surface(file, time_limit, [&](const std::function<void(double)>&) {
        if (format == ShapeFormat::three_mf) return read_3mf_file(file);
        return format == ShapeFormat::msh ? read_msh_file(file) : read_polygon_file(file, format);
    });
}

namespace {

std::string extension_of(const std::filesystem::path& file) {
    if (is_body_file_name(file)) return ".body.h5";
    std::string extension = file.extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return extension;
}

}  // namespace

bool is_geometry(ShapeFormat format) {
    return format == ShapeFormat::script || format == ShapeFormat::step || format == ShapeFormat::brep;
}

bool is_read_by_gmsh(ShapeFormat format) {
    return is_geometry(format) || format == ShapeFormat::msh;
}

ShapeFormat shape_format(const std::filesystem::path& file) {
    static const std::map<std::string_view, ShapeFormat> formats = {
        {".geo", ShapeFormat::script},  {".step", ShapeFormat::step},    {".stp", ShapeFormat::step},
        {".brep", ShapeFormat::brep},   {".stl", ShapeFormat::stl},      {".obj", ShapeFormat::obj},
        {".ply", ShapeFormat::ply},     {".off", ShapeFormat::off},      {".glb", ShapeFormat::gltf},
        {".gltf", ShapeFormat::gltf},   {".3mf", ShapeFormat::three_mf}, {".msh", ShapeFormat::msh},
        {".body.h5", ShapeFormat::body}};
    const auto found = formats.find(extension_of(file));
    if (found == formats.end()) {
        throw Error(
            fmt::format("{}: has an unknown format; give a .geo, .step, .stp, .brep, .stl, .obj, .ply, .off, "
                        ".glb, .gltf, .3mf, .msh or .body.h5 file (Blender opens most other meshes and "
                        "exports .stl, FreeCAD most geometry and exports .step)",
                        file.string()));
    }
    std::error_code unknown;
    const std::filesystem::file_status status = std::filesystem::status(file, unknown);
    if (!std::filesystem::is_regular_file(status)) {
        const bool missing = status.type() == std::filesystem::file_type::not_found;
        const std::string reason = missing ? "does not exist" : unknown ? unknown.message() : "is not a file";
        throw Error(fmt::format("{}: {}", file.string(), reason));
    }
    return found->second;
}

void require_beginning(const std::filesystem::path& file, ShapeFormat format) {
    std::array<char, 1024> block{};
    std::ifstream stream(file, std::ios::binary);
    if (!stream) throw Error(fmt::format("{}: cannot be read: {}", file.string(), std::strerror(errno)));
    stream.read(block.data(), block.size());
    const std::string_view start(block.data(), static_cast<std::size_t>(stream.gcount()));
    const auto require = [&](bool holds, const char* name, const char* beginning) {
        if (holds) return;
        const std::string what = start.empty() ? "is empty" : fmt::format("is not a valid {} file", name);
        throw Error(fmt::format("{}: {}: a file of this type begins with {}; export it again", file.string(),
                                what, beginning));
    };
    if (format == ShapeFormat::step) {
        require(start.find("ISO-10303-21") != std::string_view::npos, "STEP", "ISO-10303-21");
    } else if (format == ShapeFormat::brep) {
        require(start.find("CASCADE Topology") != std::string_view::npos, "BREP", "CASCADE Topology");
    } else if (format == ShapeFormat::msh) {
        // The beginnings of later versions, of the first version, and of files with a comment.
        const bool holds =
            start.starts_with("$MeshFormat") || start.starts_with("$NOD") || start.starts_with("$Comments");
        require(holds, "MSH", "$MeshFormat");
    }
}

namespace {

struct Release {
    void operator()(NMR::PLib3MFBase* object) const { NMR::lib3mf_release(object); }
};
using Object = std::unique_ptr<NMR::PLib3MFBase, Release>;

// Metres of each unit, by the number of lib3mf's eModelUnit: micrometre, millimetre, centimetre, inch, foot,
// metre.
constexpr std::array<double, 6> metres = {1e-6, 1e-3, 1e-2, 0.0254, 0.3048, 1.0};

class Reader {
  public:
    explicit Reader(std::string label) : label_(std::move(label)) {
        NMR::PLib3MFModel* model = nullptr;
        require(NMR::lib3mf_createmodel(&model), nullptr);
        model_.reset(model);
    }

    void read(const std::string& file) {
        NMR::PLib3MFModelReader* reader = nullptr;
        require(NMR::lib3mf_model_queryreader(model_.get(), "3mf", &reader), model_.get());
        const Object held(reader);
        require(NMR::lib3mf_reader_readfromfileutf8(reader, file.c_str()), reader);
    }

    [[nodiscard]] double unit() const {
        DWORD number = 0;
        require(NMR::lib3mf_model_getunit(model_.get(), &number), model_.get());
        return metres.at(std::min<std::size_t>(number, metres.size() - 1));
    }

    // Returns all built objects at their places as an STL file, into which lib3mf resolves them itself.
    [[nodiscard]] std::string built() const {
        NMR::PLib3MFModelWriter* writer = nullptr;
        require(NMR::lib3mf_model_querywriter(model_.get(), "stl", &writer), model_.get());
        const Object held(writer);
        ULONG64 size = 0;
        require(NMR::lib3mf_writer_getstreamsize(writer, &size), writer);
        std::string bytes(size, '\0');
        require(NMR::lib3mf_writer_writetobuffer(writer, reinterpret_cast<BYTE*>(bytes.data()), size),
                writer);
        return bytes;
    }

  private:
    void require(LIB3MFRESULT result, NMR::PLib3MFBase* object) const {
        if (result == 0) return;
        DWORD code = 0;
        LPCSTR reason = nullptr;
        if (object != nullptr) NMR::lib3mf_getlasterror(object, &code, &reason);
        throw Error(fmt::format("{}: is not a valid 3MF file: {}; export it again, or as .stl", label_,
                                reason == nullptr ? "lib3mf cannot read it" : reason));
    }

    std::string label_;
    Object model_;
};

}  // namespace

Surface read_3mf_file(const std::filesystem::path& file) {
    Reader reader(file.string());
    reader.read(file.string());
    Surface surface = read_stl(reader.built(), file.string());
    if (surface.corners.empty()) {
        throw Error(
            fmt::format("{}: contains no object with triangles; export the model again", file.string()));
    }
    const double unit = reader.unit();
    for (Vector3d& vertex : surface.vertices) vertex *= unit;
    return surface;
}

namespace {

// A message of the confined process holds a share of the work or, at the end, a surface: its lists one after
// the other, each with its length.
constexpr char share_tag = 'p';
constexpr char surface_tag = 's';

static_assert(std::is_trivially_copyable_v<std::array<std::int32_t, 3>>);
static_assert(sizeof(Vector3d) == 3 * sizeof(double));

template <typename Item>
void append(std::string& bytes, const std::vector<Item>& list) {
    const std::uint64_t size = list.size() * sizeof(Item);
    bytes.append(reinterpret_cast<const char*>(&size), sizeof size);
    bytes.append(reinterpret_cast<const char*>(list.data()), size);
}

// Takes a list off the front of the bytes; returns whether there was a whole one.
template <typename Item>
bool take(std::string_view& bytes, std::vector<Item>& list) {
    std::uint64_t size = 0;
    if (bytes.size() < sizeof size) return false;
    std::memcpy(&size, bytes.data(), sizeof size);
    bytes.remove_prefix(sizeof size);
    if (size > bytes.size() || size % sizeof(Item) != 0) return false;
    list.resize(size / sizeof(Item));
    if (size > 0) std::memcpy(static_cast<void*>(list.data()), bytes.data(), size);
    bytes.remove_prefix(size);
    return true;
}

Surface unpacked(std::string_view bytes, const std::string& label) {
    Surface surface;
    const bool whole = take(bytes, surface.vertices) && take(bytes, surface.corners) &&
                       take(bytes, surface.edge_nodes) && bytes.empty();
    if (!whole || (surface.order() == 2 && surface.edge_nodes.size() != surface.corners.size())) {
        throw Error(
            fmt::format("{}: the reader process returned a damaged surface; export the model again", label));
    }
    labelled(label, [&] { require_usable_numbers(surface); });
    return surface;
}

}  // namespace

std::vector<Surface> confined_surfaces(
    const std::filesystem::path& shape, std::size_t count, double time_limit,
    const std::function<std::vector<Surface>(const std::function<void(double)>& progress)>& read,
    const std::function<void(double)>& progress) {
    ConfinedLimits limits;
    limits.cpu_seconds = time_limit;
    // The folder of the name and, where that is a link, of the file.
    for (const std::filesystem::path& file :
         {std::filesystem::absolute(shape), std::filesystem::canonical(shape)}) {
        limits.readable.push_back(file.parent_path());
    }
    std::vector<Surface> surfaces;
    run_confined(
        shape.string(), limits,
        [&](const SendBytes& send) {
            const std::vector<Surface> results = read([&](double share) {
                std::string bytes(1, share_tag);
                send(bytes.append(reinterpret_cast<const char*>(&share), sizeof share));
            });
            for (const Surface& result : results) {
                std::string bytes(1, surface_tag);
                append(bytes, result.vertices);
                append(bytes, result.corners);
                append(bytes, result.edge_nodes);
                send(bytes);
            }
        },
        [&](std::string_view bytes) {
            double share = 0.0;
            if (bytes.starts_with(surface_tag) && surfaces.size() < count) {
                surfaces.push_back(unpacked(bytes.substr(1), shape.string()));
            } else if (progress && bytes.size() == 1 + sizeof share) {
                std::memcpy(&share, bytes.data() + 1, sizeof share);
                progress(share);
            }
        });
    if (surfaces.size() != count) {
        throw Error(fmt::format("{}: the reader process returned a damaged surface; export the model again",
                                shape.string()));
    }
    return surfaces;
}

Surface confined_surface(const std::filesystem::path& shape, double time_limit,
                         const std::function<Surface(const std::function<void(double)>& progress)>& read,
                         const std::function<void(double)>& progress) {
    return confined_surfaces(
               shape, 1, time_limit,
               [&](const std::function<void(double)>& tell) { return std::vector<Surface>{read(tell)}; },
               progress)
        .front();
}

}  // namespace samara

#include "samara/core/body/body_file.hpp"

#include <algorithm>
#include <limits>

#include <fmt/format.h>

#include "samara/core/base/error.hpp"
#include "samara/core/base/version.hpp"
#include "samara/core/body/body_check.hpp"
#include "samara/core/body/body_file_groups.hpp"
#include "samara/core/body/file_arrays.hpp"
#include "samara/core/files/content_hash.hpp"
#include "samara/core/files/hdf5_reader.hpp"
#include "samara/core/files/hdf5_writer.hpp"

namespace samara {
namespace {

constexpr std::int64_t format_version = 1;
constexpr const char* suffix = ".body.h5";

Vector3d as_vector(const std::vector<double>& values) {
    return from_row_major<Vector3d>(values);
}

Symmetry::Type symmetry_type(const Hdf5Reader& file) {
    const std::string type = file.text_attribute("/symmetry", "kind");
    if (type == "finite") return Symmetry::Type::finite;
    if (type == "axial") return Symmetry::Type::axial;
    if (type == "spherical") return Symmetry::Type::spherical;
    throw Error(fmt::format("{}: the symmetry kind '{}' is unknown; make the file again",
                            file.path().string(), type));
}

void write_symmetry(Hdf5Writer& file, const Symmetry& symmetry) {
    std::vector<double> elements;
    for (const Matrix3d& element : symmetry.elements) {
        const std::vector<double> values = row_major(element);
        elements.insert(elements.end(), values.begin(), values.end());
    }
    file.write("/symmetry/elements", elements, {symmetry.elements.size(), 3, 3}, "1",
               "orthogonal matrices that map the surface onto itself about the centroid, the identity first");
    file.write("/symmetry/axis", row_major(symmetry.axis), {3}, "1",
               "axis of revolution, where kind is axial");
    file.write("/symmetry/axes", row_major(symmetry.axes), {3, 3}, "1",
               "columns: frame aligned with the symmetry");
    file.attribute("/symmetry", "kind", std::string_view(name_of(symmetry.type)));
    file.attribute("/symmetry", "tolerance", symmetry.tolerance);
}

Symmetry read_symmetry(const Hdf5Reader& file) {
    Symmetry symmetry;
    symmetry.type = symmetry_type(file);
    const std::vector<double> values = file.finite_doubles("/symmetry/elements", {0, 3, 3});
    symmetry.elements.clear();
    for (std::size_t i = 0; i < values.size(); i += 9) {
        symmetry.elements.push_back(
            Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(&values[i]));
    }
    symmetry.axis = as_vector(file.finite_doubles("/symmetry/axis", {3}));
    symmetry.axes = from_row_major<Matrix3d>(file.finite_doubles("/symmetry/axes", {3, 3}));
    symmetry.tolerance = file.number_attribute("/symmetry", "tolerance");
    return symmetry;
}

void write_kirchhoff(Hdf5Writer& file, const KirchhoffTensor& kirchhoff) {
    file.write("/kirchhoff/added_mass", row_major(kirchhoff.matrix), {6, 6}, "m^5, m^4, m^3",
               "order (omega, v), about the centroid of the volume, shape axes, fluid density 1 kg/m^3");
    file.attribute("/kirchhoff", "error_estimate", kirchhoff.error_estimate);
    file.attribute("/kirchhoff", "asymmetry", kirchhoff.asymmetry);
    file.attribute("/kirchhoff", "triangles", std::int64_t{kirchhoff.triangles});
    file.attribute("/kirchhoff", "method", std::string_view(kirchhoff.method));
}

KirchhoffTensor read_kirchhoff(const Hdf5Reader& file) {
    KirchhoffTensor kirchhoff;
    kirchhoff.matrix = from_row_major<Matrix6d>(file.finite_doubles("/kirchhoff/added_mass", {6, 6}));
    kirchhoff.error_estimate = file.number_attribute("/kirchhoff", "error_estimate");
    kirchhoff.asymmetry = file.number_attribute("/kirchhoff", "asymmetry");
    kirchhoff.triangles = static_cast<int>(std::clamp<std::int64_t>(
        file.integer_attribute("/kirchhoff", "triangles"), -1, std::numeric_limits<int>::max()));
    kirchhoff.method = file.text_attribute("/kirchhoff", "method");
    return kirchhoff;
}

void write_shape_error(Hdf5Writer& file, const ShapeError& error) {
    file.attribute("/surface", "shape_distance", error.distance);
    file.attribute("/surface", "shape_mean_distance", error.mean_distance);
    file.attribute("/surface", "shape_volume", error.volume);
    file.attribute("/surface", "shape_area", error.area);
    file.attribute("/surface", "shape_faceting", error.faceting);
}

ShapeError read_shape_error(const Hdf5Reader& file) {
    const auto number = [&](const char* name) { return file.number_attribute("/surface", name); };
    return {number("shape_distance"), number("shape_mean_distance"), number("shape_volume"),
            number("shape_area"), number("shape_faceting")};
}

struct TableColumn {
    const char* name;
    int components;
    const char* meaning;
};

constexpr TableColumn table_columns[] = {
    {"force", 3, "F / (rho U^2 A / 2), body axes"},
    {"moment", 3, "M / (rho U^2 A L / 2) about the centroid of the volume, body axes"},
    {"turbulent_kinetic_energy", 1, "k / U^2, the mean that /tables names as turbulence_mean"},
    {"dissipation_rate", 1, "epsilon L / U^3, the same mean"},
};

double& component(LoadEntry& entry, std::size_t column, int index) {
    switch (column) {
        case 0:
            return entry.force[index];
        case 1:
            return entry.moment[index];
        case 2:
            return entry.turbulent_kinetic_energy;
        default:
            return entry.dissipation_rate;
    }
}

void write_entries(Hdf5Writer& file, const LoadTables& tables, std::vector<LoadEntry> entries,
                   const char* name_end) {
    const auto size = static_cast<hsize_t>(tables.map_size());
    for (std::size_t column = 0; column < std::size(table_columns); ++column) {
        const auto& [name, components, meaning] = table_columns[column];
        std::vector<double> values;
        for (LoadEntry& entry : entries) {
            for (int i = 0; i < components; ++i) values.push_back(component(entry, column, i));
        }
        std::vector<hsize_t> dimensions = {tables.reynolds_numbers.size(), size, size};
        if (components > 1) dimensions.push_back(static_cast<hsize_t>(components));
        file.write(fmt::format("/tables/{}{}", name, name_end), values, dimensions, "1",
                   *name_end == '\0' ? meaning : "standard error of the table of the same name");
    }
}

std::vector<LoadEntry> read_entries(const Hdf5Reader& file, const LoadTables& tables, const char* name_end) {
    const auto size = static_cast<hsize_t>(tables.map_size());
    std::vector<LoadEntry> entries;
    for (std::size_t column = 0; column < std::size(table_columns); ++column) {
        const auto& [name, components, meaning] = table_columns[column];
        std::vector<hsize_t> dimensions = {tables.reynolds_numbers.size(), size, size};
        if (components > 1) dimensions.push_back(static_cast<hsize_t>(components));
        const std::vector<double> values =
            file.finite_doubles(fmt::format("/tables/{}{}", name, name_end), dimensions);
        entries.resize(values.size() / static_cast<std::size_t>(components));
        std::size_t next = 0;
        for (LoadEntry& entry : entries) {
            for (int i = 0; i < components; ++i) component(entry, column, i) = values[next++];
        }
    }
    return entries;
}

void write_tables(Hdf5Writer& file, const LoadTables& tables) {
    file.write("/tables/reynolds_number", tables.reynolds_numbers, {tables.reynolds_numbers.size()}, "1",
               "U L / nu, ascending");
    file.write("/tables/axes", row_major(tables.axes), {3, 3}, "1",
               "columns: the octahedral map's axes in body axes");
    write_entries(file, tables, tables.entries, "");
    write_entries(file, tables, tables.errors, "_error");
    write_table_errors(file, tables);
    write_planned_region(file, tables.plan);
    file.write_text("/tables/provenance", tables.provenance, "JSON: how each case was solved");
    file.attribute("/tables", "reference_length", tables.reference_length);
    file.attribute("/tables", "subdivisions", std::int64_t{tables.subdivisions});
    file.attribute("/tables", "quality", std::string_view(tables.quality));
    file.attribute("/tables", "turbulence_mean", std::string_view(name_of(tables.turbulence_mean)));
}

LoadTables read_tables(const Hdf5Reader& file) {
    LoadTables tables;
    tables.reference_length = file.number_attribute("/tables", "reference_length");
    const std::int64_t subdivisions = file.integer_attribute("/tables", "subdivisions");
    tables.quality = file.text_attribute("/tables", "quality");
    tables.axes = from_row_major<Matrix3d>(file.finite_doubles("/tables/axes", {3, 3}));
    tables.reynolds_numbers = file.finite_doubles("/tables/reynolds_number", {0});
    const auto error = [&](const char* what) {
        return Error(fmt::format("{}: /tables {}; bake the body again", file.path().string(), what));
    };
    tables.turbulence_mean = TurbulenceMean::shell;
    if (file.has_attribute("/tables", "turbulence_mean")) {
        const std::string mean = file.text_attribute("/tables", "turbulence_mean");
        if (mean == name_of(TurbulenceMean::near_wake))
            tables.turbulence_mean = TurbulenceMean::near_wake;
        else if (mean != name_of(TurbulenceMean::shell))
            throw error("has an unknown turbulence_mean");
    }
    if (subdivisions < 1 || subdivisions > 1024) throw error("has a map of an invalid size");
    tables.subdivisions = static_cast<int>(subdivisions);
    if (!(tables.reference_length > 0.0)) throw error("has a reference length that is not positive");
    if (tables.reynolds_numbers.empty() || tables.reynolds_numbers.front() <= 0.0) {
        throw error("has a Reynolds number that is not positive");
    }
    for (std::size_t i = 1; i < tables.reynolds_numbers.size(); ++i) {
        if (tables.reynolds_numbers[i] <= tables.reynolds_numbers[i - 1]) {
            throw error("has Reynolds numbers that do not ascend");
        }
    }
    tables.entries = read_entries(file, tables, "");
    tables.errors = read_entries(file, tables, "_error");
    read_table_errors(file, tables);
    tables.plan = read_planned_region(file);
    tables.provenance = file.json_text("/tables/provenance");
    return tables;
}

/// Returns an upper bound of the file's size (bytes). HDF5 crashes where it finds no room while it writes.
std::uintmax_t expected_size(const Body& body) {
    constexpr std::uintmax_t texts_and_small_parts = 4U << 20U;
    std::uintmax_t bytes = body.surface.vertices.size() * 24 + body.surface.corners.size() * 24;
    if (body.tables) bytes += body.tables->entries.size() * (sizeof(LoadEntry) + sizeof(LoadEntryError));
    return 2 * bytes + texts_and_small_parts;
}

}  // namespace

Body read_body_file(const std::filesystem::path& path) {
    const Hdf5Reader file(path);
    if (!file.has("/surface") || !file.has("/moments")) {
        throw Error(fmt::format("{}: is an HDF5 file, but not a body file; make one with 'samara mesh'",
                                path.string()));
    }
    if (const auto found = file.integer_attribute("/", "format_version"); found > format_version) {
        throw Error(
            fmt::format("{}: was written by a newer version of samara (format {}, this one reads {}); update",
                        path.string(), found, format_version));
    }
    Body body;
    body.name = file.text_attribute("/", "name");
    body.source = file.text_attribute("/surface", "source");
    body.surface = read_surface(file, "/surface");
    body.moments.volume = file.number_attribute("/moments", "volume");
    body.moments.surface_area = file.number_attribute("/moments", "surface_area");
    body.moments.centroid = as_vector(file.finite_doubles("/moments/centroid", {3}));
    body.moments.second_moments =
        from_row_major<Matrix3d>(file.finite_doubles("/moments/second_moments", {3, 3}));
    body.symmetry = read_symmetry(file);
    if (file.has_attribute("/surface", "shape_distance")) body.shape_error = read_shape_error(file);
    if (file.has("/kirchhoff")) body.kirchhoff = read_kirchhoff(file);
    if (has_surface_loads(file)) body.surface_loads = read_surface_loads(file);
    if (file.has("/tables")) body.tables = read_tables(file);
    if (file.has("/dynamic_coefficients")) body.dynamic = read_dynamic_coefficients(file);
    if (file.has("/mass")) body.mass = read_mass(file);
    if (file.has("/recommended")) body.recommended = read_recommended_models(file);
    if (const std::string error = error_of(body); !error.empty()) {
        throw Error(fmt::format("{}: {}; make the file again", path.string(), error));
    }
    return body;
}

void write_body_file(const std::filesystem::path& path, const Body& body) {
    write_hdf5(path, [&](Hdf5Writer& file) {
        try {
            file.expect_size(expected_size(body));
        } catch (const Error& error) {
            throw Error(fmt::format("{}: {}; write to another place", path.string(), error.what()));
        }
        file.attribute("/", "format_version", format_version);
        file.attribute("/", "samara_version", std::string_view(version));
        file.attribute("/", "name", std::string_view(body.name));
        write_surface(file, "/surface", body.surface);
        file.attribute("/surface", "source", std::string_view(body.source));
        if (body.shape_error) write_shape_error(file, *body.shape_error);
        file.attribute("/moments", "volume", body.moments.volume);
        file.attribute("/moments", "surface_area", body.moments.surface_area);
        file.write("/moments/centroid", row_major(body.moments.centroid), {3}, "m",
                   "of the volume, shape axes");
        file.write("/moments/second_moments", row_major(body.moments.second_moments), {3, 3}, "m^5",
                   "integral of x x^T over the volume about the centroid, shape axes");
        write_symmetry(file, body.symmetry);
        if (body.kirchhoff) write_kirchhoff(file, *body.kirchhoff);
        if (body.surface_loads) write_surface_loads(file, *body.surface_loads);
        if (body.tables) write_tables(file, *body.tables);
        if (body.dynamic) write_dynamic_coefficients(file, *body.dynamic);
        if (body.mass) write_mass(file, *body.mass);
        if (body.recommended) write_recommended_models(file, *body.recommended);
    });
}

std::string surface_hash(const Surface& surface) {
    std::string bytes;
    const auto append = [&](const void* data, std::size_t size) {
        bytes.append(static_cast<const char*>(data), size);
    };
    for (const Vector3d& vertex : surface.vertices) append(vertex.data(), 3 * sizeof(double));
    for (const auto& triangle : surface.corners) append(triangle.data(), sizeof triangle);
    for (const auto& nodes : surface.edge_nodes) append(nodes.data(), sizeof nodes);
    return content_hash(bytes);
}

std::string body_name_of(const std::filesystem::path& file) {
    const std::string name = file.filename().string();
    if (is_body_file_name(file)) return name.substr(0, name.size() - std::string_view(suffix).size());
    return file.stem().string();
}

bool is_body_file_name(const std::filesystem::path& file) {
    return file.filename().string().ends_with(suffix);
}

}  // namespace samara

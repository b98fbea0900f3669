// samara.Body: what a body file holds.

#include <algorithm>
#include <cmath>
#include <filesystem>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <pybind11/eigen.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "bindings.hpp"
#include "samara/core/base/error.hpp"
#include "samara/core/body/body_file.hpp"
#include "samara/core/surface/octahedral_map.hpp"
#include "samara/pictures/body_pictures.hpp"

namespace samara::python {
namespace {

using SharedBody = std::shared_ptr<Body>;

SharedBody read(const std::filesystem::path& file) {
    const py::gil_scoped_release others_go_on;
    const std::lock_guard lock(hdf5_mutex());
    return on_input([&] { return std::make_shared<Body>(read_body_file(file)); }, file);
}

py::ssize_t length(std::size_t size) {
    return static_cast<py::ssize_t>(size);
}

/// Returns one member of all entries of the tables, shape (Reynolds numbers, rows, columns[, 3]).
template <typename Member>
py::object entries_view(const py::object& self, Member member,
                        const std::vector<LoadEntry> LoadTables::*entries) {
    const auto& body = self.cast<const Body&>();
    if (!body.tables || ((*body.tables).*entries).empty()) return py::none();
    const LoadTables& tables = *body.tables;
    const LoadEntry& first = (tables.*entries).front();
    const auto size = static_cast<py::ssize_t>(tables.map_size());
    std::vector<py::ssize_t> shape = {length(tables.reynolds_numbers.size()), size, size};
    constexpr py::ssize_t entry = sizeof(LoadEntry);
    std::vector<py::ssize_t> strides = {size * size * entry, size * entry, entry};
    const double* numbers = nullptr;
    if constexpr (std::is_same_v<Member, double LoadEntry::*>) {
        numbers = &(first.*member);
    } else {
        numbers = (first.*member).data();
        shape.push_back(3);
        strides.push_back(sizeof(double));
    }
    py::array array(py::dtype::of<double>(), shape, strides, numbers, self);
    array.attr("setflags")(py::arg("write") = false);
    return array;
}

/// Returns the property that shows them.
template <typename Member>
auto table_of(Member member, const std::vector<LoadEntry> LoadTables::*entries = &LoadTables::entries) {
    return [member, entries](const py::object& self) { return entries_view(self, member, entries); };
}

}  // namespace

void bind_body(py::module_& module) {
    auto body = class_of<Body, SharedBody>(
        module, "Body", "The content of a body file. Arrays are read-only views, which keep the body alive.");
    module.def(
        "_body_of_bytes",
        [](const py::bytes& bytes) {
            SharedBody result;
            with_file_of("pickled.body.h5", bytes,
                         [&](const std::filesystem::path& file) { result = read(file); });
            return result;
        },
        py::arg("bytes"));
    make_pickled(body, "samara", "_unpickled_body", [](const py::object& self) {
        return py::make_tuple(bytes_of_file("pickled.body.h5", [&](const std::filesystem::path& file) {
            const auto& pickled = self.cast<const Body&>();
            const py::gil_scoped_release others_go_on;
            const std::lock_guard lock(hdf5_mutex());
            write_body_file(file, pickled);
        }));
    });
    body.def_static("read", &read, py::arg("file"),
                    "Reads a body file (.body.h5). Raises FileError where it cannot be read, InputError "
                    "where its content is wrong.")
        .def_readonly("name", &Body::name, "Name of the body: that of its file or of its scene.")
        .def_readonly("source", &Body::source, "How the surface was made, in one line.")
        .def_property_readonly(
            "vertices",
            [](const py::object& self) {
                const auto& surface = self.cast<const Body&>().surface;
                return view(surface.vertices.data()->data(), {length(surface.vertices.size()), 3}, self);
            },
            "Vertices of the surface in m, shape axes, shape (n, 3).")
        .def_property_readonly(
            "triangles",
            [](const py::object& self) {
                const auto& surface = self.cast<const Body&>().surface;
                return view(surface.corners.data()->data(), {length(surface.corners.size()), 3}, self);
            },
            "Three vertex numbers for each triangle, anticlockwise seen from outside, shape (m, 3).")
        .def_property_readonly(
            "volume", [](const Body& body) { return body.moments.volume; }, "Volume in m^3.")
        .def_property_readonly(
            "surface_area", [](const Body& body) { return body.moments.surface_area; },
            "Surface area in m^2.")
        .def_property_readonly(
            "centroid", [](const Body& body) { return body.moments.centroid; },
            "Centroid of the volume in m, shape axes, shape (3,).")
        .def_property_readonly(
            "mass",
            [](const Body& body) -> std::optional<double> {
                if (!body.mass) return {};
                return mass_properties(body, *body.mass).mass;
            },
            "Mass in kg that the file gives, used where a scene gives none; or None.")
        .def_property_readonly(
            "recommended",
            [](const Body& body) -> py::object {
                if (!body.recommended) return py::none();
                py::dict models;
                models["loads"] = name_of(body.recommended->loads);
                models["patches"] = body.recommended->patches;
                models["turbulence"] = name_of(body.recommended->turbulence);
                return models;
            },
            "The scene's keys loads, patches and turbulence by which the file says that it is best "
            "simulated, used "
            "where a scene gives none, as a dict; or None.")
        .def_property_readonly(
            "kirchhoff_tensor",
            [](const Body& body) -> std::optional<Matrix6d> {
                if (!body.kirchhoff) return {};
                return body.kirchhoff->matrix;
            },
            "Added mass for a fluid of 1 kg/m^3, shape (6, 6): angular before linear velocity, about the "
            "centroid, shape axes; or None.")
        .def_property_readonly(
            "kirchhoff_error",
            [](const Body& body) -> std::optional<double> {
                if (!body.kirchhoff) return {};
                return body.kirchhoff->error_estimate;
            },
            "Estimated relative error of the Kirchhoff tensor, or None.")
        .def_property_readonly(
            "quality", [](const Body& body) { return body.tables ? body.tables->quality : std::string(); },
            "Quality of the bake: smoke, preview, standard or high; empty without tables.")
        .def_property_readonly(
            "reynolds_numbers",
            [](const py::object& self) -> py::object {
                const auto& tables = self.cast<const Body&>().tables;
                if (!tables) return py::none();
                return view(tables->reynolds_numbers.data(), {length(tables->reynolds_numbers.size())}, self);
            },
            "Reynolds numbers of the tables, ascending, shape (r,); None without tables.")
        .def_property_readonly(
            "table_directions",
            [](const Body& body) -> py::object {
                if (!body.tables) return py::none();
                const LoadTables& tables = *body.tables;
                const auto size = static_cast<py::ssize_t>(tables.map_size());
                py::array_t<double> array({size, size, py::ssize_t{3}});
                double* number = array.mutable_data();
                for (const Vector3d& node : octahedral_nodes(tables.subdivisions)) {
                    const Vector3d direction = tables.axes * node;
                    number = std::copy_n(direction.data(), 3, number);
                }
                array.attr("setflags")(py::arg("write") = false);
                return array;
            },
            "Directions of the tables' nodes: unit vectors of the velocity relative to the fluid, shape "
            "axes, "
            "shape (n, n, 3); None without tables.")
        .def_property_readonly("force_table", table_of(&LoadEntry::force),
                               "Force coefficients F / (rho U^2 A / 2) over the octahedral map of "
                               "directions, body axes, shape (r, n, n, 3); None without tables.")
        .def_property_readonly(
            "moment_table", table_of(&LoadEntry::moment),
            "Moment coefficients M / (rho U^2 A L / 2), in the layout of force_table; None without tables.")
        .def_property_readonly("force_error_table", table_of(&LoadEntry::force, &LoadTables::errors),
                               "Standard errors of force_table, in its layout, or None.")
        .def_property_readonly(
            "turbulent_kinetic_energy_table", table_of(&LoadEntry::turbulent_kinetic_energy),
            "k / U^2 over the octahedral map of directions, shape (r, n, n); None without tables.")
        .def_property_readonly(
            "dissipation_rate_table", table_of(&LoadEntry::dissipation_rate),
            "epsilon L / U^3, in the layout of turbulent_kinetic_energy_table; None without tables.")
        .def(
            "loads",
            [](const Body& body, const py::object& given, double reynolds_number) {
                const Vector3d direction(numbers_of<3>(given, "direction").data());
                if (!body.tables)
                    throw RaisedInputError(
                        fmt::format("{}: has no tables; make them with 'samara bake'", body.name));
                if (direction.isZero(0.0) || !direction.allFinite()) {
                    throw RaisedInputError("direction: give three finite numbers, not all zero");
                }
                if (!(reynolds_number > 0.0 && std::isfinite(reynolds_number))) {
                    throw RaisedInputError("reynolds_number: give a finite number above 0");
                }
                // In two steps, since the squares of its numbers may leave the range of numbers.
                const Vector3d scaled = direction / direction.cwiseAbs().maxCoeff();
                const LoadEntry entry = look_up(*body.tables, scaled.normalized(), reynolds_number);
                return std::make_pair(entry.force, entry.moment);
            },
            py::arg("direction"), py::arg("reynolds_number"),
            "Returns the tables' force and moment coefficients, each of shape (3,), for a body that moves in "
            "`direction` relative to the fluid: three numbers in shape axes, of any length but 0. Beyond the "
            "tables' range, the nearest Reynolds number counts. Raises InputError for a body without tables.")
        .def(
            "_picture",
            [](const Body& body, const std::string& picture) {
                return as_python(on_input([&] { return body_picture(picture, body); }));
            },
            py::arg("picture"), "Returns the data that samara.plot draws.")
        .def("__repr__", [](const Body& body) {
            return fmt::format("<samara.Body {}: {} triangles{}>", body.name, body.surface.triangle_count(),
                               body.tables ? ", tables of quality " + body.tables->quality : "");
        });
}

}  // namespace samara::python

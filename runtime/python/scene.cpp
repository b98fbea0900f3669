// samara.Scene: a scene file, a text of one, or a dict with the same keys.

#include <filesystem>
#include <sstream>

#include <fmt/format.h>
#include <pybind11/eigen.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>
#include <toml++/toml.h>

#include "bindings.hpp"
#include "samara/core/base/error.hpp"
#include "samara/scene/ready_bodies.hpp"
#include "samara/scene/scene_file.hpp"

namespace samara::python {
namespace {

constexpr int most_levels = 32;  // of lists and dicts within each other; scenes need six

RaisedInputError no_toml(const std::string& place, const py::handle& value) {
    return RaisedInputError(fmt::format("{} has the type {}; use numbers, strings, booleans, lists and dicts",
                                        place,
                                        py::str(py::type::of(value).attr("__name__")).cast<std::string>()));
}

/// Throws RaisedInputError where a scene nests deeper than any does, as one that contains itself.
void require_levels(const std::string& place, int level) {
    if (level <= most_levels) return;
    throw RaisedInputError(
        fmt::format("{}...: lists and dicts are nested more than {} deep; check that none contains itself",
                    place.substr(0, place.find('[', place.find('[') + 1)), most_levels));
}

std::string text_of(const py::handle& text, const std::string& place) {
    try {
        return text.cast<std::string>();
    } catch (const py::cast_error&) {
        throw RaisedInputError(fmt::format("{} holds a string that is not valid Unicode; correct it", place));
    }
}

std::int64_t whole_number(const py::handle& value, const std::string& place) {
    const auto number = py::reinterpret_steal<py::object>(PyNumber_Index(value.ptr()));
    if (!number) throw py::error_already_set();
    int overflow = 0;
    const long long result = PyLong_AsLongLongAndOverflow(number.ptr(), &overflow);
    if (overflow != 0)
        throw RaisedInputError(fmt::format("{} is an integer beyond 64 bits; give a smaller one", place));
    return result;
}

double real_number(const py::handle& value, const std::string& place) {
    const double number = PyFloat_AsDouble(value.ptr());
    if (PyErr_Occurred() == nullptr) return number;
    if (PyErr_ExceptionMatches(PyExc_OverflowError) == 0) throw py::error_already_set();
    PyErr_Clear();
    throw RaisedInputError(fmt::format("{} is beyond the range of numbers; give a smaller one", place));
}

/// Returns whether it is a number of numpy's or an array: numpy.bool_, numpy.float32(1), numpy.zeros(3).
bool is_numpys(const py::handle& value) {
    return py::hasattr(value, "dtype") && py::hasattr(value, "tolist");
}

toml::array as_toml_array(const py::handle& values, const std::string& place, int level);
toml::table as_toml_table(const py::dict& values, const std::string& place, int level);

/// Calls `put` with the value as TOML knows it. `place`: for messages, as in scene['body'][0]. `level`: in so
/// many lists and dicts.
template <typename Put>
void put_as_toml(const py::handle& value, const std::string& place, int level, const Put& put) {
    require_levels(place, level);
    const py::object plain = is_numpys(value) ? py::object(value.attr("tolist")()) : py::object();
    if (plain && !is_numpys(plain)) {  // a longdouble stays one
        put_as_toml(plain, place, level, put);
    } else if (py::isinstance<py::list>(value) || py::isinstance<py::tuple>(value)) {
        put(as_toml_array(value, place, level));
    } else if (py::isinstance<py::dict>(value)) {
        put(as_toml_table(py::reinterpret_borrow<py::dict>(value), place, level));
    } else if (py::isinstance<py::bool_>(value)) {
        put(value.cast<bool>());
    } else if (py::isinstance<py::str>(value)) {
        put(text_of(value, place));
    } else if (py::hasattr(value, "__fspath__")) {
        put(value.cast<std::filesystem::path>().string());
    } else if (py::hasattr(value, "__index__")) {
        put(whole_number(value, place));
    } else if (py::hasattr(value, "__float__")) {
        put(real_number(value, place));
    } else {
        throw no_toml(place, value);
    }
}

toml::array as_toml_array(const py::handle& values, const std::string& place, int level) {
    toml::array array;
    std::size_t index = 0;
    for (const py::handle value : py::iter(values)) {
        put_as_toml(value, fmt::format("{}[{}]", place, index++), level + 1,
                    [&](auto&& as_toml) { array.push_back(std::forward<decltype(as_toml)>(as_toml)); });
    }
    return array;
}

toml::table as_toml_table(const py::dict& values, const std::string& place, int level) {
    toml::table table;
    for (const auto& [key, value] : values) {
        if (!py::isinstance<py::str>(key)) {
            throw RaisedInputError(fmt::format("{} has the key {}; keys must be strings", place,
                                               py::repr(key).cast<std::string>()));
        }
        const std::string name = text_of(key, place);
        if (value.is_none()) continue;
        put_as_toml(value, fmt::format("{}['{}']", place, name), level + 1,
                    [&](auto&& as_toml) { table.insert(name, std::forward<decltype(as_toml)>(as_toml)); });
    }
    return table;
}

Scene scene_of_dict(const py::dict& values, const std::filesystem::path& folder) {
    const std::string text = toml_text(values, "scene");
    return read_dict("scene", [&] { return read_scene_text(text, "scene", folder); });
}

std::vector<std::string> names_of(const Scene& scene) {
    std::vector<std::string> names;
    for (const SceneBody& body : scene.bodies) names.push_back(body.name);
    return names;
}

}  // namespace

std::string toml_text(const py::dict& values, const std::string& place) {
    std::ostringstream text;
    text << as_toml_table(values, place, 0) << '\n';
    return text.str();
}

void bind_scene(py::module_& module) {
    class_of<Scene, std::shared_ptr<Scene>>(
        module, "Scene",
        "A checked scene: its bodies, their starts, the fluid and the surroundings. A Scene is immutable; "
        "make another one for other values.")
        .def(py::init(&scene_of_dict), py::arg("values"), py::arg("folder") = ".",
             "Makes a scene from a dict with the keys of a scene file: {'scene': {'duration': 2}, 'fluid': "
             "{...}, 'body': [{...}, ...]}. Keys whose value is None are left out; paths are relative to "
             "`folder`. Raises InputError where the scene is wrong.")
        .def_static(
            "read",
            [](const std::filesystem::path& file) {
                return on_input([&] { return read_scene_file(file); }, file);
            },
            py::arg("file"),
            "Reads a scene file (.toml); paths in it are relative to its folder. Raises FileError where it "
            "cannot be read, InputError where its content is wrong.")
        .def_static(
            "from_text",
            [](const std::string& text, const std::filesystem::path& folder) {
                return on_input([&] { return read_scene_text(text, "scene", folder); });
            },
            py::arg("text"), py::arg("folder") = ".",
            "Makes a scene from the text of a scene file; paths in it are relative to `folder`. Raises "
            "InputError where the scene is wrong.")
        .def_readonly("duration", &Scene::duration, "Duration in s.")
        .def_readonly("step", &Scene::step, "Time step in s.")
        .def_property_readonly(
            "precision",
            [](const Scene& scene) {
                return scene.precision == Precision::single_precision ? "single" : "double";
            },
            "The numbers that the steps are computed in: 'double' or 'single'.")
        .def_readonly("frame_rate", &Scene::frame_rate, "Frames per second.")
        .def_readonly("seed", &Scene::seed, "Seed of the noise and of the spread of starts.")
        .def_readonly("ground", &Scene::ground, "Height of the level ground in m, or None.")
        .def_property_readonly(
            "gravity", [](const Scene& scene) { return scene.gravity; },
            "Gravity in m/s^2, world axes, shape (3,).")
        .def_property_readonly("names", &names_of, "Names of the bodies, in the scene's order.")
        .def_readonly("text", &Scene::text, "The scene as the text of a scene file.")
        .def("__repr__", [](const Scene& scene) {
            return fmt::format("<samara.Scene of {} s: {}>", scene.duration,
                               fmt::join(names_of(scene), ", "));
        });
    module.def(
        "ready_bodies",
        [] {
            py::dict bodies;
            for (const ReadyBody& body : ready_bodies(ready_bodies_folder())) {
                if (body.exists) bodies[py::str(body.name)] = body.purpose;
            }
            return bodies;
        },
        "Returns the ready-baked bodies, which a scene names 'samara:NAME': a dict of each name and what it "
        "is for.");
}

}  // namespace samara::python

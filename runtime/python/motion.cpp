// samara.Motion: what is flown, read, measured, compared and shown.

#include <filesystem>
#include <fstream>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <pybind11/eigen.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "bindings.hpp"
#include "samara/analysis/comparison/comparison_report.hpp"
#include "samara/analysis/metrics/description.hpp"
#include "samara/analysis/metrics/ensemble.hpp"
#include "samara/core/base/error.hpp"
#include "samara/core/files/folders.hpp"
#include "samara/export/chan_file.hpp"
#include "samara/export/csv_file.hpp"
#include "samara/export/gltf_file.hpp"
#include "samara/export/page_file.hpp"
#include "samara/export/usd_file.hpp"
#include "samara/motion/measures.hpp"
#include "samara/motion/motion_file.hpp"
#include "samara/pictures/motion_pictures.hpp"

namespace samara::python {
namespace {

py::ssize_t length(std::size_t size) {
    return static_cast<py::ssize_t>(size);
}

FlownMotion read(const std::filesystem::path& file) {
    const py::gil_scoped_release others_go_on;
    const std::lock_guard lock(hdf5_mutex());
    return on_input(
        [&] {
            return FlownMotion{std::make_shared<const Motion>(read_motion_file(file)), nullptr};
        },
        file);
}

/// Runs work that writes a file; its Error becomes a RaisedFileError.
template <typename Work>
void to_file(const Work& work) {
    try {
        work();
    } catch (const Error& error) {
        throw RaisedFileError(error.what());
    }
}

void write(const FlownMotion& motion, const std::filesystem::path& file) {
    const py::gil_scoped_release others_go_on;
    const std::lock_guard lock(hdf5_mutex());
    to_file([&] { write_motion_file(file, *motion.motion); });
}

FlownMotion fly(Scene scene, int runs, std::optional<std::uint64_t> seed, std::optional<double> step,
                int threads, const std::filesystem::path& bodies, bool forces, py::object progress) {
    require_runs_and_threads(runs, threads);
    if (step && !(*step >= 1e-9 && *step <= 1e3))
        throw RaisedInputError("step: give seconds, from 1e-9 to 1000");
    LongWork work(std::move(progress));
    const auto flown = [&]() -> FlownMotion {
        // Judging models flies as well, and is ended by tell() as soon as the flight itself begins.
        const PreparedScene ready = prepared(
            std::move(scene), {.bodies = bodies.string(), .seed = seed, .step = step, .threads = threads});
        SimulationResult result = simulate(
            ready.scene, ready.bodies, runs,
            [&](double done, double total) { return work.tell(done, total); }, threads, forces);
        return {std::make_shared<const Motion>(std::move(result.motion)),
                std::make_shared<const SimulationReport>(std::move(result.report))};
    };
    return work([&] { return on_input(flown); });
}

py::object report_of(const FlownMotion& motion) {
    if (!motion.report) return py::none();
    const SimulationReport& report = *motion.report;
    py::dict bodies;
    for (std::size_t i = 0; i < report.bodies.size(); ++i) {
        py::dict body;
        body["highest_reynolds_number"] = report.bodies[i].highest_reynolds_number;
        body["share_below_table"] = report.bodies[i].share_below_table();
        bodies[py::str(motion.motion->bodies[i].name)] = body;
    }
    py::dict result;
    result["steps"] = report.steps;
    result["implicit_steps"] = report.implicit_steps;
    result["most_substeps"] = report.most_substeps;
    result["steps_at_limit"] = report.steps_at_limit;
    result["seconds"] = report.seconds;
    result["bodies"] = bodies;
    return result;
}

std::string names_of(const Motion& motion) {
    std::string names;
    for (const BodyMotion& body : motion.bodies) names += (names.empty() ? "" : ", ") + body.name;
    return names;
}

BodyOfMotion body_named(const FlownMotion& motion, const std::string& name) {
    for (std::size_t i = 0; i < motion.motion->bodies.size(); ++i) {
        if (motion.motion->bodies[i].name == name) return {motion.motion, i};
    }
    throw py::key_error(fmt::format("'{}' is not a body; choose one of {}", name, names_of(*motion.motion)));
}

void require_fall(const BodyOfMotion& body, int run, int copy) {
    if (run < 0 || run >= body.motion->runs) {
        throw py::index_error(fmt::format("run {}: there are only {}; count from 0", run, body.motion->runs));
    }
    if (copy < 0 || copy >= body.body().copies) {
        throw py::index_error(
            fmt::format("copy {}: there are only {}; count from 0", copy, body.body().copies));
    }
}

template <PoseMember member>
py::array poses(const py::object& self) {
    const auto& body = self.cast<const BodyOfMotion&>();
    return pose_view(body.body().poses.data(), {body.motion->runs, body.motion->frames(), body.body().copies},
                     member, self);
}

py::object measured(const BodyOfMotion& body, int run, int copy,
                    std::optional<std::pair<double, double>> window) {
    require_fall(body, run, copy);
    std::optional<TimeWindow> times;
    if (window) times = TimeWindow{window->first, window->second};
    nlohmann::json measures;
    {
        const py::gil_scoped_release others_go_on;
        measures = as_json(on_input([&] { return measure(*body.motion, body.body(), run, copy, times); }));
    }
    return as_python(measures);
}

py::object ensemble(const BodyOfMotion& body) {
    nlohmann::json measures;
    {
        const py::gil_scoped_release others_go_on;
        measures = as_json(measure_all(*body.motion, body.body()));
    }
    return as_python(measures);
}

/// A motion as a file: where it is one, itself; else written to `folder`.
std::filesystem::path file_of(const py::object& motion, const std::filesystem::path& folder,
                              const char* name) {
    if (!py::isinstance<FlownMotion>(motion)) return motion.cast<std::filesystem::path>();
    const std::filesystem::path file = folder / name;
    write(motion.cast<const FlownMotion&>(), file);
    return file;
}

FallChoice choice_of(const MotionReader& file, const std::string& name,
                     const std::optional<std::string>& body) {
    const std::vector<BodyMotion>& bodies = file.motion().bodies;
    if (!body && bodies.size() == 1) return {name, &file, 0, {}, {}};
    for (std::size_t i = 0; body && i < bodies.size(); ++i) {
        if (bodies[i].name == *body) return {name, &file, i, {}, {}};
    }
    throw RaisedInputError(
        fmt::format("{}: holds the bodies {}; give one of these as body", name, names_of(file.motion())));
}

/// A comparison as `told` makes JSON of it.
py::object compared(const py::object& motion, const py::object& reference,
                    const std::optional<std::string>& body, std::optional<std::pair<double, double>> window,
                    py::object progress, nlohmann::json (*told)(const Comparison& comparison)) {
    const TemporaryFolder folder;
    const std::filesystem::path motion_file = file_of(motion, folder.path(), "motion.h5");
    const std::filesystem::path reference_file = file_of(reference, folder.path(), "reference.h5");
    ComparisonSettings settings;
    if (window) settings.window = TimeWindow{window->first, window->second};
    LongWork work(std::move(progress));
    const auto compare_files = [&] {
        const std::lock_guard lock(hdf5_mutex());
        const MotionReader first(motion_file);
        const MotionReader second(reference_file);
        return told(compare(choice_of(first, "the motion", body), choice_of(second, "the reference", body),
                            settings, [&](double done, double total) {
                                if (!work.tell(done, total)) throw Error("the comparison was stopped");
                            }));
    };
    const std::filesystem::path& warned_of =
        reading_error(motion_file).empty() ? reference_file : motion_file;
    const nlohmann::json result = work([&] { return on_input(compare_files, warned_of); });
    return as_python(result);
}

py::object comparison(const py::object& motion, const py::object& reference,
                      const std::optional<std::string>& body, std::optional<std::pair<double, double>> window,
                      py::object progress) {
    return compared(motion, reference, body, window, std::move(progress),
                    [](const Comparison& all) { return as_json(all); });
}

py::object picture_of_comparison(const py::object& motion, const py::object& reference,
                                 const std::optional<std::string>& body,
                                 std::optional<std::pair<double, double>> window) {
    return compared(motion, reference, body, window, py::none(),
                    [](const Comparison& all) { return comparison_picture(all, "motion", "reference"); });
}

py::object picture_of_motion(const FlownMotion& motion, const std::string& picture,
                             const std::optional<std::string>& body, int run, int copy) {
    const std::string first = motion.motion->bodies.empty() ? "" : motion.motion->bodies.front().name;
    const BodyOfMotion shown = body_named(motion, body.value_or(first));
    require_fall(shown, run, copy);
    nlohmann::json result;
    {
        const py::gil_scoped_release others_go_on;
        result = on_input([&] { return motion_picture(picture, *motion.motion, shown.body(), run, copy); });
    }
    return as_python(result);
}

void require_run(const FlownMotion& motion, int run) {
    if (run >= 0 && run < motion.motion->runs) return;
    throw py::index_error(fmt::format("run {}: there are only {}; count from 0", run, motion.motion->runs));
}

void export_to(const FlownMotion& motion, const std::filesystem::path& file, int run) {
    require_run(motion, run);
    const std::string format = file.extension().string();
    const Motion& written = *motion.motion;
    const py::gil_scoped_release others_go_on;
    if (format == ".glb") {
        to_file([&] { write_glb(file, written, run); });
    } else if (format == ".usda") {
        to_file([&] { write_usda(file, written, run); });
    } else if (format == ".chan") {
        to_file([&] { write_chan(file, written, run); });
    } else if (format == ".csv") {
        to_file([&] { write_csv(file, written, run); });
    } else if (format == ".html") {
        to_file([&] {
            write_page(file, written, run, file.stem().string(),
                       fmt::format("{} frames per second", written.frame_rate));
        });
    } else {
        throw RaisedInputError(
            fmt::format("{}: the format '{}' is unknown; end the name in .glb, .usda, .chan, .html or .csv",
                        file.string(), format));
    }
}

std::string page(const FlownMotion& motion, int run) {
    const TemporaryFolder folder;
    const std::filesystem::path file = folder.path() / "motion.html";
    export_to(motion, file, run);
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

py::dict forces_by_part(const std::vector<FluidForces>& forces, const std::vector<py::ssize_t>& shape) {
    py::dict parts;
    for (const auto& [name, part] : parts_of_fluid_forces) {
        py::array_t<double> values(shape);
        double* value = values.mutable_data();
        for (const FluidForces& all : forces) {
            const Wrench& wrench = all.*part;
            value = std::copy_n(wrench.moment.data(), 3, value);
            value = std::copy_n(wrench.force.data(), 3, value);
        }
        parts[name] = values;
    }
    return parts;
}

void bind_body_motion(py::module_& module) {
    auto body_motion = class_of<BodyOfMotion>(
        module, "BodyMotion",
        "A body of a motion with all its runs, frames and copies. Arrays are read-only views, which keep the "
        "motion alive.");
    make_pickled(body_motion, "operator", "getitem", [](const py::object& self) {
        const auto& pickled = self.cast<const BodyOfMotion&>();
        return py::make_tuple(FlownMotion{pickled.motion, nullptr}, pickled.body().name);
    });
    body_motion
        .def_property_readonly(
            "name", [](const BodyOfMotion& body) { return body.body().name; },
            "Name of the body in the scene.")
        .def_property_readonly(
            "copies", [](const BodyOfMotion& body) { return body.body().copies; }, "Number of copies.")
        .def_property_readonly(
            "models", [](const BodyOfMotion& body) { return body.body().models; },
            "The loads, the turbulence and the defaults that were used, in words.")
        .def_property_readonly(
            "center_of_mass", [](const BodyOfMotion& body) { return body.body().center_of_mass; },
            "Centre of mass in m, shape axes, shape (3,).")
        .def_property_readonly(
            "position", &poses<PoseMember::position>,
            "Positions of the centre of mass in m, world axes (z up), shape (runs, frames, copies, 3).")
        .def_property_readonly("orientation", &poses<PoseMember::orientation>,
                               "Unit quaternions x, y, z, w that rotate from shape to world axes, as scipy's "
                               "Rotation has them, shape (runs, frames, copies, 4).")
        .def_property_readonly(
            "velocity", &poses<PoseMember::velocity>,
            "Velocities of the centre of mass in m/s, world axes, shape (runs, frames, copies, 3).")
        .def_property_readonly("angular_velocity", &poses<PoseMember::angular_velocity>,
                               "Angular velocities in rad/s, world axes, shape (runs, frames, copies, 3).")
        .def_property_readonly(
            "forces",
            [](const py::object& self) -> py::object {
                const auto& body = self.cast<const BodyOfMotion&>();
                const std::vector<FluidForces>& forces = body.body().forces;
                if (forces.empty()) return py::none();
                return forces_by_part(forces,
                                      {body.motion->runs, body.motion->frames(), body.body().copies, 6});
            },
            "The fluid's forces by their causes, of simulate(forces=True) and of files that hold them; "
            "otherwise "
            "None. A dict of buoyancy, inertia, drag, lift and noise, each of shape (runs, frames, copies, "
            "6): "
            "the moment about the centre of mass in N m, then the force in N, world axes.")
        .def_property_readonly(
            "sizes",
            [](const py::object& self) -> py::object {
                const auto& body = self.cast<const BodyOfMotion&>();
                const std::vector<double>& sizes = body.body().sizes;
                if (sizes.empty()) return py::none();
                return view(sizes.data(), {body.motion->runs, body.body().copies}, self);
            },
            "Sizes of the copies relative to the vertices, shape (runs, copies); None where all are 1.")
        .def_property_readonly(
            "vertices",
            [](const py::object& self) {
                const Surface& surface = self.cast<const BodyOfMotion&>().body().surface;
                return view(surface.vertices.data()->data(), {length(surface.vertices.size()), 3}, self);
            },
            "Vertices of the surface in m, shape axes, shape (n, 3).")
        .def_property_readonly(
            "triangles",
            [](const py::object& self) {
                const Surface& surface = self.cast<const BodyOfMotion&>().body().surface;
                return view(surface.corners.data()->data(), {length(surface.corners.size()), 3}, self);
            },
            "Three vertex numbers for each triangle, anticlockwise seen from outside, shape (m, 3).")
        .def("measure", &measured, py::arg("run") = 0, py::arg("copy") = 0, py::arg("window") = py::none(),
             "Returns the metrics of one fall as a dict, in SI units and radians: descent_speed, frequency, "
             "inclination_amplitude, rms_angular_speed, regime and others. `window`: (begin, end) in s; "
             "None: the last two thirds of the fall. Raises IndexError for a run or copy that does not "
             "exist, InputError for a window that does not fit.")
        .def("ensemble", &ensemble,
             "Returns the metrics of all runs and copies together as a dict: means, deviations, standard "
             "errors, regimes, path_spread, landing.")
        .def("__repr__", [](const BodyOfMotion& body) {
            return fmt::format("<samara.BodyMotion {}: {} runs, {} frames, {} copies>", body.body().name,
                               body.motion->runs, body.motion->frames(), body.body().copies);
        });
}

}  // namespace

void bind_motion(py::module_& module) {
    bind_body_motion(module);
    auto motion = class_of<FlownMotion>(
        module, "Motion",
        "Poses of bodies at evenly spaced times, in runs that differ by their noise alone.");
    module.def(
        "_motion_of_bytes",
        [](const py::bytes& bytes) {
            FlownMotion result;
            with_file_of("pickled.h5", bytes,
                         [&](const std::filesystem::path& file) { result = read(file); });
            return result;
        },
        py::arg("bytes"));
    make_pickled(motion, "samara", "_unpickled_motion", [](const py::object& self) {
        const auto& pickled = self.cast<const FlownMotion&>();
        return py::make_tuple(
            bytes_of_file("pickled.h5", [&](const std::filesystem::path& file) { write(pickled, file); }));
    });
    motion
        .def_static("read", &read, py::arg("file"),
                    "Reads a motion file (.h5). Raises FileError where it cannot be read, InputError where "
                    "its content is wrong.")
        .def("write", &write, py::arg("file"),
             "Writes a motion file (.h5), whole or not at all. Raises FileError where it cannot be written.")
        .def("export", &export_to, py::arg("file"), py::arg("run") = 0,
             "Writes one run for other programs; the ending of the name chooses the format: .glb, .usda, "
             ".chan, .csv or .html. Raises InputError for another ending, FileError where the file cannot be "
             "written, IndexError for a run that does not exist.")
        .def("page", &page, py::arg("run") = 0,
             "Returns the page (.html) that plays a run, as text. Raises IndexError for a run that does not "
             "exist.")
        .def("_picture", &picture_of_motion, py::arg("picture"), py::arg("body"), py::arg("run"),
             py::arg("copy"), "Returns the data that samara.plot draws for a body.")
        .def_property_readonly(
            "times",
            [](const py::object& self) {
                const Motion& motion = *self.cast<const FlownMotion&>().motion;
                return view(motion.times.data(), {length(motion.times.size())}, self);
            },
            "Times of the frames in s, shape (frames,).")
        .def_property_readonly(
            "runs", [](const FlownMotion& motion) { return motion.motion->runs; }, "Number of runs.")
        .def_property_readonly(
            "frame_rate", [](const FlownMotion& motion) { return motion.motion->frame_rate; },
            "Frames per second.")
        .def_property_readonly(
            "seed", [](const FlownMotion& motion) { return motion.motion->seed; },
            "Seed of the noise and of the spread of starts.")
        .def_property_readonly(
            "scene_text", [](const FlownMotion& motion) { return motion.motion->scene_text; },
            "The scene that was simulated, as text.")
        .def_property_readonly("report", &report_of,
                               "A dict for a motion that was simulated in this process, otherwise None: "
                               "steps, implicit_steps, most_substeps, steps_at_limit, seconds, and in bodies "
                               "for each name highest_reynolds_number and share_below_table.")
        .def_property_readonly(
            "bodies",
            [](const FlownMotion& motion) {
                std::vector<BodyOfMotion> bodies;
                for (std::size_t i = 0; i < motion.motion->bodies.size(); ++i)
                    bodies.push_back({motion.motion, i});
                return bodies;
            },
            "The bodies, in the scene's order.")
        .def(
            "__iter__", [](const py::object& self) { return py::iter(self.attr("bodies")); },
            "Iterates over the bodies, in the scene's order.")
        .def(
            "__contains__",
            [](const FlownMotion& motion, const std::string& name) {
                const auto& bodies = motion.motion->bodies;
                return std::any_of(bodies.begin(), bodies.end(),
                                   [&](const BodyMotion& body) { return body.name == name; });
            },
            "Returns whether there is a body of that name.")
        .def("__getitem__", &body_named, py::arg("name"),
             "Returns the body of that name. Raises KeyError for an unknown name.")
        .def(
            "__len__", [](const FlownMotion& motion) { return motion.motion->bodies.size(); },
            "Returns the number of bodies.")
        .def("__repr__", [](const FlownMotion& motion) {
            return fmt::format("<samara.Motion of {} s: {}; {} runs, {} frames>",
                               motion.motion->times.back() - motion.motion->times.front(),
                               names_of(*motion.motion), motion.motion->runs, motion.motion->frames());
        });
    module.def(
        "fly", &fly, py::arg("scene"), py::kw_only(), py::arg("runs"), py::arg("seed"), py::arg("step"),
        py::arg("threads"), py::arg("bodies"), py::arg("forces"), py::arg("progress"),
        "Simulates a Scene and returns its Motion: samara.simulate() calls it, and gives its arguments their "
        "defaults. `seed` and `step` (s): None for the scene's. `threads`: 0 for all cores; the motion is "
        "the same for any number. `bodies`: a folder of baked bodies, NAME.body.h5 for each body of the "
        "scene, or ''. `forces`: whether to keep the fluid's forces. `progress`: called with (done, total), "
        "or None. Raises InputError, FileError, and "
        "Error where a body's motion leaves the range of numbers.");
    module.def("compare", &comparison, py::arg("motion"), py::arg("reference"), py::kw_only(),
               py::arg("body") = py::none(), py::arg("window") = py::none(), py::arg("progress") = py::none(),
               "Compares a motion with a reference, such as a fall by full CFD; each is a Motion or a motion "
               "file. Returns a dict, as 'samara compare --json' prints it (docs/reference/output.md): "
               "`agrees`, `certain`, and each metric of both with its standard error, their difference and "
               "the verdict. `body`: its name, where a motion has several. `window`: (begin, end) in s after "
               "the release. `progress`: called with (done, total). Raises InputError for motions that "
               "cannot be compared, FileError where a file cannot be read.");
    module.def("_comparison_picture", &picture_of_comparison, py::arg("motion"), py::arg("reference"),
               py::kw_only(), py::arg("body") = py::none(), py::arg("window") = py::none(),
               "Returns the data that samara.plot draws for both.");
}

}  // namespace samara::python

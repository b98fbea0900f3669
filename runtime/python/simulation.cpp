// samara.Simulation: bodies that fall call by call, for those who steer.

#include "samara/core/simulation/simulation.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <limits>
#include <map>
#include <string>
#include <tuple>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <pybind11/eigen.h>
#include <pybind11/numpy.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "bindings.hpp"
#include "samara/commands/shared/scene_bodies.hpp"
#include "samara/core/base/error.hpp"
#include "samara/core/base/numbers.hpp"
#include "samara/core/simulation/body_group.hpp"
#include "samara/formats/toml_table.hpp"
#include "samara/scene/obstacle_table.hpp"
#include "samara/scene/scene_file.hpp"
#include "samara/scene/scene_simulation.hpp"
#include "samara/scene/wind_table.hpp"

namespace samara::python {
namespace {

/// Poses that a flight gave out, runs x copies.
struct Poses {
    std::vector<Pose> poses;
    int runs = 1;
    int copies = 1;
};

/// A flight of a scene. Its calls wait for one another where several threads make them; a progress function
/// may look at it, and change nothing.
class LiveSimulation {
  public:
    LiveSimulation(Scene scene, int runs, std::optional<std::uint64_t> seed, int threads,
                   const std::filesystem::path& bodies)
        : runs_(runs) {
        require_runs_and_threads(runs, threads);
        const py::gil_scoped_release others_go_on;
        on_input([&] {
            put(prepared(std::move(scene), {.bodies = bodies.string(), .seed = seed, .threads = threads}),
                threads);
        });
    }

    void advance(double time, std::optional<double> budget, py::object progress) {
        if (!std::isfinite(time)) throw RaisedInputError("time: give a finite number of seconds");
        if (budget && !(*budget >= 0.0))
            throw RaisedInputError("budget: give a number of seconds, 0 or more");
        LongWork work(std::move(progress));
        work([&] {
            const std::lock_guard lock(mutex_);
            require_no_advance();
            const Advancing in_progress(advancing_);
            const double begin = simulation_->time();
            simulation_->require_time(time);
            if (time == begin) {
                simulation_->advance_to(time);
                return work.tell(0.0, 0.0);
            }
            if (budget) {
                for (const auto& [index, wrench] : pushes_) simulation_->add_wrench(index, wrench);
                pushes_.clear();
                simulation_->advance_within(time, *budget);
                return work.tell(simulation_->time() - begin, time - begin);
            }
            // In pieces, so that Ctrl-C and progress come through; the motion does not depend on them.
            for (double now = begin; work.tell(now - begin, time - begin);) {
                now = std::min(time, now + pieces_of_ * step_);
                for (const auto& [index, wrench] : pushes_) simulation_->add_wrench(index, wrench);
                simulation_->advance_to(now);
                if (now < time) continue;
                pushes_.clear();
                work.tell(time - begin, time - begin);
                break;
            }
            return true;
        });
    }

    void add_force(const std::string& name, const py::object& force, const py::object& point,
                   const py::object& moment, int run, int copy) {
        const std::size_t index = index_of(name, run, copy);
        const GivenPush given = {"force", Vector3d(numbers_of<3>(force, "force").data()),
                                 vector_of(point, "point"), vector_of(moment, "moment")};
        change_simulation([&] { pushes_.emplace_back(index, wrench_of(index, given)); });
    }

    void add_impulse(const std::string& name, const py::object& impulse, const py::object& point,
                     const py::object& angular_impulse, int run, int copy) {
        const std::size_t index = index_of(name, run, copy);
        const GivenPush given = {"impulse", Vector3d(numbers_of<3>(impulse, "impulse").data()),
                                 vector_of(point, "point"), vector_of(angular_impulse, "angular_impulse")};
        change_simulation([&] { simulation_->add_impulse(index, wrench_of(index, given)); });
    }

    void remove(const std::string& name, int run, int copy) {
        const std::size_t index = index_of(name, run, copy);
        change_simulation([&] { simulation_->remove(index); });
    }

    [[nodiscard]] std::tuple<Vector6d, Matrix6d, Matrix6d> fluid_load(const std::string& name, int run,
                                                                      int copy) {
        const std::size_t index = index_of(name, run, copy);
        FluidLoad load;
        with_simulation([&] {
            require_there(index);
            load = simulation_->fluid_load(index);
        });
        return {load.wrench, load.added_inertia, load.damping};
    }

    [[nodiscard]] std::map<std::string, Vector6d> fluid_forces(const std::string& name, int run, int copy) {
        const std::size_t index = index_of(name, run, copy);
        FluidForces forces;
        with_simulation([&] {
            require_there(index);
            forces = simulation_->fluid_forces(index);
        });
        std::map<std::string, Vector6d> result;
        for (const auto& [part, member] : parts_of_fluid_forces) {
            result[part] << (forces.*member).moment, (forces.*member).force;
        }
        return result;
    }

    [[nodiscard]] std::tuple<double, Vector3d, Matrix3d> mass_properties(const std::string& name, int run,
                                                                         int copy) {
        const std::size_t index = index_of(name, run, copy);
        std::tuple<double, Vector3d, Matrix3d> own;
        with_simulation([&] {
            own = {simulation_->mass(index), simulation_->center_of_mass(index), simulation_->inertia(index)};
        });
        return own;
    }

    void add(const py::dict& keys, const std::filesystem::path& folder) {
        py::dict settings;
        settings["duration"] = 1.0;  // which every scene has
        py::list bodies;
        bodies.append(keys);
        py::dict values;
        values["scene"] = settings;
        values["body"] = bodies;
        const std::string text = toml_text(values, "body");
        const bool has_start = keys.contains("start");
        change_simulation([&] {
            Scene scene = read_scene_text(text, "body", folder);
            SceneBody& body = scene.bodies.front();
            if (body.models_auto) throw RaisedInputError("models: give the models of a body that is added");
            const std::vector<LoadedBody> loaded = load_scene_bodies(scene, "");
            if (!has_start) body.start = simulation_->time();
            const std::size_t first = simulation_->add(loaded.front(), body, body, body.name);
            groups_.push_back({body.name, body.count, first});
        });
    }

    void add_obstacle(const py::dict& keys, const std::filesystem::path& folder) {
        const toml::table document = parse_toml(toml_text(keys, "obstacle"), "obstacle");
        change_simulation([&] {
            TomlTable table(document, "obstacle", "the obstacle");
            Obstacle obstacle = read_obstacle(table, folder);
            std::string name = obstacle.name;
            const std::size_t index = simulation_->add_obstacle(std::move(obstacle));
            obstacles_.resize(index);
            obstacles_.push_back(std::move(name));
        });
    }

    void remove_obstacle(const std::string& name) {
        change_simulation([&] {
            const auto found = std::find(obstacles_.begin(), obstacles_.end(), name);
            if (found == obstacles_.end()) {
                throw RaisedInputError(fmt::format("there is no obstacle '{}'; choose one of {}", name,
                                                   fmt::join(obstacles_, ", ")));
            }
            simulation_->remove_obstacle(static_cast<std::size_t>(found - obstacles_.begin()));
            found->clear();
        });
    }

    void set_ground(std::optional<double> height) {
        if (height && !(std::abs(*height) <= largest_number)) {
            throw RaisedInputError("height: give a finite number of metres, 1e30 at most, or None");
        }
        change_simulation([&] { simulation_->set_ground(height); });
    }

    void set_wind(const py::dict& keys) {
        const toml::table document = parse_toml(toml_text(keys, "wind"), "wind");
        change_simulation([&] {
            TomlTable table(document, "wind", "the wind");
            const std::lock_guard lock(hdf5_mutex());  // of a wind file, which need not last
            constexpr double no_end = -std::numeric_limits<double>::infinity();
            simulation_->set_wind(read_dict(
                "wind", [&] { return read_wind(table, ".", simulation_->ground().value_or(0.0), no_end); }));
        });
    }

    void watch_contacts(bool watch) {
        change_simulation([&] { simulation_->watch_contacts(watch); });
    }

    [[nodiscard]] py::dict take_contacts(const std::string& name) {
        const Group& group = group_named(name);
        const std::size_t count = static_cast<std::size_t>(runs_) * static_cast<std::size_t>(group.copies);
        std::vector<ContactRecord> records(count);
        std::vector<bool> rests(count);
        change_simulation([&] {
            for (std::size_t i = 0; i < count; ++i) {
                records[i] = simulation_->take_contacts(group.first + i);
                rests[i] = simulation_->is_at_rest(group.first + i);
            }
        });
        const std::array<py::ssize_t, 2> shape = {runs_, group.copies};
        py::array_t<double> impulse({shape[0], shape[1], py::ssize_t{3}});
        py::array_t<double> point({shape[0], shape[1], py::ssize_t{3}});
        py::array_t<double> normal({shape[0], shape[1], py::ssize_t{3}});
        py::array_t<double> strongest(shape);
        py::array_t<double> time(shape);
        py::array_t<int> obstacle(shape);
        py::array_t<int> body(shape);
        py::array_t<bool> at_rest(shape);
        for (std::size_t i = 0; i < count; ++i) {
            std::copy_n(records[i].impulse.data(), 3, impulse.mutable_data() + 3 * i);
            std::copy_n(records[i].point.data(), 3, point.mutable_data() + 3 * i);
            std::copy_n(records[i].normal.data(), 3, normal.mutable_data() + 3 * i);
            strongest.mutable_data()[i] = records[i].strongest;
            time.mutable_data()[i] = records[i].time;
            obstacle.mutable_data()[i] = records[i].obstacle;
            body.mutable_data()[i] = records[i].body;
            at_rest.mutable_data()[i] = rests[i];
        }
        py::dict result;
        result["impulse"] = impulse;
        result["strongest"] = strongest;
        result["point"] = point;
        result["normal"] = normal;
        result["time"] = time;
        result["obstacle"] = obstacle;
        result["body"] = body;
        result["at_rest"] = at_rest;
        return result;
    }

    [[nodiscard]] Poses poses(const std::string& name) {
        const Group& group = group_named(name);
        Poses result{{}, runs_, group.copies};
        result.poses.resize(static_cast<std::size_t>(runs_) * static_cast<std::size_t>(group.copies));
        with_simulation([&] { simulation_->poses(group.first, result.poses.size(), result.poses.data()); });
        return result;
    }

    void set_pose(const std::string& name, int run, int copy, const py::object& position,
                  const py::object& orientation, const py::object& velocity,
                  const py::object& angular_velocity) {
        const std::size_t index = index_of(name, run, copy);
        Pose pose;
        with_simulation([&] { pose = simulation_->pose(index); });
        const auto assign = [](Vector3d& target, const py::object& given, const char* what) {
            target = vector_of(given, what).value_or(target);
            if (!(target.cwiseAbs().maxCoeff() <= largest_number) || !target.allFinite()) {
                throw RaisedInputError(fmt::format("{}: give three finite numbers, 1e30 at most", what));
            }
        };
        assign(pose.position, position, "position");
        assign(pose.velocity, velocity, "velocity");
        assign(pose.angular_velocity, angular_velocity, "angular_velocity");
        if (!orientation.is_none()) {
            pose.orientation = Quaterniond(numbers_of<4>(orientation, "orientation").data());
            if (!(std::abs(pose.orientation.norm() - 1.0) < 1e-6)) {
                throw RaisedInputError("orientation: give a quaternion x, y, z, w of length one");
            }
            pose.orientation.normalize();
        }
        change_simulation([&] { simulation_->set_pose(index, pose); });
    }

    [[nodiscard]] py::bytes state() {
        std::string bytes;
        with_simulation([&] { bytes = simulation_->state(); });
        return bytes;
    }
    void set_state(const std::string& bytes) {
        change_simulation([&] { simulation_->set_state(bytes); });
    }
    [[nodiscard]] double time() {
        double time = 0.0;
        with_simulation([&] { time = simulation_->time(); });
        return time;
    }
    [[nodiscard]] std::uint64_t steps() {
        std::uint64_t steps = 0;
        with_simulation([&] { steps = simulation_->steps(); });
        return steps;
    }
    [[nodiscard]] std::vector<std::string> names() const {
        std::vector<std::string> names;
        for (const Group& group : groups_) names.push_back(group.name);
        return names;
    }

  private:
    struct Group {
        std::string name;
        int copies = 1;
        std::size_t first = 0;
    };
    static constexpr double pieces_of_ = 256.0;  // steps

    void put(const PreparedScene& ready, int threads) {
        step_ = ready.scene.step;
        simulation_.emplace(simulation_of(ready.scene, ready.bodies, runs_, threads));
        for (const Obstacle& obstacle : ready.scene.obstacles) obstacles_.push_back(obstacle.name);
        for (const auto& group : simulation_->groups()) {
            groups_.push_back({group->name(), static_cast<int>(group->copies()), group->first()});
        }
    }

    [[nodiscard]] std::size_t index_of(const std::string& name, int run, int copy) const {
        const Group& group = group_named(name);
        if (run < 0 || run >= runs_) {
            throw py::index_error(fmt::format("run {}: there are only {}; count from 0", run, runs_));
        }
        if (copy < 0 || copy >= group.copies) {
            throw py::index_error(
                fmt::format("copy {}: there are only {}; count from 0", copy, group.copies));
        }
        return group.first + static_cast<std::size_t>(run * group.copies + copy);
    }

    void require_there(std::size_t index) const {
        if (simulation_->is_removed(index))
            throw RaisedInputError("the body is removed; restore it with set_pose");
    }

    /// A force, or impulse, as it is given.
    struct GivenPush {
        const char* name;
        Vector3d force;
        std::optional<Vector3d> point, moment;
    };

    static std::optional<Vector3d> vector_of(const py::object& given, const char* name) {
        if (given.is_none()) return {};
        return Vector3d(numbers_of<3>(given, name).data());
    }

    [[nodiscard]] Wrench wrench_of(std::size_t index, const GivenPush& given) const {
        require_there(index);
        Wrench wrench{given.force, given.moment.value_or(Vector3d::Zero())};
        if (given.point)
            wrench.moment += (*given.point - simulation_->pose(index).position).cross(wrench.force);
        const bool sound = wrench.force.allFinite() && wrench.moment.allFinite() &&
                           std::max(wrench.force.norm(), wrench.moment.norm()) <= largest_number;
        if (!sound) throw RaisedInputError(fmt::format("{}: give finite numbers, 1e30 at most", given.name));
        return wrench;
    }

    [[nodiscard]] const Group& group_named(const std::string& name) const {
        for (const Group& group : groups_) {
            if (group.name == name) return group;
        }
        throw py::key_error(
            fmt::format("'{}' is not a body; choose one of {}", name, fmt::join(names(), ", ")));
    }

    template <typename Work>
    void with_simulation(const Work& work) {
        const py::gil_scoped_release others_go_on;
        const std::lock_guard lock(mutex_);
        work();
    }

    /// Does work that changes the simulation, as with_simulation(). Throws Error from a progress function of
    /// advance().
    template <typename Work>
    void change_simulation(const Work& work) {
        with_simulation([&] {
            require_no_advance();
            work();
        });
    }

    void require_no_advance() const {
        if (!advancing_) return;
        throw Error("the simulation is advancing; a progress function may read it, but not change it");
    }

    /// Marks the simulation as advancing for as long as it lives..
    struct Advancing {
        explicit Advancing(bool& flag) : flag_(flag) { flag_ = true; }
        ~Advancing() { flag_ = false; }
        Advancing(const Advancing&) = delete;
        Advancing& operator=(const Advancing&) = delete;

      private:
        bool& flag_;
    };

    int runs_;
    double step_ = 0.0;
    std::vector<std::string> obstacles_;  ///< by their numbers; empty once they are removed
    std::optional<Simulation> simulation_;
    std::vector<Group> groups_;
    std::vector<std::pair<std::size_t, Wrench>> pushes_;  ///< over the next advance()
    std::recursive_mutex mutex_;
    bool advancing_ = false;
};

template <PoseMember member>
py::array member_of(const py::object& self) {
    const auto& poses = self.cast<const Poses&>();
    return pose_view(poses.poses.data(), {poses.runs, poses.copies}, member, self);
}

}  // namespace

void bind_simulation(py::module_& module) {
    class_of<Poses>(module, "Poses",
                    "Poses of all runs and copies of a body at one time. Arrays are read-only.")
        .def_property_readonly(
            "position", &member_of<PoseMember::position>,
            "Positions of the centre of mass in m, world axes (z up), shape (runs, copies, 3).")
        .def_property_readonly(
            "orientation", &member_of<PoseMember::orientation>,
            "Unit quaternions x, y, z, w that rotate from shape to world axes, shape (runs, copies, 4).")
        .def_property_readonly(
            "velocity", &member_of<PoseMember::velocity>,
            "Velocities of the centre of mass in m/s, world axes, shape (runs, copies, 3).")
        .def_property_readonly("angular_velocity", &member_of<PoseMember::angular_velocity>,
                               "Angular velocities in rad/s, world axes, shape (runs, copies, 3).");
    class_of<LiveSimulation>(module, "Simulation",
                             "A simulation that you advance call by call: read and set poses, push bodies, "
                             "save and restore everything. The motion does not depend on how the times are "
                             "divided into calls. Threads may share a simulation: calls wait for each other.")
        .def(py::init<const Scene&, int, std::optional<std::uint64_t>, int, const std::filesystem::path&>(),
             py::arg("scene"), py::kw_only(), py::arg("runs") = 1, py::arg("seed") = py::none(),
             py::arg("threads") = 1, py::arg("bodies") = "",
             "Places the bodies of a Scene at their starts, at time 0. `runs`: repetitions that differ by "
             "their noise alone. `seed`: instead of the scene's. `threads`: 0 for all cores; the motion is "
             "the same for any number. `bodies`: a folder of baked bodies, NAME.body.h5 for each body of the "
             "scene. Raises InputError where the scene or a body is wrong, FileError where a file cannot be "
             "read.")
        .def_property_readonly("time", &LiveSimulation::time, "Time in s.")
        .def_property_readonly("steps", &LiveSimulation::steps, "Number of steps so far, over all bodies.")
        .def_property_readonly("names", &LiveSimulation::names, "Names of the bodies, in the scene's order.")
        .def("advance", &LiveSimulation::advance, py::arg("time"), py::kw_only(),
             py::arg("budget") = py::none(), py::arg("progress") = py::none(),
             "Advances all bodies to a time (s). `budget`: seconds by the clock on the wall after which no "
             "further step is taken, for frames that must end; one step at least is. Where `time` of the "
             "simulation is less then, the next call takes up the rest: the motion is the same. `progress`: "
             "called with (done, total) in s; it may read the simulation but not change it, and an exception "
             "in it ends the call. Raises InputError for a time that has passed, Error where a body's motion "
             "leaves the range of numbers.")
        .def("poses", &LiveSimulation::poses, py::arg("name"),
             "Returns the current poses of all copies of a body in all runs. Raises KeyError for an unknown "
             "name.")
        .def("set_pose", &LiveSimulation::set_pose, py::arg("name"), py::kw_only(), py::arg("run") = 0,
             py::arg("copy") = 0, py::arg("position") = py::none(), py::arg("orientation") = py::none(),
             py::arg("velocity") = py::none(), py::arg("angular_velocity") = py::none(),
             "Moves one body; arguments that are left out keep their values. Lengths in m, velocities in m/s "
             "and rad/s, orientation as a unit quaternion x, y, z, w, all in world axes. A body that was "
             "removed returns.")
        .def("add_force", &LiveSimulation::add_force, py::arg("name"), py::arg("force"), py::kw_only(),
             py::arg("point") = py::none(), py::arg("moment") = py::none(), py::arg("run") = 0,
             py::arg("copy") = 0,
             "Pushes a body during the next advance(): force in N, moment in N m, world axes; several add "
             "up. `point`: where the force acts, in m, world axes; None: at the centre of mass. Raises "
             "InputError for a body that was removed.")
        .def("add_impulse", &LiveSimulation::add_impulse, py::arg("name"), py::arg("impulse"), py::kw_only(),
             py::arg("point") = py::none(), py::arg("angular_impulse") = py::none(), py::arg("run") = 0,
             py::arg("copy") = 0,
             "Gives a body an impulse now (N s, world axes) and an angular impulse (N m s); the body and its "
             "added mass respond together. `point`: where it acts, in m, world axes; None: at the centre of "
             "mass. Raises InputError for a body that was removed.")
        .def("remove", &LiveSimulation::remove, py::arg("name"), py::kw_only(), py::arg("run") = 0,
             py::arg("copy") = 0,
             "Removes a body: it takes no steps and touches nothing, until set_pose() restores it.")
        .def("fluid_load", &LiveSimulation::fluid_load, py::arg("name"), py::kw_only(), py::arg("run") = 0,
             py::arg("copy") = 0,
             "Returns the load of the fluid on a body in its next step, for an engine that integrates the "
             "body itself: wrench W, shape (6,), added inertia A and damping D, shape (6, 6), in SI units "
             "and world axes, at the centre of mass, angular before linear. With the body's own inertia M, "
             "own wrench g and the step h: (M + A + h D) a = g + W. Then call set_pose(), and advance() by "
             "one step.")
        .def(
            "fluid_forces", &LiveSimulation::fluid_forces, py::arg("name"), py::kw_only(), py::arg("run") = 0,
            py::arg("copy") = 0,
            "Returns the fluid's forces on a body by their causes, at the end of its last step: a dict of "
            "buoyancy, inertia, drag, lift and noise, each of shape (6,): moment about the centre of mass in "
            "N m, then force in N, world axes.")
        .def("mass_properties", &LiveSimulation::mass_properties, py::arg("name"), py::kw_only(),
             py::arg("run") = 0, py::arg("copy") = 0,
             "Returns the mass (kg), the centre of mass (m, from the shape's origin, shape axes, shape (3,)) "
             "and the inertia about it (kg m^2, shape axes, shape (3, 3)) of the body alone, without added "
             "mass.")
        .def("add", &LiveSimulation::add, py::arg("body"), py::kw_only(), py::arg("folder") = ".",
             "Adds a body with all its copies, from a dict with the keys of a [[body]]; by default it starts "
             "now. It may have an emitter, which may move. Raises InputError where the name is taken, or a "
             "copy starts inside an obstacle.")
        .def("add_obstacle", &LiveSimulation::add_obstacle, py::arg("obstacle"), py::kw_only(),
             py::arg("folder") = ".",
             "Adds an obstacle now, from a dict with the keys of an [[obstacle]]; paths are relative to "
             "`folder`. Raises InputError where its name is taken or a body is inside of it.")
        .def("remove_obstacle", &LiveSimulation::remove_obstacle, py::arg("name"),
             "Removes an obstacle: bodies that lay on it fall. Raises InputError for an unknown name.")
        .def("set_ground", &LiveSimulation::set_ground, py::arg("height"),
             "Sets level ground at a height (m), or removes it (None). Bodies below it are lifted onto it.")
        .def("set_wind", &LiveSimulation::set_wind, py::arg("wind"),
             "Replaces the wind from now on: a dict with the keys of [wind] of a scene; {} for none. Raises "
             "InputError where the wind is wrong.")
        .def("watch_contacts", &LiveSimulation::watch_contacts, py::arg("watch"),
             "Records the contacts of bodies with the ground, obstacles and each other from now on, or stops "
             "(False).")
        .def("take_contacts", &LiveSimulation::take_contacts, py::arg("name"),
             "Returns the contacts of a body since the last call, as a dict of arrays of shape (runs, "
             "copies) or (runs, copies, 3): impulse (N s, world axes, the sum), strongest (N s, the largest "
             "at one point in one step; 0: no contact) with its point (m), normal and time (s), obstacle "
             "(its number; -1: level ground, or a body), body (the number of the other body, counted over "
             "all bodies of the scene, run by run and copy by copy; -1: none), and at_rest. Raises "
             "InputError while contacts are not watched.")
        .def("state", &LiveSimulation::state,
             "Returns everything that the rest of the motion depends on, as bytes, but for forces that wait "
             "for advance() and recorded contacts.")
        .def("set_state", &LiveSimulation::set_state, py::arg("state"),
             "Continues from a state() of a simulation of the same scene, runs, ground and wind. Raises "
             "InputError for other bytes.");
}

}  // namespace samara::python

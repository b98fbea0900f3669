// samara.Flight: bodies that fall call by call, for those who steer.

#include "samara/flight/flight.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>

#include <fmt/format.h>
#include <pybind11/eigen.h>
#include <pybind11/numpy.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "bindings.hpp"
#include "internal/command/scene_bodies.hpp"
#include "internal/flight/flight_kind.hpp"
#include "samara/base/error.hpp"

namespace samara::python {
namespace {

/// Poses that a flight gave out, runs x copies.
struct Poses {
    std::vector<Pose> poses;
    int runs = 1;
    int copies = 1;
};

/// A flight of a scene. Its calls wait for one another where several threads make them.
class LiveFlight {
  public:
    using Three = std::array<double, 3>;

    LiveFlight(Scene scene, int runs, std::optional<std::uint64_t> seed, int threads,
               const std::filesystem::path& bodies)
        : runs_(runs) {
        if (runs < 1 || runs > 1'000'000) throw Error("runs: give 1 to 1000000");
        if (threads < 0 || threads > 4096) throw Error("threads: give 0 for all cores, or up to 4096");
        if (seed) scene.seed = *seed;
        const py::gil_scoped_release others_go_on;
        std::vector<LoadedBody> loaded;
        {
            const std::lock_guard lock(hdf5_mutex());
            loaded = load_scene_bodies(scene, bodies.string());
        }
        choose_models(scene, loaded, threads, [](double, double) {});
        choose_step(scene, loaded, threads);
        step_ = scene.step;
        flight_.emplace(flight_settings(scene, runs, threads));
        for (std::size_t i = 0; i < loaded.size(); ++i) {
            const SceneBody& body = scene.bodies[i];
            kinds_.push_back({body.name, body.count, flight_->add(loaded[i], body, body, body.name)});
        }
    }

    void advance(double time, py::object progress) {
        if (!std::isfinite(time)) throw Error("time: give a finite number of seconds");
        LongWork work(std::move(progress));
        work([&] {
            const std::lock_guard lock(mutex_);
            // In pieces, so that Ctrl-C and progress come through; the motion does not depend on them.
            const double begin = flight_->time();
            for (double now = begin; work.tell(now - begin, time - begin);) {
                if (now >= time && now > begin) break;
                now = std::min(time, now + pieces_of_ * step_);
                for (const auto& [index, wrench] : pushes_) flight_->add_wrench(index, wrench);
                flight_->advance_to(now);
                if (now >= time) break;
            }
            if (time > begin) pushes_.clear();
            return true;
        });
    }

    void add_force(const std::string& name, const Three& force, const std::optional<Three>& point,
                   const std::optional<Three>& moment, int run, int copy) {
        const std::size_t index = index_of(name, run, copy);
        with_flight([&] { pushes_.emplace_back(index, wrench_of(index, force, "force", point, moment)); });
    }

    void add_impulse(const std::string& name, const Three& impulse, const std::optional<Three>& point,
                     const std::optional<Three>& angular_impulse, int run, int copy) {
        const std::size_t index = index_of(name, run, copy);
        with_flight([&] {
            flight_->add_impulse(index, wrench_of(index, impulse, "impulse", point, angular_impulse));
        });
    }

    void remove(const std::string& name, int run, int copy) {
        const std::size_t index = index_of(name, run, copy);
        with_flight([&] { flight_->remove(index); });
    }

    void watch_contacts(bool watch) {
        with_flight([&] { flight_->watch_contacts(watch); });
    }

    [[nodiscard]] py::dict take_contacts(const std::string& name) {
        const Kind& kind = kind_named(name);
        const std::size_t count = static_cast<std::size_t>(runs_) * static_cast<std::size_t>(kind.copies);
        std::vector<ContactRecord> met(count);
        std::vector<bool> rests(count);
        with_flight([&] {
            for (std::size_t i = 0; i < count; ++i) {
                met[i] = flight_->take_contacts(kind.first + i);
                rests[i] = flight_->is_at_rest(kind.first + i);
            }
        });
        const std::array<py::ssize_t, 2> shape = {runs_, kind.copies};
        py::array_t<double> impulse({shape[0], shape[1], py::ssize_t{3}});
        py::array_t<double> point({shape[0], shape[1], py::ssize_t{3}});
        py::array_t<double> normal({shape[0], shape[1], py::ssize_t{3}});
        py::array_t<double> strongest(shape);
        py::array_t<double> time(shape);
        py::array_t<int> obstacle(shape);
        py::array_t<int> body(shape);
        py::array_t<bool> at_rest(shape);
        for (std::size_t i = 0; i < count; ++i) {
            std::copy_n(met[i].impulse.data(), 3, impulse.mutable_data() + 3 * i);
            std::copy_n(met[i].point.data(), 3, point.mutable_data() + 3 * i);
            std::copy_n(met[i].normal.data(), 3, normal.mutable_data() + 3 * i);
            strongest.mutable_data()[i] = met[i].strongest;
            time.mutable_data()[i] = met[i].time;
            obstacle.mutable_data()[i] = met[i].obstacle;
            body.mutable_data()[i] = met[i].body;
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
        const Kind& kind = kind_named(name);
        Poses result{{}, runs_, kind.copies};
        result.poses.resize(static_cast<std::size_t>(runs_) * static_cast<std::size_t>(kind.copies));
        with_flight([&] { flight_->poses(kind.first, result.poses.size(), result.poses.data()); });
        return result;
    }

    void set_pose(const std::string& name, int run, int copy,
                  const std::optional<std::array<double, 3>>& position,
                  const std::optional<std::array<double, 4>>& orientation,
                  const std::optional<std::array<double, 3>>& velocity,
                  const std::optional<std::array<double, 3>>& angular_velocity) {
        const std::size_t index = index_of(name, run, copy);
        Pose pose;
        with_flight([&] { pose = flight_->pose(index); });
        const auto assign = [](Vector3d& target, const auto& given, const char* what) {
            if (!given) return;
            target = Vector3d(given->data());
            if (!target.allFinite()) throw Error(fmt::format("{}: give three finite numbers", what));
        };
        assign(pose.position, position, "position");
        assign(pose.velocity, velocity, "velocity");
        assign(pose.angular_velocity, angular_velocity, "angular_velocity");
        if (orientation) {
            pose.orientation = Quaterniond(orientation->data());
            if (!(std::abs(pose.orientation.norm() - 1.0) < 1e-6)) {
                throw Error("orientation: give a quaternion x, y, z, w of length one");
            }
            pose.orientation.normalize();
        }
        with_flight([&] { flight_->set_pose(index, pose); });
    }

    [[nodiscard]] py::bytes state() {
        std::string bytes;
        with_flight([&] { bytes = flight_->state(); });
        return bytes;
    }
    void set_state(const std::string& bytes) {
        with_flight([&] { flight_->set_state(bytes); });
    }
    [[nodiscard]] double time() {
        double time = 0.0;
        with_flight([&] { time = flight_->time(); });
        return time;
    }
    [[nodiscard]] std::uint64_t steps() {
        std::uint64_t steps = 0;
        with_flight([&] { steps = flight_->steps(); });
        return steps;
    }
    [[nodiscard]] std::vector<std::string> names() const {
        std::vector<std::string> names;
        for (const Kind& kind : kinds_) names.push_back(kind.name);
        return names;
    }

  private:
    struct Kind {
        std::string name;
        int copies = 1;
        std::size_t first = 0;
    };
    static constexpr double pieces_of_ = 256.0;  // steps

    [[nodiscard]] std::size_t index_of(const std::string& name, int run, int copy) const {
        const Kind& kind = kind_named(name);
        if (run < 0 || run >= runs_) {
            throw py::index_error(fmt::format("run {}: there are {}, counted from 0", run, runs_));
        }
        if (copy < 0 || copy >= kind.copies) {
            throw py::index_error(fmt::format("copy {}: there are {}, counted from 0", copy, kind.copies));
        }
        return kind.first + static_cast<std::size_t>(run * kind.copies + copy);
    }

    /// A force, or impulse, at a point, with a moment besides.
    [[nodiscard]] Wrench wrench_of(std::size_t index, const Three& force, const char* name,
                                   const std::optional<Three>& point,
                                   const std::optional<Three>& moment) const {
        if (flight_->is_removed(index)) throw Error("the body is removed; put it back by set_pose");
        Wrench wrench{Vector3d(force.data()), Vector3d::Zero()};
        if (moment) wrench.moment = Vector3d(moment->data());
        if (point) {
            const Vector3d arm = Vector3d(point->data()) - flight_->pose(index).position;
            wrench.moment += arm.cross(wrench.force);
        }
        const bool sound = wrench.force.allFinite() && wrench.moment.allFinite() &&
                           std::max(wrench.force.norm(), wrench.moment.norm()) <= 1e30;
        if (!sound) throw Error(fmt::format("{}: give finite numbers, 1e30 at most", name));
        return wrench;
    }

    [[nodiscard]] const Kind& kind_named(const std::string& name) const {
        for (const Kind& kind : kinds_) {
            if (kind.name == name) return kind;
        }
        throw py::key_error(fmt::format("'{}': the bodies are {}", name, fmt::join(names(), ", ")));
    }

    template <typename Work>
    void with_flight(const Work& work) {
        const py::gil_scoped_release others_go_on;
        const std::lock_guard lock(mutex_);
        work();
    }

    int runs_;
    double step_ = 0.0;
    std::optional<Flight> flight_;
    std::vector<Kind> kinds_;
    std::vector<std::pair<std::size_t, Wrench>> pushes_;  ///< over the next advance()
    std::mutex mutex_;
};

template <PoseMember member>
py::array member_of(const py::object& self) {
    const auto& poses = self.cast<const Poses&>();
    return pose_view(poses.poses.data(), {poses.runs, poses.copies}, member, self);
}

}  // namespace

void bind_flight(py::module_& module) {
    py::class_<Poses>(module, "Poses",
                      "Poses of all runs and copies of a body at one time; arrays that cannot be written to.")
        .def_property_readonly("position", &member_of<PoseMember::position>,
                               "Of the centre of mass: m, world axes (z up), shape (runs, copies, 3).")
        .def_property_readonly("orientation", &member_of<PoseMember::orientation>,
                               "Shape to world axes as unit quaternions x, y, z, w, shape (runs, copies, 4).")
        .def_property_readonly("velocity", &member_of<PoseMember::velocity>,
                               "m/s, world axes, shape (runs, copies, 3).")
        .def_property_readonly("angular_velocity", &member_of<PoseMember::angular_velocity>,
                               "rad/s, world axes, shape (runs, copies, 3).");
    py::class_<LiveFlight>(module, "Flight",
                           "Bodies of a scene that fall call by call: any time may be asked for, poses read "
                           "and set, all of it saved "
                           "and restored. The motion does not depend on how the times are cut into calls.")
        .def(py::init<const Scene&, int, std::optional<std::uint64_t>, int, const std::filesystem::path&>(),
             py::arg("scene"), py::kw_only(), py::arg("runs") = 1, py::arg("seed") = py::none(),
             py::arg("threads") = 1, py::arg("bodies") = "",
             "Puts the bodies of a Scene at their starts. `bodies`: a folder of baked bodies, NAME.body.h5.")
        .def_property_readonly("time", &LiveFlight::time, "s")
        .def_property_readonly("steps", &LiveFlight::steps, "Taken so far, over all bodies.")
        .def_property_readonly("names", &LiveFlight::names, "The bodies' names, in the scene's order.")
        .def("advance", &LiveFlight::advance, py::arg("time"), py::kw_only(),
             py::arg("progress") = py::none(),
             "Steps all bodies to a time (s), which cannot lie before `time`. `progress` is called with "
             "(done, total) in s.")
        .def("poses", &LiveFlight::poses, py::arg("name"), "All copies of a body in all runs, now.")
        .def("set_pose", &LiveFlight::set_pose, py::arg("name"), py::kw_only(), py::arg("run") = 0,
             py::arg("copy") = 0, py::arg("position") = py::none(), py::arg("orientation") = py::none(),
             py::arg("velocity") = py::none(), py::arg("angular_velocity") = py::none(),
             "Puts one body elsewhere; what is not given stays.")
        .def(
            "add_force", &LiveFlight::add_force, py::arg("name"), py::arg("force"), py::kw_only(),
            py::arg("point") = py::none(), py::arg("moment") = py::none(), py::arg("run") = 0,
            py::arg("copy") = 0,
            "Pushes a body over the next advance(): N, world axes, at a point (m, world; None: the centre of "
            "mass), and with a moment (N m). Several add up.")
        .def("add_impulse", &LiveFlight::add_impulse, py::arg("name"), py::arg("impulse"), py::kw_only(),
             py::arg("point") = py::none(), py::arg("angular_impulse") = py::none(), py::arg("run") = 0,
             py::arg("copy") = 0,
             "Gives a body an impulse now (N s, world axes; N m s): body and fluid take it together.")
        .def("remove", &LiveFlight::remove, py::arg("name"), py::kw_only(), py::arg("run") = 0,
             py::arg("copy") = 0, "Takes a body out where it is; set_pose() puts it back.")
        .def("watch_contacts", &LiveFlight::watch_contacts, py::arg("watch"),
             "Notes from now on what bodies meet of ground, obstacles and each other, or no longer.")
        .def("take_contacts", &LiveFlight::take_contacts, py::arg("name"),
             "What a body's copies met since they were last asked, arrays (runs, copies, ...): impulse (N s, "
             "world axes, the sum), strongest (N s, of one point in one step; 0: nothing was met) with its "
             "point (m), normal, time (s), obstacle (its number; -1: level ground, or a body) and body (the "
             "number of the one that was met, counted over the scene's bodies, run by run and copy by copy; "
             "-1: "
             "none), and at_rest.")
        .def("state", &LiveFlight::state, "All that the rest of the flight depends on, as bytes.")
        .def("set_state", &LiveFlight::set_state, py::arg("state"),
             "Goes on from such a state, of a flight of the same scene, runs and seed.");
}

}  // namespace samara::python

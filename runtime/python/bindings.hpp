#pragma once

// Shared by the parts of the Python module `samara`: one file a part, each with its bind_ function.

#include <array>
#include <chrono>
#include <cstddef>
#include <cstring>
#include <exception>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <nlohmann/json_fwd.hpp>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include "samara/commands/shared/prepared_scene.hpp"
#include "samara/core/base/error.hpp"
#include "samara/core/files/input_file.hpp"
#include "samara/core/simulation/simulation.hpp"
#include "samara/motion/motion.hpp"
#include "samara/scene/scene_simulation.hpp"

namespace samara::python {

namespace py = pybind11;

/// An error in a caller's arguments: samara.InputError, which is a ValueError too.
class RaisedInputError : public Error {
    using Error::Error;
};

/// An error of a file that cannot be read or written: samara.FileError, which is an OSError too.
class RaisedFileError : public Error {
    using Error::Error;
};

/// Returns what `work` returns. Rethrows its Error as RaisedFileError where `file` cannot be read, else as
/// RaisedInputError.
template <typename Work>
auto on_input(const Work& work, const std::filesystem::path& file = {}) {
    try {
        return work();
    } catch (const RaisedInputError&) {
        throw;
    } catch (const RaisedFileError&) {
        throw;
    } catch (const SimulationError&) {
        throw;
    } catch (const Error& caught) {
        if (!file.empty() && !reading_error(file).empty()) throw RaisedFileError(caught.what());
        throw RaisedInputError(caught.what());
    }
}

/// Makes a class of the module. An object that Python made by __new__ alone, without __init__, holds nothing:
/// asked for anything it throws TypeError.
template <typename Type, typename... Options>
py::class_<Type, Options...> class_of(py::module_& module, const char* name, const char* purpose) {
    py::class_<Type, Options...> made(module, name, purpose);
    py::detail::get_type_info(typeid(Type))->operator_new = [](std::size_t) -> void* {
        throw py::type_error("the object is empty, as it was made by __new__ alone; call the class");
    };
    return made;
}

/// Returns the bytes of the file that `write` writes at the path that it is given.
py::bytes bytes_of_file(const std::string& name,
                        const std::function<void(const std::filesystem::path&)>& write);
/// Calls `read` with a file of these bytes, which is gone afterwards.
void with_file_of(const std::string& name, const py::bytes& bytes,
                  const std::function<void(const std::filesystem::path&)>& read);

/// Lets Python pickle and copy an object that never changes: a copy is the object itself, and a pickle what
/// `arguments` returns, from which the function `make` of the Python module `from` makes it again.
template <typename Class, typename Arguments>
void make_pickled(Class& bound, const char* from, const char* make, const Arguments& arguments) {
    bound
        .def("__reduce__",
             [from, make, arguments](const py::object& self) {
                 return py::make_tuple(py::module_::import(from).attr(make), arguments(self));
             })
        .def("__copy__", [](const py::object& self) { return self; })
        .def(
            "__deepcopy__", [](const py::object& self, const py::dict& /*memo*/) { return self; },
            py::arg("memo"));
}

/// A body of a motion, which it keeps alive.
struct BodyOfMotion {
    std::shared_ptr<const Motion> motion;
    std::size_t index = 0;

    [[nodiscard]] const BodyMotion& body() const { return motion->bodies[index]; }
};

/// A motion, and the report of its simulation where it was simulated here.
struct FlownMotion {
    std::shared_ptr<const Motion> motion;
    std::shared_ptr<const SimulationReport> report;  ///< null where the motion was read
};

/// The members of a pose that are arrays of their own.
enum class PoseMember { position, orientation, velocity, angular_velocity };

/// Returns one member of poses in row-major order as a read-only numpy array that shares their memory: shape
/// (leading..., 3), of orientations (leading..., 4) as x, y, z, w. `owner` keeps them alive.
py::array pose_view(const Pose* poses, std::vector<py::ssize_t> leading, PoseMember member,
                    const py::handle& owner);

/// Returns numbers in row-major order as a read-only numpy array that shares their memory; `owner` keeps them
/// alive.
template <typename Number>
py::array view(const Number* numbers, const std::vector<py::ssize_t>& shape, const py::handle& owner) {
    py::array array(py::dtype::of<Number>(), shape, numbers, owner);
    array.attr("setflags")(py::arg("write") = false);
    return array;
}

/// Returns `count` real numbers from any object of which numpy makes an array, of any memory order. Throws
/// TypeError, which names them, for another shape and for values that are no real numbers.
template <std::size_t count>
std::array<double, count> numbers_of(const py::handle& given, const char* name) {
    const py::array array = py::array::ensure(given);
    const bool fits = array && array.ndim() == 1 && array.shape(0) == static_cast<py::ssize_t>(count) &&
                      std::strchr("iufb", array.dtype().kind()) != nullptr;
    if (!fits) {
        PyErr_Clear();
        throw py::type_error(std::string(name) + ": give " + std::to_string(count) +
                             " real numbers, shape (" + std::to_string(count) + ",)");
    }
    const auto numbers = py::array_t<double, py::array::forcecast>::ensure(array);
    if (!numbers) throw py::error_already_set();
    std::array<double, count> result{};
    for (std::size_t i = 0; i < count; ++i) result[i] = numbers.at(static_cast<py::ssize_t>(i));
    return result;
}

/// Returns a dict as TOML text. Throws RaisedInputError, which calls it `place`, where a value is none of
/// TOML's, or nests without end.
std::string toml_text(const py::dict& values, const std::string& place);

/// Reads the text of toml_text() by read(); its errors do not name the lines, which the user did not write.
template <typename Read>
auto read_dict(const std::string& place, const Read& read) {
    try {
        return read();
    } catch (const Error& caught) {
        std::string text = caught.what();
        const std::size_t end = text.find_first_not_of("0123456789", place.size() + 1);
        if (text.starts_with(place + ":") && end > place.size() + 1)
            text.erase(place.size(), end - place.size());
        throw RaisedInputError(text);
    }
}

/// Throws RaisedInputError where there are no runs, or too many runs or threads.
void require_runs_and_threads(int runs, int threads);

/// Returns the scene made ready by prepare_scene(), whose files are read under hdf5_mutex(). Throws
/// RaisedFileError where a body's file cannot be read, RaisedInputError for all else.
PreparedScene prepared(Scene scene, Preparation preparation);

/// Returns a JSON value as Python's own: dict, list, float, int, str, bool, None.
py::object as_python(const nlohmann::json& value);

/// Returns the mutex of libhdf5, which is not made for several threads: it is held while a file is read or
/// written without the interpreter's lock. It is recursive for progress functions that read a file.
std::recursive_mutex& hdf5_mutex();

/// Runs a long piece of work without the interpreter's lock, so that other threads of Python go on, and calls
/// back for progress and interrupts. An exception that Python raises meanwhile, Ctrl-C among them, ends the
/// work at its next call of tell() and is what the caller sees.
class LongWork {
  public:
    /// Prepares the work. `progress`: None, or a function that is called with (done, total), ten times a
    /// second at most.
    explicit LongWork(py::object progress) : progress_(std::move(progress)) {}

    /// Is called by the work now and then; returns false where the work must end.
    bool tell(double done, double total);

    /// Does the work. Where tell() ended it, the exception of Python is rethrown instead of the work's own.
    template <typename Work>
    auto operator()(const Work& work) {
        const Counted counted;
        std::optional<decltype(work())> result;
        try {
            const py::gil_scoped_release others_go_on;
            result = work();
        } catch (...) {
            if (!raised_) throw;
        }
        if (raised_) std::rethrow_exception(raised_);
        return std::move(*result);
    }

    /// Ends all work in progress and waits for it: called as the interpreter exits, since threads without
    /// its lock cannot take it afterwards.
    static void end_all();

  private:
    using Clock = std::chrono::steady_clock;
    /// While it lives, end_all() waits.
    struct Counted {
        Counted();
        ~Counted();
        Counted(const Counted&) = delete;
        Counted& operator=(const Counted&) = delete;
    };

    py::object progress_;
    std::exception_ptr raised_;
    Clock::time_point last_ = Clock::now();
};

/// Binds scenes: samara.Scene.
void bind_scene(py::module_& module);
/// Binds motions: samara.Motion, BodyMotion, simulate, read_motion, compare.
void bind_motion(py::module_& module);
/// Binds simulations that advance step by step: samara.Simulation.
void bind_simulation(py::module_& module);
/// Binds body files: samara.Body.
void bind_body(py::module_& module);

}  // namespace samara::python

#include "bindings.hpp"
#include "samara/core/base/error.hpp"
#include "samara/core/base/version.hpp"

namespace samara::python {
namespace {

py::handle error;
py::handle input_error;
py::handle file_error;

/// Returns an exception class of the module that lasts as long as the interpreter.
py::handle exception(py::module_& module, const char* name, const py::tuple& bases, const char* purpose) {
    const std::string full = std::string("samara.") + name;
    PyObject* made = PyErr_NewExceptionWithDoc(full.c_str(), purpose, bases.ptr(), nullptr);
    if (made == nullptr) throw py::error_already_set();
    module.attr(name) = py::handle(made);
    return made;
}

void set_error(const py::handle& type, const Error& caught) {
    PyErr_SetString(type.ptr(), caught.what());
}

void bind_errors(py::module_& module) {
    error = exception(
        module, "Error", py::make_tuple(py::handle(PyExc_RuntimeError)),
        "The base of all errors of this module. Its text is one line that names the place and the remedy.");
    input_error =
        exception(module, "InputError", py::make_tuple(error, py::handle(PyExc_ValueError)),
                  "An error in an input: a scene, the content of a file or an argument. A ValueError too.");
    file_error = exception(module, "FileError", py::make_tuple(error, py::handle(PyExc_OSError)),
                           "An error of a file that cannot be read or written. An OSError too.");
    // NOLINTNEXTLINE(performance-unnecessary-value-param): so pybind11 calls it
    py::register_exception_translator([](std::exception_ptr thrown) {
        try {
            if (thrown) std::rethrow_exception(thrown);
        } catch (const RaisedFileError& caught) {
            set_error(file_error, caught);
        } catch (const RaisedInputError& caught) {
            set_error(input_error, caught);
        } catch (const SimulationError& caught) {
            const bool is_lost = caught.reason() == SimulationError::Reason::out_of_range;
            set_error(is_lost ? error : input_error, caught);
        } catch (const Error& caught) {
            set_error(error, caught);
        }
    });
}

}  // namespace

PYBIND11_MODULE(_samara, module) {
    module.doc() = "The compiled part of samara.";
    bind_errors(module);
    module.attr("__version__") = version;
    bind_scene(module);
    bind_body(module);
    bind_motion(module);
    bind_simulation(module);
    py::module_::import("atexit").attr("register")(py::cpp_function(&LongWork::end_all));
}

}  // namespace samara::python

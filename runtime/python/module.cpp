#include "bindings.hpp"
#include "samara/base/error.hpp"
#include "samara/base/version.hpp"

namespace samara::python {

PYBIND11_MODULE(_samara, module) {
    module.doc() = "The compiled part of samara.";
    py::register_exception<Error>(module, "Error", PyExc_RuntimeError).doc() =
        "What is wrong with a file, a scene or a request, in one line that names the place and the remedy.";
    module.attr("__version__") = version;
    bind_scene(module);
    bind_body(module);
    bind_motion(module);
    bind_flight(module);
    py::module_::import("atexit").attr("register")(py::cpp_function(&LongWork::end_all));
}

}  // namespace samara::python

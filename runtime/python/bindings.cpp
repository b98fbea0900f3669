#include "bindings.hpp"

#include <atomic>
#include <cstddef>
#include <fstream>
#include <iterator>
#include <string>
#include <utility>

#include <nlohmann/json.hpp>

#include "samara/core/base/error.hpp"
#include "samara/core/files/folders.hpp"

namespace samara::python {
namespace {

constexpr auto between_calls = std::chrono::milliseconds(100);

std::atomic<bool> exiting = false;
std::atomic<int> at_work = 0;

/// Returns the offset of a member in a pose, in bytes, and its number of numbers.
std::pair<std::size_t, py::ssize_t> place_of(PoseMember member) {
    switch (member) {
        case PoseMember::position:
            return {offsetof(Pose, position), 3};
        case PoseMember::orientation:
            return {offsetof(Pose, orientation), 4};
        case PoseMember::velocity:
            return {offsetof(Pose, velocity), 3};
        case PoseMember::angular_velocity:
            return {offsetof(Pose, angular_velocity), 3};
    }
    return {};
}

}  // namespace

py::bytes bytes_of_file(const std::string& name,
                        const std::function<void(const std::filesystem::path&)>& write) {
    const TemporaryFolder folder;
    write(folder / name);
    std::ifstream stream(folder / name, std::ios::binary);
    return std::string(std::istreambuf_iterator<char>(stream), {});
}

void with_file_of(const std::string& name, const py::bytes& bytes,
                  const std::function<void(const std::filesystem::path&)>& read) {
    const TemporaryFolder folder;
    std::ofstream(folder / name, std::ios::binary) << static_cast<std::string>(bytes);
    read(folder / name);
}

py::array pose_view(const Pose* poses, std::vector<py::ssize_t> leading, PoseMember member,
                    const py::handle& owner) {
    static_assert(sizeof(Quaterniond) == 4 * sizeof(double) && sizeof(Vector3d) == 3 * sizeof(double));
    const auto [offset, numbers] = place_of(member);
    std::vector<py::ssize_t> strides(leading.size() + 1, sizeof(double));
    py::ssize_t stride = sizeof(Pose);
    for (std::size_t i = leading.size(); i-- > 0; stride *= leading[i]) strides[i] = stride;
    leading.push_back(numbers);
    const auto* first = reinterpret_cast<const double*>(reinterpret_cast<const std::byte*>(poses) + offset);
    py::array array(py::dtype::of<double>(), std::move(leading), std::move(strides), first, owner);
    array.attr("setflags")(py::arg("write") = false);
    return array;
}

void require_runs_and_threads(int runs, int threads) {
    if (runs < 1 || runs > 1'000'000) throw RaisedInputError("runs: give 1 to 1000000");
    if (threads < 0 || threads > 4096) throw RaisedInputError("threads: give 0 for all cores, or up to 4096");
}

PreparedScene prepared(Scene scene, Preparation preparation) {
    const std::filesystem::path folder = preparation.bodies;
    preparation.reading = &hdf5_mutex();
    std::filesystem::path unreadable;
    for (const SceneBody& body : scene.bodies) {
        const std::filesystem::path file = folder.empty() ? body.shape : folder / (body.name + ".body.h5");
        if (unreadable.empty() && !reading_error(file).empty()) unreadable = file;
    }
    return on_input([&] { return prepare_scene(std::move(scene), preparation); }, unreadable);
}

py::object as_python(const nlohmann::json& value) {
    switch (value.type()) {
        case nlohmann::json::value_t::object: {
            py::dict dict;
            for (const auto& [key, member] : value.items()) dict[py::str(key)] = as_python(member);
            return dict;
        }
        case nlohmann::json::value_t::array: {
            py::list list;
            for (const auto& member : value) list.append(as_python(member));
            return list;
        }
        case nlohmann::json::value_t::string:
            return py::str(value.get_ref<const std::string&>());
        case nlohmann::json::value_t::boolean:
            return py::bool_(value.get<bool>());
        case nlohmann::json::value_t::number_integer:
            return py::int_(value.get<std::int64_t>());
        case nlohmann::json::value_t::number_unsigned:
            return py::int_(value.get<std::uint64_t>());
        case nlohmann::json::value_t::number_float:
            return py::float_(value.get<double>());
        default:
            return py::none();
    }
}

std::recursive_mutex& hdf5_mutex() {
    static std::recursive_mutex mutex;
    return mutex;
}

LongWork::Counted::Counted() {
    ++at_work;
}

LongWork::Counted::~Counted() {
    --at_work;
    at_work.notify_all();
}

bool LongWork::tell(double done, double total) {
    if (raised_) return false;
    const Clock::time_point now = Clock::now();
    if (!exiting && now - last_ < between_calls && done < total) return true;
    last_ = now;
    const py::gil_scoped_acquire interpreter;
    try {
        if (exiting) throw Error("the simulation was stopped, as the interpreter exits");
        if (PyErr_CheckSignals() != 0) throw py::error_already_set();
        if (!progress_.is_none()) progress_(done, total);
    } catch (...) {
        raised_ = std::current_exception();
    }
    return !raised_;
}

void LongWork::end_all() {
    exiting = true;
    const py::gil_scoped_release others_end;
    for (int count = at_work; count > 0; count = at_work) at_work.wait(count);
}

}  // namespace samara::python

// The 1:2:4 ellipsoid falling in water: the time of a step and the error of the trajectory against the step,
// for MuJoCo's ellipsoid fluid model and for ours. The models differ, so each is held against its own
// solution at a very small step. Prints a table, and writes it as a .csv where a file is named.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <mujoco/mujoco.h>

#include "peers/peer_body.hpp"
#include "samara/core/integrator/batch.hpp"
#include "samara/core/integrator/step.hpp"
#include "support/known_bodies.hpp"

namespace samara {
namespace {

constexpr double duration = 1.0;  // s
constexpr double density = 1200.0;
const Vector3d semi_axes(0.01, 0.02, 0.04);
const Vector3d earth(0.0, 0.0, -9.81);

/// Where a body is at the end of its fall, and the CPU time of the steps alone.
struct Place {
    Vector3d position;
    Quaterniond orientation;
    double seconds = 0.0;
};

/// A way to fall from rest for `duration` in so many steps, from a start that is turned by `perturbation`
/// (rad).
struct Method {
    std::string name;
    std::string solution;  // methods of one solution converge to the same motion
    std::function<Place(int steps, double perturbation)> fall;
    int reference_steps = 0;  // of the method that gives the solution; 0: it does not
};

/// The start: gravity along (-0.5, -0.25, -1) in body axes.
Quaterniond start(double perturbation) {
    const Quaterniond tilt =
        Quaterniond::FromTwoVectors(Vector3d(-0.5, -0.25, -1.0), Vector3d(0.0, 0.0, -1.0));
    return Quaterniond(Eigen::AngleAxisd(perturbation, Vector3d(1.0, 1.0, 0.0).normalized())) * tilt;
}

/// A model with the memory that its steps use.
struct Mujoco {
    std::shared_ptr<mjModel> model;
    std::shared_ptr<mjData> data;
};

/// One free ellipsoid and nothing else. MuJoCo knows no buoyancy: gravity is reduced by the fluid's share,
/// which is the same force, since the body is uniform. Everything but gravity and passive forces is switched
/// off.
Mujoco mujoco_ellipsoid(int integrator) {
    const Fluid water;
    const std::string text = fmt::format(
        "<mujoco><option density='{}' viscosity='{}' gravity='0 0 {}'/><worldbody><body><freejoint/>"
        "<geom type='ellipsoid' size='{} {} {}' density='{}' fluidshape='ellipsoid' contype='0' "
        "conaffinity='0'/></body></worldbody></mujoco>",
        water.density, water.viscosity, earth.z() * (1.0 - water.density / density), semi_axes.x(),
        semi_axes.y(), semi_axes.z(), density);
    const auto files = std::make_unique<mjVFS>();
    mj_defaultVFS(files.get());
    mj_makeEmptyFileVFS(files.get(), "body.xml", static_cast<int>(text.size()));
    std::memcpy(files->filedata[0], text.data(), text.size());
    std::array<char, 1000> error{};
    const std::shared_ptr<mjModel> model(mj_loadXML("body.xml", files.get(), error.data(), error.size()),
                                         mj_deleteModel);
    mj_deleteVFS(files.get());
    if (!model) throw std::runtime_error(error.data());
    model->opt.integrator = integrator;
    model->opt.disableflags = mjDSBL_CONSTRAINT | mjDSBL_EQUALITY | mjDSBL_FRICTIONLOSS | mjDSBL_LIMIT |
                              mjDSBL_CONTACT | mjDSBL_CLAMPCTRL | mjDSBL_WARMSTART | mjDSBL_ACTUATION |
                              mjDSBL_SENSOR;
    return {model, std::shared_ptr<mjData>(mj_makeData(model.get()), mj_deleteData)};
}

/// MuJoCo starts the fall again where a number runs away; the place is then not a number.
Place mujoco_fall(const Mujoco& mujoco, int steps, double perturbation) {
    mjModel* model = mujoco.model.get();
    mjData* data = mujoco.data.get();
    mj_resetData(model, data);
    const Quaterniond orientation = start(perturbation);
    const std::array<double, 7> pose = {
        0.0, 0.0, 0.0, orientation.w(), orientation.x(), orientation.y(), orientation.z()};
    std::copy(pose.begin(), pose.end(), data->qpos);
    model->opt.timestep = duration / steps;
    const double begin = cpu_time();
    bool broke = false;
    for (int i = 0; i < steps; ++i) {
        mj_step(model, data);
        for (const int error : {mjWARN_BADQPOS, mjWARN_BADQVEL, mjWARN_BADQACC}) {
            broke = broke || data->warning[error].number > 0;
        }
    }
    const double seconds = cpu_time() - begin;
    const double* q = data->qpos;
    if (broke) return {Vector3d::Constant(std::nan("")), Quaterniond::Identity(), seconds};
    return {Vector3d(q[0], q[1], q[2]), Quaterniond(q[3], q[4], q[5], q[6]), seconds};
}

Method mujoco_method(const std::string& name, int integrator, int reference_steps) {
    return {"MuJoCo " + name, "MuJoCo",
            [mujoco = mujoco_ellipsoid(integrator)](int steps, double perturbation) {
                return mujoco_fall(mujoco, steps, perturbation);
            },
            reference_steps};
}

BodyState start_state(double perturbation) {
    BodyState state;
    state.orientation = start(perturbation);
    return state;
}

Method samara_method(const std::string& name, ImmersedBody body, int reference_steps) {
    return {"samara " + name, "samara " + name,
            [body = std::move(body)](int steps, double perturbation) {
                const Noise noise(1, "body", 0, 0);
                const double h = duration / steps;
                BodyState state = start_state(perturbation);
                const double begin = cpu_time();
                for (int i = 0; i < steps; ++i) {
                    state = advance(body, {.gravity = earth}, i * h, h, state, noise,
                                    static_cast<std::uint64_t>(i))
                                .state;
                }
                return Place{state.position, state.orientation, cpu_time() - begin};
            },
            reference_steps};
}

ImmersedBody ellipsoid_with_coefficients() {
    SceneBody given = test::scene_body(density);
    given.loads = Loads::coefficients;
    given.coefficients.lift_coefficient = 1.0;
    return make_immersed_body(test::rubber_ellipsoid(), given, Fluid{});
}

std::vector<Method> methods() {
    return {mujoco_method("Euler", mjINT_EULER, 0), mujoco_method("implicit", mjINT_IMPLICIT, 0),
            mujoco_method("RK4", mjINT_RK4, 100'000),
            samara_method("tables", test::blunt_ellipsoid(), 1'000'000),
            samara_method("coefficients", ellipsoid_with_coefficients(), 1'000'000)};
}

double distance(const Place& a, const Place& b) {
    return (a.position - b.position).norm();
}

/// The angle between two orientations (rad); not acos of their product, which is blind below 1e-8.
double angle(const Place& a, const Place& b) {
    return 2.0 * std::asin(std::min(1.0, (a.orientation.conjugate() * b.orientation).vec().norm()));
}

struct Row {
    std::string method;
    int steps = 0;
    double milliseconds = 0.0;    // of CPU for one simulated second
    double nanoseconds = 0.0;     // of CPU for one step
    double position_error = 0.0;  // relative to the path; not a number: the fall broke
    double angle_error = 0.0;
};

Row measured(const Method& method, int steps, const Place& exact) {
    Row row{.method = method.name, .steps = steps};
    double least = 1e300;
    double spent = 0.0;
    Place end{};
    for (int run = 0; run < 200 && (run < 3 || spent < 0.3); ++run) {
        end = method.fall(steps, 0.0);
        least = std::min(least, end.seconds);
        spent += end.seconds;
    }
    row.milliseconds = 1e3 * least / duration;
    row.nanoseconds = 1e9 * least / steps;
    row.position_error = distance(end, exact) / exact.position.norm();
    row.angle_error = end.position.allFinite() ? angle(end, exact) : std::nan("");
    return row;
}

/// By how much a small turn of the start has grown at the end: far below 1/error, so that the motion is not
/// chaotic here.
double growth(const Method& method, int steps) {
    constexpr double perturbation = 1e-6;
    return angle(method.fall(steps, perturbation), method.fall(steps, 0.0)) / perturbation;
}

/// Nanoseconds of CPU for one step of one body in a batch.
double batch_nanoseconds(const ImmersedBody& body) {
    constexpr std::size_t bodies = 1024;
    constexpr std::uint64_t steps = 100;
    double least = 1e300;
    for (int run = 0; run < 5; ++run) {
        Batch batch(body, bodies);
        for (std::size_t i = 0; i < bodies; ++i) {
            batch.set_state(i, start_state(1e-3 * static_cast<double>(i)));
            batch.set_noise(i, Noise(1, "body", 0, static_cast<std::uint32_t>(i)));
        }
        const double begin = cpu_time();
        batch.advance({.gravity = earth}, 0.0, 0.002, 0, steps);
        least = std::min(least, cpu_time() - begin);
    }
    return 1e9 * least / static_cast<double>(bodies * steps);
}

const Method& reference_of(const std::vector<Method>& all, const Method& method) {
    return *std::find_if(all.begin(), all.end(), [&](const Method& other) {
        return other.solution == method.solution && other.reference_steps > 0;
    });
}

void print(const std::vector<Row>& rows) {
    fmt::print("{:20} {:>7} {:>12} {:>9} {:>10} {:>10}\n", "method", "steps", "CPU ms/s", "ns/step",
               "position", "angle, rad");
    for (const Row& row : rows) {
        fmt::print("{:20} {:7} {:12.4f} {:9.0f} {:10.1e} {:10.1e}\n", row.method, row.steps, row.milliseconds,
                   row.nanoseconds, row.position_error, row.angle_error);
    }
}

void write(const std::vector<Row>& rows, const std::string& file) {
    std::ofstream stream(file);
    stream << "method,steps_per_second,cpu_milliseconds_per_second,nanoseconds_per_step,"
              "relative_position_error,angle_error_rad\n";
    for (const Row& row : rows) {
        stream << fmt::format("{},{},{:.5g},{:.4g},{:.3e},{:.3e}\n", row.method, row.steps, row.milliseconds,
                              row.nanoseconds, row.position_error, row.angle_error);
    }
    if (!stream.flush()) throw std::runtime_error(file + ": cannot be written");
}

void compare(const char* file) {
    mju_user_warning = [](const char*) {};  // the table says which falls broke
    const std::vector<Method> all = methods();
    std::vector<Row> rows;
    for (const Method& method : all) {
        const Method& reference = reference_of(all, method);
        const Place exact = reference.fall(reference.reference_steps, 0.0);
        if (&reference == &method) {
            fmt::print("{}: fell {:.4f} m; a turn of the start by 1e-6 rad grew {:.1f} times\n",
                       method.solution, exact.position.norm(), growth(method, 10'000));
            fmt::print("  the solution moves by {:.1e} when it takes twice the step\n",
                       distance(exact, method.fall(method.reference_steps / 2, 0.0)) / exact.position.norm());
        }
        for (const int steps : {24, 60, 120, 250, 500, 1000, 2000, 5000, 10'000}) {
            rows.push_back(measured(method, steps, exact));
        }
    }
    print(rows);
    fmt::print(
        "samara, batch of 1024 bodies on one core, ns for one step of one body: tables {:.0f}, "
        "coefficients {:.0f}\n",
        batch_nanoseconds(test::blunt_ellipsoid()), batch_nanoseconds(ellipsoid_with_coefficients()));
    if (file != nullptr) write(rows, file);
}

}  // namespace
}  // namespace samara

int main(int count, char** words) {
    try {
        samara::compare(count > 1 ? words[1] : nullptr);
        return 0;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "samara-mujoco-comparison: %s\n", error.what());
        return 1;
    }
}

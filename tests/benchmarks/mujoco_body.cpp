#include "mujoco_body.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <ctime>
#include <string>

#include <fmt/format.h>

#include "internal/command/load_body.hpp"
#include "samara/base/error.hpp"
#include "samara/body/body.hpp"

namespace samara {
namespace {

/// CPU seconds of this thread.
double cpu_time() {
    std::timespec now{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

std::shared_ptr<mjModel> model_of(const std::string& text) {
    const auto files = std::make_unique<mjVFS>();
    mj_defaultVFS(files.get());
    mj_makeEmptyFileVFS(files.get(), "body.xml", static_cast<int>(text.size()));
    std::memcpy(files->filedata[0], text.data(), text.size());
    std::array<char, 1000> fault{};
    std::shared_ptr<mjModel> model(mj_loadXML("body.xml", files.get(), fault.data(), fault.size()),
                                   mj_deleteModel);
    mj_deleteVFS(files.get());
    if (!model) throw Error(fmt::format("MuJoCo refuses the body: {}", fault.data()));
    return model;
}

/// Half the body's extents along its principal axes, about its centroid (m).
Vector3d half_extents(const Body& body, const Matrix3d& axes) {
    Vector3d half = Vector3d::Zero();
    for (const Vector3d& vertex : body.surface.vertices) {
        half = half.cwiseMax((axes.transpose() * (vertex - body.moments.centroid)).cwiseAbs());
    }
    return half;
}

}  // namespace

MujocoBody::MujocoBody(const Scene& scene, const Motion& reference, int integrator)
    : reference_(reference), step_(scene.step) {
    const SceneBody& given = scene.bodies.front();
    if (!given.mass.density) {
        throw Error(fmt::format("{}: the body has no uniform density", scene.file.string()));
    }
    const double density = *given.mass.density;
    const Body body = load_body(given.shape, given.scale);
    const Matrix3d axes = principal_axes(body.moments);
    axes_ = Quaterniond(axes);
    turn_ = given.orientation * axes_;
    start_ = given.position + given.orientation * body.moments.centroid;
    velocity_ = given.velocity;
    angular_velocity_ = given.angular_velocity;

    const Vector3d half = half_extents(body, axes);
    const Vector3d inertia = (axes.transpose() * uniform_inertia(body.moments, density) * axes).diagonal();
    const Vector3d gravity = scene.gravity * (1.0 - scene.fluid.density / density);
    model_ = model_of(fmt::format(
        "<mujoco><option density='{}' viscosity='{}' gravity='{} {} {}'/><worldbody><body><freejoint/>"
        "<inertial pos='0 0 0' mass='{}' diaginertia='{} {} {}'/>"
        "<geom type='ellipsoid' size='{} {} {}' fluidshape='ellipsoid' contype='0' conaffinity='0'/>"
        "</body></worldbody></mujoco>",
        scene.fluid.density, scene.fluid.viscosity, gravity.x(), gravity.y(), gravity.z(),
        density * body.moments.volume, inertia.x(), inertia.y(), inertia.z(), half.x(), half.y(), half.z()));
    model_->opt.integrator = integrator;
    model_->opt.disableflags = mjDSBL_CONSTRAINT | mjDSBL_EQUALITY | mjDSBL_FRICTIONLOSS | mjDSBL_LIMIT |
                               mjDSBL_CONTACT | mjDSBL_CLAMPCTRL | mjDSBL_WARMSTART | mjDSBL_ACTUATION |
                               mjDSBL_SENSOR;
    data_ = std::shared_ptr<mjData>(mj_makeData(model_.get()), mj_deleteData);
}

Pose MujocoBody::pose() const {
    const double* q = data_->qpos;
    const double* u = data_->qvel;  // the velocity in world axes, the turning in the body's
    const Quaterniond turn(q[3], q[4], q[5], q[6]);
    Pose pose;
    pose.position = Vector3d(q[0], q[1], q[2]);
    pose.orientation = (turn * axes_.conjugate()).normalized();
    pose.velocity = Vector3d(u[0], u[1], u[2]);
    pose.angular_velocity = turn * Vector3d(u[3], u[4], u[5]);
    return pose;
}

MujocoFall MujocoBody::fall(const FluidCoefficients& coefficients, int cuts) const {
    mjModel* model = model_.get();
    mjData* data = data_.get();
    mj_resetData(model, data);
    // The first of a geom's twelve numbers says that the fluid acts; the added masses follow the
    // coefficients.
    std::copy(coefficients.begin(), coefficients.end(), model->geom_fluid + 1);
    const std::array<double, 7> place = {start_.x(), start_.y(), start_.z(), turn_.w(),
                                         turn_.x(),  turn_.y(),  turn_.z()};
    const Vector3d turning = turn_.conjugate() * angular_velocity_;
    const std::array<double, 6> motion = {velocity_.x(), velocity_.y(), velocity_.z(),
                                          turning.x(),   turning.y(),   turning.z()};
    std::copy(place.begin(), place.end(), data->qpos);
    std::copy(motion.begin(), motion.end(), data->qvel);
    model->opt.timestep = step_ / cuts;

    MujocoFall result;
    Pose before = pose();
    Pose after = before;
    for (const double time : reference_.times) {
        const int needed = static_cast<int>(std::ceil(time * (1.0 - 1e-12) / model->opt.timestep));
        const double begin = cpu_time();
        for (; result.steps < needed; ++result.steps) {
            if (result.steps + 1 == needed) before = pose();
            mj_step(model, data);
        }
        result.seconds += cpu_time() - begin;
        after = pose();
        for (const int fault : {mjWARN_BADQPOS, mjWARN_BADQVEL, mjWARN_BADQACC}) {
            if (data->warning[fault].number > 0) return {{}, result.steps, result.seconds};
        }
        const double fraction =
            result.steps == 0 ? 1.0 : time / model->opt.timestep - static_cast<double>(result.steps - 1);
        Pose frame = interpolated(before, after, std::clamp(fraction, 0.0, 1.0), model->opt.timestep);
        if (!result.poses.empty()) keep_sign_continuous(frame.orientation, result.poses.back().orientation);
        result.poses.push_back(frame);
    }
    return result;
}

Motion MujocoBody::motion(const MujocoFall& fall, const FluidCoefficients& coefficients) const {
    Motion motion = reference_;
    BodyMotion& body = motion.bodies.front();
    body.models = fmt::format("MuJoCo {}, ellipsoid fluid model, fluidcoef {}", mj_versionString(),
                              fmt::join(coefficients, " "));
    body.poses = fall.poses;
    return motion;
}

}  // namespace samara

#include "mujoco_body.hpp"

#include <algorithm>
#include <array>
#include <cstring>
#include <memory>
#include <string>

#include <fmt/format.h>
#include <mujoco/mujoco.h>

#include "samara/commands/shared/load_body.hpp"
#include "samara/core/base/error.hpp"
#include "samara/core/body/body.hpp"

namespace samara {
namespace {

std::shared_ptr<mjModel> model_of(const std::string& text) {
    const auto files = std::make_unique<mjVFS>();
    mj_defaultVFS(files.get());
    mj_makeEmptyFileVFS(files.get(), "body.xml", static_cast<int>(text.size()));
    std::memcpy(files->filedata[0], text.data(), text.size());
    std::array<char, 1000> error{};
    std::shared_ptr<mjModel> model(mj_loadXML("body.xml", files.get(), error.data(), error.size()),
                                   mj_deleteModel);
    mj_deleteVFS(files.get());
    if (!model) throw Error(fmt::format("MuJoCo refuses the body: {}", error.data()));
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

class MujocoBody : public PeerBody {
  public:
    MujocoBody(const Scene& scene, const Motion& reference, int integrator);

    [[nodiscard]] PeerFall fall(const std::vector<double>& coefficients, int cuts) const override;
    [[nodiscard]] std::string words() const override {
        return fmt::format("MuJoCo {}, ellipsoid fluid model", mj_versionString());
    }

  private:
    [[nodiscard]] Pose pose() const;

    std::vector<double> times_;
    double step_;
    Vector3d start_ = Vector3d::Zero();             // of the centre of mass (m, world)
    Quaterniond turn_ = Quaterniond::Identity();    // principal axes to world, at the start
    Quaterniond axes_ = Quaterniond::Identity();    // principal axes to shape axes
    Vector3d velocity_ = Vector3d::Zero();          // m/s, world
    Vector3d angular_velocity_ = Vector3d::Zero();  // rad/s, world
    std::shared_ptr<mjModel> model_;
    std::shared_ptr<mjData> data_;
};

MujocoBody::MujocoBody(const Scene& scene, const Motion& reference, int integrator)
    : times_(reference.times), step_(scene.step) {
    const SceneBody& given = scene.bodies.front();
    if (!given.mass.density) {
        throw Error(fmt::format("{}: the body has no uniform density", scene.file.string()));
    }
    const double density = *given.mass.density;
    const Body body = load_body(given.shape, reading_of(given));
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

PeerFall MujocoBody::fall(const std::vector<double>& coefficients, int cuts) const {
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
    const auto advance = [model, data] {
        mj_step(model, data);
        return std::ranges::none_of(std::array{mjWARN_BADQPOS, mjWARN_BADQVEL, mjWARN_BADQACC},
                                    [data](int error) { return data->warning[error].number > 0; });
    };
    return flown_through(times_, model->opt.timestep, advance, [this] { return pose(); });
}

}  // namespace

PeerModel mujoco_model(int integrator) {
    return {"mujoco",
            {{"blunt drag", 0.5, 0.0, 4.0},
             {"slender drag", 0.25, 0.0, 12.0},
             {"angular drag", 1.5, 0.0, 16.0},
             {"Kutta lift", 1.0, 0.0, 6.0},
             {"Magnus lift", 1.0, 0.0, 6.0}},
            [integrator](const Scene& scene, const Motion& reference) {
                return std::make_shared<MujocoBody>(scene, reference, integrator);
            }};
}

}  // namespace samara

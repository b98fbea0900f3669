#include "runtime/engines/mujoco/fluid_bodies.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstring>
#include <utility>

#include <Eigen/Core>

#include "runtime/engines/mujoco/inertia_matrix.hpp"
#include "samara/core/physics/fluid.hpp"

namespace samara::mujoco {
namespace {

// Numbers of the state before the words of samara's own: whether there is one, and MuJoCo's time at its last
// step.
constexpr std::size_t heads = 2;

/// The text of the C interface's last error.
class Fault {
  public:
    /// Throws ModelError with that text where the call failed.
    void require(samara_status status) const {
        if (status != SAMARA_OK) throw ModelError(text_.data());
    }
    char* data() { return text_.data(); }
    [[nodiscard]] static constexpr std::size_t size() { return 512; }

  private:
    std::array<char, 512> text_{};
};

std::string name_of(const mjModel& model, int body) {
    const char* name = mj_id2name(&model, mjOBJ_BODY, body);
    return name != nullptr && *name != '\0' ? name : "body-" + std::to_string(body);
}

double number(const std::string& text, const char* key, double otherwise) {
    if (text.empty()) return otherwise;
    double value = 0.0;
    const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (fault != std::errc() || end != text.data() + text.size())
        throw ModelError(std::string(key) + " is \"" + text + "\", but must be a number");
    return value;
}

/// The names of samara's groups key the noise and have letters, digits, - and _ alone.
std::string group_name(std::string name) {
    for (char& letter : name) {
        if (std::isalnum(static_cast<unsigned char>(letter)) == 0 && letter != '-') letter = '_';
    }
    return name;
}

/// What a simulation is made of: step, gravity, then mass, centre and inertia of each body.
std::vector<double> ingredients(const mjModel& model, const std::vector<int>& bodies) {
    std::vector<double> all{model.opt.timestep};
    all.insert(all.end(), model.opt.gravity, model.opt.gravity + 3);
    for (const int body : bodies) {
        all.push_back(model.body_mass[body]);
        all.insert(all.end(), part(model.body_ipos, 3, body), part(model.body_ipos, 3, body) + 3);
        all.insert(all.end(), part(model.body_inertia, 3, body), part(model.body_inertia, 3, body) + 3);
        all.insert(all.end(), part(model.body_iquat, 4, body), part(model.body_iquat, 4, body) + 4);
    }
    return all;
}

samara_settings settings_of(const mjModel& model, const Settings& setting) {
    Fault fault;
    samara_settings made;
    fault.require(samara_default_settings(&made, sizeof made, fault.data(), fault.size()));
    const std::string preset = setting("fluid");
    const auto fluid = fluid_preset(preset.empty() ? "water" : preset);
    if (!fluid) throw ModelError("fluid is \"" + preset + "\", but must be water or air");
    made.fluid_density = number(setting("density"), "density", fluid->density);
    made.fluid_viscosity = number(setting("viscosity"), "viscosity", fluid->viscosity);
    std::copy_n(model.opt.gravity, 3, made.gravity);
    made.step = model.opt.timestep;
    made.seed = static_cast<std::uint64_t>(number(setting("seed"), "seed", 1.0));
    return made;
}

samara_body_group group_of(const mjModel& model, int body, const std::string& turbulence) {
    Fault fault;
    samara_body_group group;
    fault.require(samara_default_body_group(&group, sizeof group, fault.data(), fault.size()));
    group.mass = model.body_mass[body];
    group.has_center_of_mass = 1;
    std::copy_n(part(model.body_ipos, 3, body), 3, group.center_of_mass);
    mjtNum turn[9];
    mju_quat2Mat(turn, part(model.body_iquat, 4, body));
    for (int row = 0; row < 3; ++row) {
        for (int column = 0; column < 3; ++column) {
            for (int axis = 0; axis < 3; ++axis) {
                group.inertia[3 * row + column] +=
                    turn[3 * row + axis] * model.body_inertia[3 * body + axis] * turn[3 * column + axis];
            }
        }
    }
    if (turbulence == "off")
        group.turbulence = SAMARA_TURBULENCE_NONE;
    else if (!turbulence.empty() && turbulence != "on")
        throw ModelError("turbulence is \"" + turbulence + "\", but must be on or off");
    return group;
}

}  // namespace

FluidBodies::FluidBodies(const mjModel& model, std::vector<int> bodies, const Settings& settings)
    : bodies_(std::move(bodies)), made_of_(ingredients(model, bodies_)), step_(model.opt.timestep) {
    Fault fault;
    const samara_settings fluid = settings_of(model, settings);
    samara_simulation* simulation = nullptr;
    fault.require(samara_simulation_create(&fluid, &simulation, fault.data(), fault.size()));
    simulation_.reset(simulation);
    const std::string wind = settings("wind");
    if (!wind.empty()) fault.require(samara_set_wind(simulation, wind.c_str(), fault.data(), fault.size()));

    const std::string file = settings("file");
    if (file.empty()) throw ModelError("file is missing: name the body file, such as leaf.body.h5");
    samara_body* read = nullptr;
    fault.require(samara_body_load(file.c_str(), &read, fault.data(), fault.size()));
    const std::unique_ptr<samara_body, void (*)(samara_body*)> shape(read, samara_body_free);
    for (const int body : bodies_) {
        const std::string name = name_of(model, body);
        if (is_diagonal(model, body)) {
            throw ModelError(
                "MuJoCo keeps the inertia of body \"" + name +
                "\" as a diagonal, which has no room for the fluid's; write <body/> inside of it");
        }
        if (!(model.body_mass[body] > 0.0)) throw ModelError("body \"" + name + "\" has no mass");
        samara_body_group group = group_of(model, body, settings("turbulence"));
        const std::string key = group_name(name);
        group.name = key.c_str();
        fault.require(samara_simulation_add(simulation, read, &group, nullptr, fault.data(), fault.size()));
    }
    start_.resize((samara_state_size(simulation) + 3) / 4);
    held_ = start_;
    fault.require(samara_get_state(simulation, start_.data(), samara_state_size(simulation), fault.data(),
                                   fault.size()));
}

std::size_t FluidBodies::state_size() const {
    return heads + start_.size();
}

bool FluidBodies::fits(const mjModel& model) const {
    return ingredients(model, bodies_) == made_of_;
}

void FluidBodies::resume(double time, mjtNum* state) {
    Fault fault;
    const auto set = [&](const std::vector<std::uint32_t>& words) {
        return samara_set_state(simulation_.get(), words.data(), samara_state_size(simulation_.get()),
                                fault.data(), fault.size());
    };
    mjtNum* words = state + heads;
    // The state of a model that has since been given another step or mass is none of this simulation's.
    bool fresh = state[0] == 0.0;
    if (!fresh && !std::equal(held_.begin(), held_.end(), words)) {
        std::transform(words, words + held_.size(), held_.begin(),
                       [](mjtNum word) { return static_cast<std::uint32_t>(word); });
        fresh = set(held_) != SAMARA_OK;
    }
    if (fresh) fault.require(set(start_));
    // Not before three quarters of a step: stages of Runge-Kutta lie in between.
    const bool advances = !fresh && time > state[1] + 0.75 * step_;
    if (advances) {
        const double steps = std::round(samara_simulation_time(simulation_.get()) / step_) + 1.0;
        fault.require(samara_advance_to(simulation_.get(), steps * step_, fault.data(), fault.size()));
    }
    if (fresh || advances || time < state[1]) state[1] = time;
    state[0] = 1.0;
}

void FluidBodies::keep(mjtNum* state) {
    Fault fault;
    fault.require(samara_get_state(simulation_.get(), held_.data(), samara_state_size(simulation_.get()),
                                   fault.data(), fault.size()));
    std::copy(held_.begin(), held_.end(), state + heads);
}

void FluidBodies::add(const mjModel& model, mjData& data, std::size_t number) {
    const int body = bodies_[number];
    const BodyMotion motion = motion_of(model, data, body);
    if (motion.dofs.empty()) return;  // part of the world
    samara_pose pose;
    std::copy_n(part(data.xpos, 3, body), 3, pose.position);
    std::copy_n(part(data.xquat, 4, body), 4, pose.orientation);
    std::copy_n(motion.velocity.data(), 3, pose.angular_velocity);
    std::copy_n(motion.velocity.data() + 3, 3, pose.velocity);
    Fault fault;
    samara_fluid_load load;
    fault.require(samara_set_poses(simulation_.get(), number, 1, &pose, 0, fault.data(), fault.size()));
    fault.require(samara_get_fluid_load(simulation_.get(), number, &load, fault.data(), fault.size()));

    using Matrix = Eigen::Matrix<double, 6, 6, Eigen::RowMajor>;
    const Eigen::Map<const Matrix> added(load.added_inertia);
    const Eigen::Map<const Matrix> damping(load.damping);
    // Runge-Kutta takes the drag as it is: its stages are of higher order than the damping's.
    const double implicit = model.opt.integrator == mjINT_RK4 ? 0.0 : step_;
    add_inertia(model, data, motion, added + 0.5 * implicit * (damping + damping.transpose()));
    const Vector6 force = Eigen::Map<const Vector6>(load.wrench) - added * motion.acceleration;
    for (std::size_t i = 0; i < motion.dofs.size(); ++i)
        data.qfrc_passive[motion.dofs[i]] += motion.jacobian.col(static_cast<Eigen::Index>(i)).dot(force);
}

void FluidBodies::apply(const mjModel& model, mjData& data, mjtNum* state) {
    resume(data.time, state);
    for (std::size_t i = 0; i < bodies_.size(); ++i) add(model, data, i);
    keep(state);
}

}  // namespace samara::mujoco

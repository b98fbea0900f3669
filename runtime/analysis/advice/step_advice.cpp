#include "samara/analysis/advice/step_advice.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <exception>
#include <limits>
#include <memory>
#include <utility>

#include <fmt/format.h>

#include "samara/core/base/parallel_for.hpp"
#include "samara/core/dynamics/body_size.hpp"
#include "samara/core/dynamics/loads.hpp"
#include "samara/core/kernel/step_constants.hpp"
#include "samara/core/simulation/body_group.hpp"
#include "samara/core/simulation/world_pose.hpp"
#include "samara/scene/scene_simulation.hpp"
#include "samara/scene/terminal_speed.hpp"

namespace samara {
namespace {

constexpr double longest_step = 0.04;  // s; the others are this over powers of two, whatever the frames
constexpr int most_copies = 4;
constexpr int most_windows = 48;
constexpr double lengths_in_window = 4.0;
constexpr double finest_of_length = 0.01;  // distance in lengths L that a body moves in the finest step
constexpr int fewest_halvings = 4;         // of the longest step, down to the finest
constexpr int most_halvings = 14;
constexpr int truth_halvings = 2;        // of the finest step that is judged, to the step of the reference
constexpr double least_rotation = 0.01;  // speed of a tip, relative to the body's: less is not judged
constexpr double turbulence_rate =
    0.75 * kolmogorov_constant;  // times epsilon/k: docs/explanation/noise-and-wake.md#seen-fluid

/// Simulates one body at several steps.
class JudgedBody {
  public:
    JudgedBody(const Scene& scene, const SceneBody& scene_body, const LoadedBody& loaded)
        : scene_(scene), loaded_(loaded), name_(scene_body.name), physics_(scene_body), release_(scene_body) {
        turbulent_ = physics_.turbulence != Turbulence::none;
        quiet_ = physics_;
        quiet_.turbulence = Turbulence::none;
        release_.count = std::min(release_.count, most_copies);
        set_scales();
    }

    /// Returns the longest steps that motion and turbulence allow.
    BodyStep judge() {
        fly_finest();
        BodyStep result{.name = name_};
        errors_.clear();
        for (int j = 0; j <= halvings_ - truth_halvings; ++j) errors_.push_back(errors_at(j));
        result.motion = longest_within(&StepErrors::motion);
        result.rotation =
            turbulent_ ? longest_within(&StepErrors::rotation) : std::numeric_limits<double>::infinity();
        result.turbulence = std::numeric_limits<double>::infinity();
        if (turbulent_ && samples_ > 0 && squared_rates_ > 0.0) {
            const double rate = std::sqrt(squared_rates_ / static_cast<double>(samples_));
            result.turbulence = std::sqrt(12.0 * scene_.step_tolerance) / rate;
        }
        return result;
    }

    /// Returns the relative error of the motion at the longest step over a power of two.
    [[nodiscard]] double error_of(double step) const {
        const auto j = static_cast<std::size_t>(std::max(0L, std::lround(std::log2(longest_step / step))));
        return errors_[std::min(j, errors_.size() - 1)].motion;
    }
    [[nodiscard]] bool is_within() const { return is_within_; }

  private:
    /// The reference simulation through a window: poses at its begin and end, and within steps.
    struct Window {
        std::vector<Pose> begin, end;
        std::vector<std::vector<Pose>> middle;  // half a step before, for each step that is judged
    };
    struct StepErrors {
        double motion;    ///< error of centre of mass and tip, relative to
                          ///< the distance covered
        double rotation;  ///< error of the rms angular speed, relative
    };

    static double step_of(int halvings) { return longest_step / std::exp2(halvings); }

    /// Returns the longest step from which on all shorter ones are within the tolerance, or the shortest.
    double longest_within(double StepErrors::*error) {
        int longest = 0;
        const int shortest = static_cast<int>(errors_.size()) - 1;
        for (int j = 0; j <= shortest; ++j) {
            if (errors_[as_place(j)].*error > scene_.step_tolerance) longest = j + 1;
        }
        is_within_ = is_within_ && longest <= shortest;
        return step_of(std::min(longest, shortest));
    }

    void set_scales() {
        Simulation simulation(settings_at(longest_step));
        add_to(simulation, quiet_);
        const ImmersedBody& body = simulation.groups()[0]->body();
        double smallest = simulation.size_of(0);
        double largest = smallest;
        for (std::size_t i = 1; i < simulation.size(); ++i) {
            smallest = std::min(smallest, simulation.size_of(i));
            largest = std::max(largest, simulation.size_of(i));
        }
        half_length_ = 0.5 * largest * body.length;
        double speed = std::sqrt(largest) *
                       terminal_speed(*loaded_.body, scene_.fluid, body.mass, scene_.gravity.norm());
        for (std::size_t i = 0; i < simulation.size(); ++i) {
            const Pose start = simulation.groups()[0]->pose_in_wind(i, simulation.groups()[0]->start(i));
            speed = std::max(speed, start.velocity.norm() + half_length_ * start.angular_velocity.norm());
        }
        const double length = smallest * body.length;
        const double wanted =
            speed > 0.0 ? std::log2(longest_step * speed / (finest_of_length * length)) : 0.0;
        halvings_ =
            static_cast<int>(std::clamp(std::ceil(wanted), double{fewest_halvings}, double{most_halvings}));
        const double window = speed > 0.0 ? lengths_in_window * largest * body.length / speed : 0.0;
        steps_in_window_ = static_cast<int>(std::clamp(std::ceil(window / longest_step), 1.0, 1e4));
        const double steps = std::max(0.0, (scene_.duration - release_.start) / longest_step);
        windows_ =
            static_cast<int>(std::clamp(std::floor(steps / steps_in_window_), 1.0, double{most_windows}));
    }
    [[nodiscard]] SimulationSettings settings_at(double step) const {
        SimulationSettings settings = simulation_settings(scene_, 1, 1);
        settings.ground.reset();
        settings.obstacles.clear();
        settings.step = step;
        return settings;
    }
    void add_to(Simulation& simulation, const BodyPhysics& physics) const {
        simulation.add(loaded_, physics, release_, name_);
    }

    /// Returns the end of window number w (s).
    [[nodiscard]] double end_of(int w) const {
        return release_.start + static_cast<double>(w * steps_in_window_) * longest_step;
    }

    /// Returns the poses at which the windows begin. With noise they are those of a simulation with it, since
    /// it may be the noise that makes the bodies rotate.
    void fly_finest() {
        Simulation simulation(settings_at(step_of(halvings_)));
        add_to(simulation, quiet_);
        std::unique_ptr<Simulation> noisy;
        if (turbulent_) {
            noisy = std::make_unique<Simulation>(settings_at(step_of(halvings_ - truth_halvings)));
            add_to(*noisy, physics_);
        }
        const BodyGroup& group = *simulation.groups()[0];
        finest_.clear();
        distance_ = 0.0;
        for (int w = 0; w < windows_; ++w) {
            if (noisy && w > 0) {
                noisy->advance_to(end_of(w));
                put(simulation, poses_of(*noisy), end_of(w));
            }
            Window window{poses_of(simulation), {}, {}};
            std::vector<Pose> before = window.begin;
            const auto go_on_to = [&](double time) {
                simulation.advance_to(time);
                std::vector<Pose> now = poses_of(simulation);
                for (std::size_t i = 0; i < now.size(); ++i) distance_ += distance(before[i], now[i]);
                before = now;
                if (turbulent_) sample_rates(group, time);
                return now;
            };
            for (int step = 1; step < steps_in_window_; ++step) go_on_to(end_of(w) + step * longest_step);
            for (int j = 0; j <= halvings_ - truth_halvings; ++j) {
                window.middle.push_back(go_on_to(end_of(w + 1) - 0.5 * step_of(j)));
            }
            window.end = go_on_to(end_of(w + 1));
            finest_.push_back(std::move(window));
        }
    }

    /// Places the copies that have started by the time (s) at their poses.
    static void put(Simulation& simulation, const std::vector<Pose>& poses, double time) {
        for (std::size_t i = 0; i < simulation.size(); ++i) {
            if (time > simulation.groups()[0]->start(i)) simulation.set_pose(i, poses[i]);
        }
    }

    void sample_rates(const BodyGroup& group, double time) {
        if (!rated_) rated_ = std::make_unique<const ImmersedBody>(made());
        for (std::size_t i = 0; i < group.size(); ++i) {
            if (time < group.start(i)) continue;
            const double size = group.size_of(i);
            const Pose pose = in_own_units(group.pose_in_wind(i, time), size);
            const Vector3d velocity = centroid_velocity(pose, *rated_);
            const TurbulenceLevel level = turbulence_level(*rated_, velocity);
            if (!(level.turbulent_kinetic_energy > 0.0)) continue;
            const double per_size = physics_.turbulence == Turbulence::table ? 1.0 / (size * size)
                                                                             : 1.0;  // else it is the world's
            const double rate =
                per_size * (rated_->constants.langevin == Langevin::wake
                                ? wake_renewal_rate(*rated_, velocity)
                                : turbulence_rate * level.dissipation_rate / level.turbulent_kinetic_energy);
            squared_rates_ += rate * rate;
            ++samples_;
        }
    }
    [[nodiscard]] ImmersedBody made() const {
        return make_immersed_body(*loaded_.body, physics_, scene_.fluid, name_);
    }

    /// Returns the errors of a step; infinite where the motion leaves the range of numbers.
    StepErrors errors_at(int j) {
        try {
            return errors_of_flight(j);
        } catch (const SimulationError&) {
            return {std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
        }
    }

    StepErrors errors_of_flight(int j) {
        Simulation simulation(settings_at(step_of(j)));
        add_to(simulation, quiet_);
        double squares = 0.0;
        double finest_rotation = 0.0;
        double rotation = 0.0;
        const auto compare_at = [&](double time, const std::vector<Pose>& finest) {
            simulation.advance_to(time);
            const std::vector<Pose> now = poses_of(simulation);
            for (std::size_t i = 0; i < now.size(); ++i) {
                const double off = distance(finest[i], now[i]);
                squares += off * off;
                finest_rotation += finest[i].angular_velocity.squaredNorm();
                rotation += now[i].angular_velocity.squaredNorm();
            }
        };
        for (int w = 0; w < windows_; ++w) {
            const Window& finest = finest_[as_place(w)];
            if (w > 0) put(simulation, finest.begin, end_of(w));
            compare_at(end_of(w + 1) - 0.5 * step_of(j), finest.middle[as_place(j)]);
            compare_at(end_of(w + 1), finest.end);
        }
        if (!(distance_ > 0.0)) return {0.0, 0.0};
        const double pieces = static_cast<double>(windows_) * static_cast<double>(simulation.size());
        const double speed = distance_ / pieces / (steps_in_window_ * longest_step);
        const double tip_speed = half_length_ * std::sqrt(0.5 * rotation / pieces);
        const double finest_tip_speed = half_length_ * std::sqrt(0.5 * finest_rotation / pieces);
        return {std::sqrt(0.5 * squares * pieces) / distance_,
                std::abs(tip_speed - finest_tip_speed) / std::max(finest_tip_speed, least_rotation * speed)};
    }

    static std::size_t as_place(int w) { return static_cast<std::size_t>(w); }
    static std::vector<Pose> poses_of(const Simulation& simulation) {
        std::vector<Pose> poses(simulation.size());
        simulation.poses(0, poses.size(), poses.data());
        return poses;
    }
    /// Returns the squared distance of centre of mass and tip between two poses.
    [[nodiscard]] double distance(const Pose& a, const Pose& b) const {
        return std::hypot((a.position - b.position).norm(),
                          half_length_ * a.orientation.angularDistance(b.orientation));
    }

    const Scene& scene_;
    const LoadedBody& loaded_;
    std::string name_;
    BodyPhysics physics_, quiet_;
    Release release_;
    double half_length_ = 0.0;
    bool turbulent_ = false;
    int halvings_ = 0;
    int steps_in_window_ = 1;
    int windows_ = 1;
    std::vector<Window> finest_;
    double distance_ = 0.0;  // of all copies through all windows
    std::unique_ptr<const ImmersedBody> rated_;
    double squared_rates_ = 0.0;
    std::size_t samples_ = 0;
    std::vector<StepErrors> errors_;
    bool is_within_ = true;
};

}  // namespace

StepAdvice advise_step(const Scene& scene, const std::vector<LoadedBody>& loaded, int threads) {
    std::vector<JudgedBody> judged;
    for (std::size_t i = 0; i < loaded.size(); ++i) judged.emplace_back(scene, scene.bodies[i], loaded[i]);
    StepAdvice advice{.step = longest_step, .tolerance = scene.step_tolerance};
    advice.bodies.resize(judged.size());
    std::vector<std::exception_ptr> errors(judged.size());
    parallel_for(judged.size(), 1, threads, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            try {
                advice.bodies[i] = judged[i].judge();
            } catch (...) {
                errors[i] = std::current_exception();
            }
        }
    });
    for (const std::exception_ptr& error : errors) {
        if (error != nullptr) std::rethrow_exception(error);
    }
    for (const BodyStep& body : advice.bodies) {
        const auto limit_to = [&](double step, const char* what) {
            if (step >= advice.step) return;
            advice.step = step;
            advice.limit = fmt::format("the {} of '{}'", what, body.name);
        };
        limit_to(body.motion, "motion");
        limit_to(body.rotation, "rotation");
        limit_to(body.turbulence, "turbulence");
    }
    advice.step = longest_step / std::exp2(std::ceil(std::log2(longest_step / advice.step) - 1e-9));
    for (std::size_t i = 0; i < judged.size(); ++i) {
        advice.bodies[i].error = judged[i].error_of(advice.step);
        advice.error = std::max(advice.error, advice.bodies[i].error);
        advice.is_within = advice.is_within && judged[i].is_within();
    }
    return advice;
}

std::string as_text(const StepAdvice& advice) {
    const std::string missed =
        advice.is_within ? "" : fmt::format(", not within {:.2g} %", 100.0 * advice.tolerance);
    const std::string limit =
        advice.limit.empty() ? "the longest possible" : fmt::format("{} allows no longer step", advice.limit);
    return fmt::format("{:.4g} ms, off by {:.2g} % of the distance covered{}; {}", 1e3 * advice.step,
                       100.0 * advice.error, missed, limit);
}

}  // namespace samara

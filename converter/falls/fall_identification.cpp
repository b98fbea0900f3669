#include "converter/falls/fall_identification.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "converter/falls/fall_record.hpp"
#include "converter/falls/motion_parameters.hpp"
#include "converter/tables/least_squares.hpp"
#include "samara/analysis/metrics/metric_catalogue.hpp"
#include "samara/core/base/error.hpp"
#include "samara/core/dynamics/loads.hpp"

namespace samara {
namespace {

using Eigen::VectorXd;

// These numbers were chosen by the ten reference falls and how the identified bodies reproduce them
// (docs/studies/falls/README.md#how-the-coefficients-are-found).
//
// Times are in units of L/U. The horizon is about one oscillation of a fluttering body: long enough for its
// energy to matter, short enough not to be chaotic.
constexpr double first_segment = 0.5;
constexpr double horizon = 3.0;
constexpr double spacing = 0.5;
constexpr double simulated_step = 0.03;
constexpr int samples = 4;                     // in each segment
constexpr Eigen::Index numbers_of_sample = 9;  // velocity, tip speed, rotation
constexpr double usual_miss = 0.2;             // beyond it a residual counts less
constexpr double expected_miss = 0.1;          // sets the weight of the expectations
// The segments alone are fitted best by a body that oscillates less than it should, since errors of phase
// vanish where oscillations die out. So the metrics of the whole fall count too: each as this many numbers of
// segments, where an error by its fitted_miss counts like `usual_miss` of a number. Values from 15 to 80 give
// the same falls within their tolerances, 160 a disc that falls too fast (docs/studies/falls, "How the
// coefficients are found").
constexpr Eigen::Index metrics_of_fall = fitted_metrics.size();
constexpr double count_of_metric = 40.0;
constexpr double least_count = 1e-3;  // the count at the start
constexpr std::array growing_counts = {1e-2, 0.1, 1.0, 10.0};
constexpr double farthest_metric = 10.0;  // in units of fitted_miss
constexpr int stretches = identification_stretches;
constexpr int least_segments = 2 * stretches;  // in each fall
constexpr int excursion = 12;                  // iterations towards the start of another descent
constexpr double of_descents = 0.8;            // share of the work in `progress`
// The limit of each residual, so that coefficients with which a simulation diverges have a finite cost.
constexpr double largest_residual = 10.0;
// A sample's time may be off by this share of its step, since the simulations have constant steps.
constexpr double uneven_time = 0.01;

// A fall prepared for many simulations.
struct ReadyFall {
    FallRecord record;
    ImmersedBody body;
    std::vector<BodyState> states;
    Vector3d gravity;
    std::size_t stride;  // number of states in a simulated step
    Measures measures;
};

struct Segment {
    std::size_t fall;
    std::size_t begin;  // index of the state
    int stretch;
};

Error too_short(const FallRecord& record) {
    return Error(
        fmt::format("{}: the fall is too short to identify coefficients: it lasts {:.3g} L/U and must last "
                    "{:.3g}; solve a longer one",
                    record.fall.name, record.samples.empty() ? 0.0 : record.samples.back().time,
                    first_segment + horizon + (least_segments - 1) * spacing));
}

void require_even_steps(const FallRecord& record) {
    const double step = record.samples.front().time;
    for (std::size_t i = 0; i < record.samples.size(); ++i) {
        const double time = record.samples[i].time;
        if (std::abs(time - static_cast<double>(i + 1) * step) <= uneven_time * step) continue;
        throw Error(
            fmt::format("{}: the fall's steps are not equal: {:.6g} L/U at first, but different at {:.6g}; "
                        "solve the fall again",
                        record.fall.name, step, time));
    }
}

double step_of(const ReadyFall& fall) {
    return fall.record.samples.front().time * fall.record.fall.time_unit();
}

int steps_to_sample(const ReadyFall& fall) {
    const double step = fall.record.samples.front().time * static_cast<double>(fall.stride);
    return std::max(1, static_cast<int>(std::lround(horizon / samples / step)));
}

std::vector<Segment> segments_of(const std::vector<ReadyFall>& falls) {
    std::vector<Segment> segments;
    for (std::size_t i = 0; i < falls.size(); ++i) {
        const ReadyFall& fall = falls[i];
        const double step = fall.record.samples.front().time;
        const std::size_t length = fall.stride * static_cast<std::size_t>(samples * steps_to_sample(fall));
        const auto every = static_cast<std::size_t>(std::max(1.0, std::round(spacing / step)));
        const std::size_t first = segments.size();
        for (auto begin = static_cast<std::size_t>(std::ceil(first_segment / step));
             begin + length < fall.states.size(); begin += every) {
            segments.push_back({i, begin, 0});
        }
        const std::size_t count = segments.size() - first;
        if (count < least_segments) throw too_short(fall.record);
        for (std::size_t k = 0; k < count; ++k) {
            segments[first + k].stretch = static_cast<int>(k * stretches / count);
        }
    }
    return segments;
}

// Returns the differences of a simulated state from the solved one, in units of the fall's scales: velocity,
// tip speed and rotation (rad).
Eigen::Matrix<double, numbers_of_sample, 1> miss(const ReadyFall& fall, const BodyState& simulated,
                                                 const BodyState& solved) {
    const double speed = fall.record.fall.speed;
    const double tip = fall.body.dynamic.half_length / speed;
    const Matrix3d to_world = simulated.orientation.toRotationMatrix();
    const Matrix3d solved_to_world = solved.orientation.toRotationMatrix();
    const Eigen::AngleAxisd rotation(Matrix3d(solved_to_world.transpose() * to_world));
    Eigen::Matrix<double, numbers_of_sample, 1> result;
    result << (to_world * simulated.velocity.tail<3>() - solved_to_world * solved.velocity.tail<3>()) / speed,
        (to_world * simulated.velocity.head<3>() - solved_to_world * solved.velocity.head<3>()) * tip,
        rotation.angle() * rotation.axis();
    if (!result.allFinite()) result.setConstant(largest_residual);
    return result.cwiseMin(largest_residual).cwiseMax(-largest_residual);
}

void simulate_segment(const ReadyFall& fall, const ImmersedBody& body, std::size_t begin,
                      Eigen::Ref<VectorXd> residuals) {
    const double time_step = step_of(fall) * static_cast<double>(fall.stride);
    const int steps = steps_to_sample(fall);
    BodyState state = fall.states[begin];
    std::size_t at = begin;
    for (int sample = 0; sample < samples; ++sample) {
        for (int step = 0; step < steps; ++step) state = implicit_step(body, fall.gravity, time_step, state);
        at += fall.stride * static_cast<std::size_t>(steps);
        residuals.segment<numbers_of_sample>(numbers_of_sample * sample) = miss(fall, state, fall.states[at]);
    }
}

// Returns the state at the start with the momenta shared between body and fluid. In the fall's first state
// the body has all of them, while the fluid is still at rest (free_fall.hpp).
BodyState start_of(const ReadyFall& fall) {
    BodyState start = fall.states.front();
    Vector6d momenta;
    momenta << fall.body.own_inertia * start.velocity.head<3>(), fall.body.mass * start.velocity.tail<3>();
    start.velocity = fall.body.inverse_inertia * momenta;
    return start;
}

// Returns the motion of every `stride`th state.
Motion motion_of(const Body& body, const ReadyFall& fall, const std::vector<BodyState>& states) {
    return motion_of(body, fall.gravity, step_of(fall) * static_cast<double>(fall.stride), states);
}

Measures measures_of(const Motion& motion) {
    return measure(motion, motion.bodies.front());
}

std::vector<BodyState> solved_states(const ReadyFall& fall) {
    std::vector<BodyState> solved;
    for (std::size_t i = 0; i < fall.states.size(); i += fall.stride) solved.push_back(fall.states[i]);
    return solved;
}

// Sets the wake at each of a fall's states by integrating it along the motion up to there.
void set_wakes(const ImmersedBody& body, double time_step, std::vector<BodyState>& states) {
    for (std::size_t i = 1; i < states.size(); ++i) {
        const Vector6d velocity = body.to_centroid * (0.5 * (states[i - 1].velocity + states[i].velocity));
        const WakeRates rates = wake_rates(body, velocity);
        const Vector3d direction = velocity.tail<3>().stableNormalized();
        const Vector3d& spin = rates.spin_about_symmetry;
        const Eigen::AngleAxisd back(-time_step * spin.norm(), spin.stableNormalized());
        const auto [formed, heading] = states[i - 1].wake;
        states[i].wake.formed = 1.0 + std::exp(-time_step * rates.formation) * (formed - 1.0);
        states[i].wake.heading =
            direction + std::exp(-time_step * rates.settling) * (back * heading - direction);
    }
}

// Prepares a fall. `settling_length`: that of the coefficients to be identified; by default the body's own.
ReadyFall ready(const Body& body, const FallRecord& record, const RecommendedModels& models = {},
                const std::optional<double>& settling_length = {}) {
    if (record.samples.empty()) throw too_short(record);
    require_even_steps(record);
    ReadyFall fall{
        record, falling_body(body, record.fall, models), states_of(record), gravity_of(record.fall), 1, {}};
    const double step = record.samples.front().time;
    fall.stride = static_cast<std::size_t>(std::max(1.0, std::round(simulated_step / step)));
    if (settling_length) fall.body.dynamic.settling_length = *settling_length;
    set_wakes(fall.body, step_of(fall), fall.states);
    fall.measures = measures_of(motion_of(body, fall, solved_states(fall)));
    return fall;
}

Motion simulate_whole(const Body& body, const ReadyFall& fall, const ImmersedBody& immersed) {
    const double time_step = step_of(fall) * static_cast<double>(fall.stride);
    std::vector<BodyState> simulated;
    BodyState state = start_of(fall);
    for (std::size_t i = 0; i < fall.states.size(); i += fall.stride) {
        simulated.push_back(state);
        state = implicit_step(immersed, fall.gravity, time_step, state);
    }
    return motion_of(body, fall, simulated);
}

// Returns the logarithmic difference of two metrics in units of `usual`; the largest value where only one of
// them exists.
double metric_miss(double simulated, double solved, double usual) {
    if (!(simulated > 0.0) && !(solved > 0.0)) return 0.0;
    const double miss = std::log(simulated / solved) / usual;
    if (!std::isfinite(miss)) return farthest_metric;
    return std::clamp(miss, -farthest_metric, farthest_metric);
}

Eigen::Matrix<double, metrics_of_fall, 1> metrics_miss(const Measures& simulated, const Measures& solved) {
    Eigen::Matrix<double, metrics_of_fall, 1> result;
    Eigen::Index i = 0;
    for (const Metric metric : fitted_metrics) {
        const CataloguedMetric& entry = catalogued(metric);
        result[i++] = metric_miss(entry.measured(simulated).value_or(0.0),
                                  entry.measured(solved).value_or(0.0), entry.fitted_miss);
    }
    return result;
}

constexpr Eigen::Index numbers_of_segment = samples * numbers_of_sample;

Eigen::Index count(const std::vector<Segment>& segments) {
    return numbers_of_segment * static_cast<Eigen::Index>(segments.size());
}

Eigen::Index metrics_of(const std::vector<ReadyFall>& falls) {
    return metrics_of_fall * static_cast<Eigen::Index>(falls.size());
}

// Returns the residuals of the segments, followed by those of the metrics of each whole fall.
VectorXd residuals_of(const Body& body, const std::vector<ReadyFall>& falls,
                      const std::vector<Segment>& segments, const DynamicCoefficients& coefficients) {
    std::vector<ImmersedBody> bodies;
    bodies.reserve(falls.size());
    for (const ReadyFall& fall : falls) {
        bodies.push_back(fall.body);
        bodies.back().dynamic = coefficients;
        prepare(bodies.back());
    }
    VectorXd residuals(count(segments) + metrics_of(falls));
    Eigen::Index at = 0;
    for (const Segment& segment : segments) {
        simulate_segment(falls[segment.fall], bodies[segment.fall], segment.begin,
                         residuals.segment(at, numbers_of_segment));
        at += numbers_of_segment;
    }
    for (std::size_t i = 0; i < falls.size(); ++i) {
        const Measures simulated = measures_of(simulate_whole(body, falls[i], bodies[i]));
        residuals.segment<metrics_of_fall>(at) = usual_miss * metrics_miss(simulated, falls[i].measures);
        at += metrics_of_fall;
    }
    return residuals;
}

LeastSquaresProblem problem_of(const Body& body, const std::vector<ReadyFall>& falls,
                               const std::vector<Segment>& segments, const MotionParameters& parameters) {
    LeastSquaresProblem problem;
    problem.residuals = [&body, &falls, &parameters, segments](const VectorXd& numbers) {
        return residuals_of(body, falls, segments, parameters.coefficients(numbers));
    };
    problem.counts = VectorXd::Ones(count(segments) + metrics_of(falls));
    problem.counts.tail(metrics_of(falls)).array() = count_of_metric;
    const auto size = static_cast<Eigen::Index>(parameters.all().size());
    problem.start = parameters.expected();
    problem.expected = problem.start;
    problem.lower.resize(size);
    problem.upper.resize(size);
    problem.deviation.resize(size);
    for (Eigen::Index i = 0; i < size; ++i) {
        const MotionParameter& parameter = parameters.all()[static_cast<std::size_t>(i)];
        problem.lower[i] = parameter.lower;
        problem.upper[i] = parameter.upper;
        problem.deviation[i] = parameter.deviation;
    }
    problem.scale = usual_miss;
    // The samples of a segment are not independent, nor are overlapping segments: about one number in a dozen
    // is.
    problem.prior_weight = 12.0 * expected_miss * expected_miss;
    return problem;
}

std::vector<Segment> without_stretch(std::vector<Segment> segments, int stretch) {
    std::erase_if(segments, [&](const Segment& segment) { return segment.stretch == stretch; });
    return segments;
}

// Returns the solution where the metrics of the whole falls, the last `metrics` residuals, count next to
// nothing.
VectorXd solution_of_segments(LeastSquaresProblem problem, Eigen::Index metrics) {
    problem.counts.tail(metrics).setConstant(least_count);
    return solve_least_squares(problem).x;
}

// Follows the segments' solution while the count of the metrics is raised, nearly to its final value.
VectorXd followed(LeastSquaresProblem problem, Eigen::Index metrics, const VectorXd& of_segments) {
    problem.start = of_segments;
    for (const double count : growing_counts) {
        problem.counts.tail(metrics).setConstant(count);
        problem.start = solve_least_squares(problem).x;
    }
    return problem.start;
}

// The metrics of whole falls are rough functions of the coefficients, the residuals of segments smooth ones:
// the cost has many local minima, and the one in which a single descent ends depends on the last digits of
// the falls. So it is minimised from several starts: the segments' solution, that solution followed while the
// count of the metrics is raised, the solutions after a few iterations without one of the stretches, and the
// expectation.
std::vector<VectorXd> starts_of(const Body& body, const std::vector<ReadyFall>& falls,
                                const std::vector<Segment>& segments, const MotionParameters& parameters) {
    const LeastSquaresProblem whole = problem_of(body, falls, segments, parameters);
    const VectorXd of_segments = solution_of_segments(whole, metrics_of(falls));
    std::vector<VectorXd> starts = {of_segments, parameters.expected(),
                                    followed(whole, metrics_of(falls), of_segments)};
    for (int stretch = 0; stretch < stretches; ++stretch) {
        LeastSquaresProblem without = problem_of(body, falls, without_stretch(segments, stretch), parameters);
        without.start = of_segments;
        without.most_iterations = excursion;
        starts.push_back(solve_least_squares(without).x);
    }
    return starts;
}

// Returns the standard errors by the jackknife over the stretches (Efron & Tibshirani, An Introduction to the
// Bootstrap, 1993, section 11.2), plus those by the uncertainty of the expectation, which the jackknife does
// not see. Without a stretch the local minima by the metrics move too: a descent from the solution alone
// would stay in its own minimum, and give too small an error for falls with noise.
VectorXd standard_errors_of(const Body& body, const std::vector<ReadyFall>& falls,
                            const std::vector<Segment>& segments, const MotionParameters& parameters,
                            const VectorXd& solution, const std::optional<int>& left_out,
                            const std::function<void(double)>& progress) {
    double count = 0.0;
    VectorXd sum = VectorXd::Zero(solution.size());
    VectorXd squares = VectorXd::Zero(solution.size());
    for (int stretch = 0; stretch < stretches; ++stretch) {
        if (stretch == left_out) continue;
        LeastSquaresProblem problem = problem_of(body, falls, without_stretch(segments, stretch), parameters);
        problem.start = solution;
        const Eigen::Index metrics = metrics_of(falls);
        const VectorXd moved = followed(problem, metrics, solution_of_segments(problem, metrics));
        problem.most_iterations = 8;
        const VectorXd x = lowest_solution(problem, {solution, moved}).x;
        count += 1.0;
        sum += x;
        squares += x.cwiseAbs2();
        if (progress) progress(of_descents + (1.0 - of_descents) * (1.0 + stretch) / stretches);
    }
    const VectorXd mean = sum / count;
    const VectorXd variance = (count - 1.0) * (squares / count - mean.cwiseAbs2()).cwiseMax(0.0);
    const VectorXd of_expectation =
        errors_by_expectation(problem_of(body, falls, segments, parameters), solution);
    return (variance + of_expectation.cwiseAbs2()).cwiseSqrt();
}

SimulatedFall simulated_fall(const Body& body, const ReadyFall& fall,
                             const DynamicCoefficients& coefficients) {
    ImmersedBody immersed = fall.body;
    immersed.dynamic = coefficients;
    prepare(immersed);
    return {fall.record.fall.name, fall.measures, measures_of(simulate_whole(body, fall, immersed)),
            balance_of(fall.record)};
}

IdentifiedDensities densities_of(const std::vector<FallRecord>& falls) {
    std::vector<double> densities;
    densities.reserve(falls.size());
    for (const FallRecord& record : falls) densities.push_back(record.fall.mass / record.fall.volume);
    const auto [lowest, highest] = std::ranges::minmax(densities);
    return {lowest, highest};
}

std::string origin_of(const std::vector<FallRecord>& falls, double error) {
    std::string names;
    for (const FallRecord& record : falls) {
        names += fmt::format("{}{} ({:.3g} L/U, Reynolds number {:.3g}, density {:.4g})",
                             names.empty() ? "" : ", ", record.fall.name, record.fall.duration,
                             record.fall.reynolds_number, record.fall.mass / record.fall.volume);
    }
    return fmt::format(
        "dynamic coefficients identified from free falls in OpenFOAM: {}; prediction error {:.2g}", names,
        error);
}

}  // namespace

SimulatedFall simulate_fall(const Body& body, const FallRecord& record, const RecommendedModels& models) {
    const ReadyFall fall = ready(body, record, models);
    return simulated_fall(body, fall, fall.body.dynamic);
}

ModelJudgement judge_models_by(const Body& body, const std::vector<FallRecord>& falls) {
    std::vector<Measures> solved;
    solved.reserve(falls.size());
    for (const FallRecord& record : falls) solved.push_back(ready(body, record).measures);
    return judge_models(body, std::move(solved), [&](const RecommendedModels& models, std::size_t i) {
        return simulate_fall(body, falls[i], models).simulated;
    });
}

FallMotions fall_motions(const Body& body, const FallRecord& record) {
    const ReadyFall fall = ready(body, record);
    const Quaterniond upright = Quaterniond::FromTwoVectors(fall.gravity, -Vector3d::UnitZ());
    const auto shown = [&](Motion motion) {
        motion.gravity = upright * motion.gravity;
        BodyMotion& one = motion.bodies.front();
        one.surface = body.surface;
        for (Pose& pose : one.poses) {
            pose.position = upright * pose.position;
            pose.orientation = upright * pose.orientation;
            pose.velocity = upright * pose.velocity;
            pose.angular_velocity = upright * pose.angular_velocity;
        }
        return motion;
    };
    return {shown(motion_of(body, fall, solved_states(fall))), shown(simulate_whole(body, fall, fall.body))};
}

Identification identify_motion(const Body& body, const std::vector<FallRecord>& records,
                               const LeftOutOfFalls& left_out, const std::function<void(double)>& progress) {
    if (records.empty())
        throw Error(fmt::format(
            "{}: has no falls to identify coefficients from; give folders of solved falls", body.name));
    if (progress) progress(0.0);
    std::vector<ReadyFall> falls;
    falls.reserve(records.size());
    const MotionParameters parameters(body, left_out.terms);
    for (const FallRecord& record : records) {
        falls.push_back(ready(body, record, {}, parameters.settling_length()));
    }
    std::vector<Segment> segments = segments_of(falls);
    if (left_out.stretch) segments = without_stretch(std::move(segments), *left_out.stretch);
    const LeastSquaresSolution solution =
        lowest_solution(problem_of(body, falls, segments, parameters),
                        starts_of(body, falls, segments, parameters), [&](double solved) {
                            if (progress) progress(of_descents * solved);
                        });
    Identification result;
    const VectorXd missed = solution.residuals.head(count(segments));
    result.prediction_error = std::sqrt(missed.squaredNorm() / static_cast<double>(missed.size()));
    result.segments = static_cast<int>(segments.size());
    result.coefficients.values = parameters.coefficients(solution.x);
    result.coefficients.standard_errors = parameters.standard_errors(
        standard_errors_of(body, falls, segments, parameters, solution.x, left_out.stretch, progress));
    result.coefficients.values.origin = origin_of(records, result.prediction_error);
    result.coefficients.densities = densities_of(records);
    for (const ReadyFall& fall : falls) {
        result.falls.push_back(simulated_fall(body, fall, result.coefficients.values));
    }
    return result;
}

}  // namespace samara

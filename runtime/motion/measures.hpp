#pragma once

#include <optional>

#include "samara/motion/motion.hpp"

namespace samara {

/// The regime of a body's fall, judged on one copy in one run (see measure()).
enum class Regime {
    steady,        ///< keeps its inclination
    fluttering,    ///< swings from side to side without turning over
    tumbling,      ///< turns over again and again in one sense
    chaotic,       ///< mixes swings and turnovers, or turns over in changing senses
    autorotating,  ///< rotates about the vertical in one sense without turning over
};

/// Returns the name of a regime, as its enumerator has it.
const char* name_of(Regime regime);

/// A stretch of the motion (s).
struct TimeWindow {
    double begin = 0.0;  ///< s
    double end = 0.0;    ///< s
};

/// Rotation of a body about the vertical.
struct Autorotation {
    double spin_rate = 0.0;              ///< rad/s: mean angular velocity about the vertical, of either sense
    double helix_radius = 0.0;           ///< m: rms horizontal velocity about its mean, over spin_rate
    std::optional<double> coning_angle;  ///< rad: mean elevation of the longest axis' end that is farther
                                         ///< from the centre of mass; nothing where both ends are alike
    double spin_up_height = 0.0;  ///< m: fallen from the release until 0.8 of spin_rate was first reached
};

/// Metrics of one copy in one run over a window of time.
struct Measures {
    TimeWindow window;  ///< the window that the metrics describe
    Vector3d mean_velocity =
        Vector3d::Zero();                ///< m/s, world: displacement of the centre of mass over the duration
    double descent_speed = 0.0;          ///< m/s: mean_velocity along gravity (along -z without it)
    double mean_inclination = 0.0;       ///< rad, mean over the frames
    double inclination_amplitude = 0.0;  ///< rad: 95th percentile of the inclination
    std::optional<double> frequency;     ///< Hz: 1 / (2 x mean time between minima of inclination); nothing
                                         ///< where the window shows fewer than two minima
    int swings = 0;                      ///< minima of the inclination in the window
    int turnovers = 0;               ///< half rotations of the shortest axis, from one end up to the other
    double rms_angular_speed = 0.0;  ///< rad/s
    std::optional<Autorotation> autorotation;  ///< where that is the regime
    Regime regime = Regime::steady;            ///< how it falls
};

/// Returns the first frame at which a body touches the ground, to a thousandth of its bounding radius, or
/// that lies behind a touch between two frames: the velocities at both, kept up, lead through the ground.
/// Nothing where there is neither, or the motion has no ground.
std::optional<int> landing_frame(const Motion& motion, const BodyMotion& body, int run, int copy);

/// Returns the window of a body's fall: from the last frame before it moves to the first at which it rests
/// again or touches the ground, or the last before a touch between two frames. It moves where its speed or
/// angular speed exceeds 1e-6 of their largest values: waiting for its start is no falling. Where it never
/// does, all that is recorded.
TimeWindow fall_of(const Motion& motion, const BodyMotion& body, int run, int copy);

/// Returns the window that is measured where none is given: the last two thirds of fall_of().
TimeWindow default_window(const Motion& motion, const BodyMotion& body, int run, int copy);

/// Measures one copy in one run over the frames in the window (default_window() where none is given); a
/// window between two frames takes the frame nearest to its middle. Throws Error where the window is empty or
/// outside the recording.
///
/// The regime follows from three counts: *turnovers*, where the shortest axis passes from more than 10
/// degrees above the horizontal to more than 10 degrees below or back; *swings*, maxima of the inclination
/// between two minima (inclination.hpp) without a turnover; and *reversals*, turnovers in the sense opposed
/// to the one before, by the axis' angular velocity while it passes. With s = turnovers / (turnovers +
/// swings):
///  - tumbling where s >= 0.9 and at most a tenth of the turnovers are reversals;
///  - otherwise autorotating where nothing turns over and the mean angular velocity about the vertical makes
///  more than half of the mean square angular speed, and two revolutions or more;
///  - otherwise steady where the 5th and 95th percentile of the inclination differ by less than 5 degrees and
///    nothing turns over;
///  - otherwise fluttering where s <= 0.1;
///  - otherwise chaotic.
/// A window too short for a whole swing is judged by the same rule on what it shows. Without gravity the
/// inclination is from the world's vertical, and so are the regime and the descent speed.
/// Frames must be close enough to resolve the rotation: less than a quarter of a revolution from one to the
/// next.
Measures measure(const Motion& motion, const BodyMotion& body, int run = 0, int copy = 0,
                 const std::optional<TimeWindow>& window = std::nullopt);

}  // namespace samara

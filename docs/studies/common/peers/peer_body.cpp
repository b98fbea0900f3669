#include "peers/peer_body.hpp"

#include <algorithm>
#include <cmath>
#include <ctime>

namespace samara {

double cpu_time() {
    std::timespec now{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

PeerFall flown_through(const std::vector<double>& times, double step, const std::function<bool()>& advance,
                       const std::function<Pose()>& pose) {
    PeerFall result;
    Pose before = pose();
    for (const double time : times) {
        const int needed = static_cast<int>(std::ceil(time * (1.0 - 1e-12) / step));
        const double begin = cpu_time();
        for (; result.steps < needed; ++result.steps) {
            if (result.steps + 1 == needed) before = pose();
            if (!advance()) return {{}, result.steps, result.seconds + cpu_time() - begin};
        }
        result.seconds += cpu_time() - begin;
        const double fraction = result.steps == 0 ? 1.0 : time / step - static_cast<double>(result.steps - 1);
        Pose frame = interpolated(before, pose(), std::clamp(fraction, 0.0, 1.0), step);
        if (!result.poses.empty()) keep_sign_continuous(frame.orientation, result.poses.back().orientation);
        result.poses.push_back(frame);
    }
    return result;
}

}  // namespace samara

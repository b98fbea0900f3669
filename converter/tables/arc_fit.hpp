#pragma once

#include <cstddef>
#include <vector>

#include "converter/tables/direction_sampling.hpp"
#include "converter/tables/symmetric_loads.hpp"

namespace samara {

/// DirectionFit of a body of revolution: interpolation over the polar angle from the body's axis.
class ArcFit {
  public:
    ArcFit(const Symmetry& symmetry, const std::vector<Vector3d>& directions);

    [[nodiscard]] LoadEntry at(const std::vector<LoadEntry>& samples, const Vector3d& direction) const;
    [[nodiscard]] LoadEntry without(const std::vector<LoadEntry>& samples, std::size_t sample) const;
    [[nodiscard]] LoadEntryError error_at(const std::vector<LoadEntryError>& errors,
                                          const Vector3d& direction) const;
    [[nodiscard]] double spread(const Vector3d& direction) const;
    [[nodiscard]] double spread_without(std::size_t sample) const;

  private:
    /// A direction by its polar angle (rad), from 0 to the arc's end, and a right-handed frame: the axis
    /// (turned round beyond a mirror), the direction across it, and the normal of both.
    struct Place {
        double angle;
        Matrix3d frame;
    };

    /// Where a sample counts on the line of polar angles, which goes on beyond both ends of the arc as the
    /// symmetry says.
    struct Knot {
        double angle;
        std::size_t sample;
        bool over_pole;  ///< reflected at the pole an odd number of times
        bool over_end;   ///< at the arc's other end
    };

    /// The knots that an angle lies between, `before` and the next, and its place from one (0) to the other
    /// (1).
    struct Interval {
        std::size_t before;
        double fraction;
        double length;  ///< rad
    };

    [[nodiscard]] Place place_of(const Vector3d& direction) const;
    [[nodiscard]] Interval interval_of(double angle) const;
    [[nodiscard]] LoadEntry entry_at(const std::vector<LoadEntry>& samples, double angle) const;
    template <typename Number>
    [[nodiscard]] double number_at(const std::vector<LoadEntry>& in_frames, const Interval& interval,
                                   bool odd_at_pole, bool odd_at_mirror, Number number) const;
    [[nodiscard]] double spread_at(double angle) const;
    [[nodiscard]] ArcFit lacking(std::size_t sample) const;
    void set_knots();

    AxialArc arc_;
    std::vector<Place> places_;          ///< of the samples
    std::vector<std::size_t> included_;  ///< the samples that count
    std::vector<Knot> knots_;            ///< ascending
};

}  // namespace samara

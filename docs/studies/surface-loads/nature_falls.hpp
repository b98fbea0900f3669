#pragma once

#include <memory>
#include <string>
#include <vector>

#include "samara/core/body/surface_loads.hpp"
#include "samara/core/dynamics/dynamic_coefficients.hpp"

namespace samara {

/// The numbers that loads of the surface share.
struct SharedNumbers {
    SurfacePressure pressure;
    SurfaceMotion motion;
    SurfaceWake wake;
};

/// Which bodies of each source are simulated: those that numbers are fitted to, those that choose the form,
/// or all.
enum class Half { fit, choose, all };

/// One measurement, or one fall by full CFD, beside what the numbers make of it.
struct JudgedFall {
    std::string name, simulated, measured;  ///< in words
    double miss = 0.0;   ///< squares of errors over usual ones, or the share of falls of another regime
    bool holds = false;  ///< the regime is right, or both metrics of a fruit are within 15 %
};

/// The falls of one source.
struct JudgedSource {
    std::string name;
    double weight = 0.0;  ///< of its mean miss in the sum
    std::vector<JudgedFall> falls;

    [[nodiscard]] double mean_miss() const;
};

/// Falls that numbers are chosen by, each with its source: level paper drops by size
/// (docs/studies/nature/paper.csv), discs of Field's map, two coins, printed fruits, and the reference falls
/// by full CFD. Each source is divided by body.
class NatureFalls {
  public:
    /// Reads data from the project's folder, and from the folder `bodies` NAME.body.h5 with added mass and
    /// the scenes of fruits (surface_report.py writes both). Bodies that hold tables are simulated by them,
    /// whatever the numbers.
    NatureFalls(const std::string& bodies, Half half);
    ~NatureFalls();
    NatureFalls(const NatureFalls&) = delete;
    NatureFalls& operator=(const NatureFalls&) = delete;

    /// Simulates all falls by the numbers, on all cores.
    [[nodiscard]] std::vector<JudgedSource> judged(const SharedNumbers& numbers) const;

  private:
    struct Data;
    std::unique_ptr<const Data> data_;
};

}  // namespace samara

#include "converter/report/case_parts.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <optional>
#include <set>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "converter/cases/case_mesh.hpp"
#include "converter/cases/case_reduction.hpp"
#include "converter/falls/fall_identification.hpp"
#include "converter/report/flow_part.hpp"
#include "samara/analysis/comparison/comparison.hpp"
#include "samara/core/base/error.hpp"
#include "samara/core/base/numbers.hpp"
#include "samara/core/body/body_file.hpp"
#include "samara/core/files/content_hash.hpp"
#include "samara/core/files/folders.hpp"
#include "samara/formats/json_text.hpp"
#include "samara/motion/motion_file.hpp"
#include "samara/pictures/motion_pictures.hpp"
#include "samara/reports/report_blocks.hpp"

namespace samara {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;
using ProgressCall = std::function<void(double share)>;

constexpr std::size_t most_meshes = 4;     // in one picture
constexpr std::size_t most_pieces = 9000;  // of a drawn mesh
constexpr double around_body = 1.7;        // size of the drawn region relative to the body
constexpr double closer = 0.8;
constexpr double beyond = 1.3;         // pieces that cross the panel reach out of it
constexpr double off_symmetry = 0.01;  // L: meshes have faces in planes of symmetry
constexpr double good_fall = 0.1;      // difference of descent speeds
constexpr double poor_fall = 0.3;
// Relative differences of oscillations that 'samara compare' accepts.
constexpr double same_frequency = 0.2;
constexpr double same_amplitude = 0.3;

double cells_of(const SolvedMesh& mesh) {
    return static_cast<double>(mesh.mesh.cell_count());
}

std::string text_of(const Json& record, const char* key) {
    const auto found = record.find(key);
    return found != record.end() && found->is_string() ? found->get<std::string>() : "unknown";
}

std::string number_of(const Json& record, const char* key) {
    const auto found = record.find(key);
    return found != record.end() && found->is_number() ? fmt::format("{:.3g}", found->get<double>())
                                                       : "unknown";
}

Json record_in(const fs::path& file) {
    if (!fs::is_regular_file(file)) return Json::object();
    Json record = parse_json_or_discard(read_bytes(file));
    return record.is_object() ? record : Json::object();
}

void require_same_body(const fs::path& folder, const Body& body) {
    const Body solved = read_body_file(folder / "body.body.h5");
    if (std::abs(solved.moments.volume - body.moments.volume) <= 1e-9 * body.moments.volume) return;
    throw Error(fmt::format("{}: holds the cases of another body; give --cases with the folder of this one",
                            folder.string()));
}

/// Reads the parts of the report from the folder of cases.
class Folder {
  public:
    Folder(fs::path path, const Body& body, CasesReport& report)
        : path_(std::move(path)), body_(body), plan_(read_case_plan(path_)), report_(report) {}

    void add_meshes(const ProgressCall& progress);
    void add_histories(const ProgressCall& progress);
    void add_falls(const ProgressCall& progress);

  private:
    std::vector<SolvedMesh> meshes(const ProgressCall& progress);
    [[nodiscard]] Json meshes_picture(const std::vector<SolvedMesh>& meshes) const;
    /// Returns a row for each solved case, and gives the meshes their spacings.
    Rows spacing_rows(std::vector<SolvedMesh>& meshes, const ProgressCall& progress);
    [[nodiscard]] Json drawn(const SolvedMesh& mesh, std::size_t count) const;
    /// Calls `work`; an Error is listed in the report as a missing part.
    template <typename Work>
    void or_missing(const Work& work) {
        try {
            work();
        } catch (const Error& error) {
            report_.missing.emplace_back(error.what());
        }
    }
    [[nodiscard]] bool solved(const std::string& name) const {
        return plan_.solved_by_user || is_solved(path_ / name);
    }

    fs::path path_;
    const Body& body_;
    CasePlan plan_;
    CasesReport& report_;
};

std::vector<SolvedMesh> Folder::meshes(const ProgressCall& progress) {
    std::set<std::string> names;
    for (const PlannedCase& one : plan_.cases) names.insert(one.mesh);
    std::vector<SolvedMesh> meshes;
    std::size_t done = 0;
    for (const std::string& name : names) {
        or_missing([&] {
            meshes.push_back({name, record_in(path_ / name / "mesh.json"),
                              read_poly_mesh(path_ / name / "constant/polyMesh")});
        });
        progress(static_cast<double>(++done) / static_cast<double>(names.size()));
    }
    std::ranges::sort(meshes, {}, cells_of);
    return meshes;
}

/// Returns the pieces as rows of x, y of both ends, in units of L.
Json as_json(const std::vector<MeshSection::Piece>& pieces) {
    Json rows = Json::array();
    for (const auto& [from, to] : pieces) rows.push_back({from.x(), from.y(), to.x(), to.y()});
    return rows;
}

Json Folder::drawn(const SolvedMesh& mesh, std::size_t count) const {
    const Matrix3d to_case = plan_.case_axes.transpose();
    const Matrix3d principal = principal_axes(body_.moments);
    const Vector3d right = to_case * principal.col(2);
    const Vector3d up = to_case * principal.col(0);
    double half_width = 0.0;
    for (const Vector3d& vertex : body_.surface.vertices) {
        half_width = std::max(half_width, std::abs((vertex - body_.moments.centroid).dot(principal.col(2))));
    }
    half_width *= around_body / plan_.reference_length / closer;
    const double high_over_wide = count == 1 ? 0.54 : count == 2 ? 1.17 : 0.47;  // of the panels
    MeshSection section;
    do {
        half_width *= closer;
        section = mesh_section(mesh.mesh, right, up, off_symmetry, beyond * half_width,
                               beyond * high_over_wide * half_width);
    } while (section.cells.size() > most_pieces);
    return {{"title", fmt::format("{}: {} cells", mesh.name, mesh.mesh.cell_count())},
            {"cells", as_json(section.cells)},
            {"body", as_json(section.body)},
            {"half_width", half_width},
            {"half_height", high_over_wide * half_width}};
}

Json Folder::meshes_picture(const std::vector<SolvedMesh>& meshes) const {
    const std::size_t count = std::min(meshes.size(), most_meshes);
    Json picture = {{"picture", "meshes"}, {"name", body_.name}};
    for (std::size_t i = meshes.size() - count; i < meshes.size(); ++i) {
        picture["meshes"].push_back(drawn(meshes[i], count));
    }
    return picture;
}

Rows Folder::spacing_rows(std::vector<SolvedMesh>& meshes, const ProgressCall& progress) {
    Rows rows;
    std::optional<WallSpacing> worst;
    std::size_t done = 0;
    for (const PlannedCase& one : plan_.cases) {
        progress(static_cast<double>(++done) / static_cast<double>(plan_.cases.size()));
        const auto mesh = std::ranges::find(meshes, one.mesh, &SolvedMesh::name);
        if (mesh == meshes.end() || !solved(one.name) || plan_.solved_by_user) continue;
        or_missing([&] {
            const WallSpacing spacing = wall_spacing(path_ / one.name, mesh->mesh);
            rows.push_back({one.name, spacing.wall_functions ? "wall functions" : "resolved",
                            fmt::format("{:.2g}", spacing.least), fmt::format("{:.2g}", spacing.median),
                            fmt::format("{:.2g}", spacing.most),
                            spacing.wall_functions ? per_cent(spacing.below_30) + " below 30"
                                                   : per_cent(spacing.above_1) + " above 1"});
            if (one.purpose == CasePurpose::start) return;
            mesh->spacings.push_back(spacing);
            if (one.purpose != CasePurpose::table) return;
            const auto badness = [](const WallSpacing& given) {
                return given.wall_functions ? given.below_30 : given.above_1;
            };
            if (!worst || badness(spacing) > badness(*worst)) worst = spacing;
        });
    }
    if (worst && worst->wall_functions) {
        report_.findings.push_back(
            {worst->below_30 > 0.5 ? Grade::limited : Grade::good, "y+",
             fmt::format("median {:.2g}, below 30 on {} of the body, outside the range of wall functions{}",
                         worst->median, per_cent(worst->below_30),
                         worst->below_30 > 0.5 ? "; --loads kOmegaSSTLM resolves the boundary layer" : "")});
    } else if (worst) {
        report_.findings.push_back({worst->above_1 > 0.5 ? Grade::limited : Grade::good, "y+",
                                    fmt::format("median {:.2g}, above 1 on {} of the body", worst->median,
                                                per_cent(worst->above_1))});
    }
    return rows;
}

void Folder::add_meshes(const ProgressCall& progress) {
    std::vector<SolvedMesh> all = meshes([&](double share) { progress(0.3 * share); });
    if (all.empty()) return;
    Rows rows;
    for (const SolvedMesh& mesh : all) {
        rows.push_back({mesh.name, fmt::format("{}", mesh.mesh.cell_count()), text_of(mesh.record, "verdict"),
                        text_of(mesh.record, "remedy"), number_of(mesh.record, "body_area_over_true_area"),
                        number_of(mesh.record, "max_non_orthogonality")});
    }
    ReportPart part{"Meshes and y+",
                    {picture_block("Sections of the meshes", meshes_picture(all)),
                     table_block({"mesh", "cells", "checkMesh", "remedy", "meshed area over true area",
                                  "largest non-orthogonality (°)"},
                                 rows)}};
    progress(0.5);
    const Rows spacing = spacing_rows(all, [&](double share) { progress(0.5 + 0.5 * share); });
    report_.parts.push_back(part_of_flow(path_, plan_, body_, all));
    if (!spacing.empty()) {
        part.blocks.push_back(folded_block(
            fmt::format("y+ of the cells along the body, in {} cases", spacing.size()),
            table_block({"case", "wall", "least", "median", "most", "fraction of the body"}, spacing)));
    }
    report_.parts.push_back(std::move(part));
}

/// Returns every nth of many values.
Json thinned(const std::vector<double>& values) {
    constexpr std::size_t most_points = 400;
    const std::size_t stride = 1 + values.size() / most_points;
    Json some = Json::array();
    for (std::size_t i = 0; i < values.size(); i += stride) some.push_back(values[i]);
    return some;
}

Json as_json(const CaseHistory& history) {
    return {{"iterations", thinned(history.iterations)},
            {"drag", thinned(history.drag)},
            {"moment", thinned(history.moment)},
            {"k", thinned(history.k)},
            {"residual_iterations", thinned(history.residual_iterations)},
            {"residuals", thinned(history.residuals)}};
}

void Folder::add_histories(const ProgressCall& progress) {
    Json histories = Json::array();
    Rows failed;
    std::size_t done = 0;
    for (const PlannedCase& one : plan_.cases) {
        progress(static_cast<double>(++done) / static_cast<double>(plan_.cases.size() + 1));
        if (!solved(one.name)) {
            or_missing([&] {
                const auto reason = failure_of(path_, one.name, one.mesh);
                failed.push_back({one.name, reason ? *reason : "neither solved nor failed"});
            });
            continue;
        }
        or_missing([&] { histories.push_back(as_json(read_case_history(path_ / one.name, plan_, one))); });
    }
    ReportPart part{"Convergence of the cases", {}};
    if (!histories.empty()) {
        part.blocks.push_back(
            picture_block("Drag, moment, k and residuals of all cases against iterations",
                          {{"picture", "histories"}, {"name", body_.name}, {"cases", histories}}));
    }
    if (!failed.empty()) part.blocks.push_back(table_block({"not solved", "why"}, failed));
    if (!part.blocks.empty()) report_.parts.push_back(std::move(part));
    progress(1.0);
}

std::string metrics_of(const Measures& measures) {
    return fmt::format("{:.3g} m/s, {} Hz, {:.0f}°, {:.3g} rad/s, {}", measures.descent_speed,
                       measures.frequency ? fmt::format("{:.3g}", *measures.frequency) : "-",
                       degrees * measures.inclination_amplitude, measures.rms_angular_speed,
                       name_of(measures.regime));
}

/// The largest differences between the oscillations of the runtime and of the solved falls.
struct OscillationErrors {
    double frequency = 0.0;  // relative
    double amplitude = 0.0;  // relative, beyond one degree
    std::string regimes;     // message of the first fall whose regimes differ

    void add(const SimulatedFall& fall) {
        const Measures& solved = fall.solved;
        const Measures& simulated = fall.simulated;
        if (solved.frequency && simulated.frequency) {
            frequency = std::max(frequency, std::abs(*simulated.frequency / *solved.frequency - 1.0));
        }
        const double more = std::abs(simulated.inclination_amplitude - solved.inclination_amplitude);
        if (more > 1.0 / degrees) amplitude = std::max(amplitude, more / solved.inclination_amplitude);
        if (regimes.empty() && simulated.regime != solved.regime) {
            regimes = fmt::format("; {} is simulated as {}, but solved as {}", fall.name,
                                  name_of(simulated.regime), name_of(solved.regime));
        }
    }

    [[nodiscard]] Finding finding() const {
        const bool alike = frequency <= same_frequency && amplitude <= same_amplitude && regimes.empty();
        return {alike ? Grade::good : Grade::bad, swings_of_falls,
                fmt::format("frequencies of the same falls differ by up to {}, amplitudes by {}{}",
                            per_cent(frequency), per_cent(amplitude), regimes)};
    }
};

/// Returns the picture of a fall that 'samara compare' draws: paths, inclination, spectra and distributions.
Json fall_picture(const Body& body, const FallRecord& record) {
    const TemporaryFolder folder;
    const FallMotions motions = fall_motions(body, record);
    write_motion_file(folder / "simulated", motions.simulated);
    write_motion_file(folder / "solved", motions.solved);
    const MotionReader simulated(folder / "simulated");
    const MotionReader solved(folder / "solved");
    const std::string& name = record.fall.name;
    FallChoice one;
    one.name = name + ", simulated";
    one.file = &simulated;
    FallChoice other;
    other.name = name + ", by full CFD";
    other.file = &solved;
    const Comparison comparison = compare(one, other, {}, [](double, double) {});
    return picture_block(name + ": path, inclination and oscillations, by full CFD and simulated",
                         comparison_picture(comparison, one.name, "solved by full CFD"));
}

void Folder::add_falls(const ProgressCall& progress) {
    Rows rows;
    std::vector<Json> pictures;
    double farthest = 0.0;
    OscillationErrors oscillations;
    FallBalance worst;
    for (std::size_t i = 0; i < plan_.falls.size(); ++i) {
        const PlannedFall& planned = plan_.falls[i];
        progress(static_cast<double>(i) / static_cast<double>(plan_.falls.size()));
        or_missing([&] {
            if (const auto reason = failure_of(path_, planned.name, planned.mesh)) {
                rows.push_back({planned.name, "failed: " + *reason});
                return;
            }
            const FallRecord record = read_fall_record(path_ / planned.name);
            const SimulatedFall fall = simulate_fall(body_, record);
            const double difference =
                std::abs(fall.simulated.descent_speed / fall.solved.descent_speed - 1.0);
            farthest = std::max(farthest, std::isfinite(difference) ? difference : 1.0);
            oscillations.add(fall);
            worst = {std::max(worst.force, fall.balance.force), std::max(worst.moment, fall.balance.moment)};
            rows.push_back(
                {planned.name, metrics_of(fall.solved), metrics_of(fall.simulated), per_cent(difference),
                 fmt::format("{}, {}", per_cent(fall.balance.force), per_cent(fall.balance.moment)),
                 in_plain_digits(record.fall.mass / record.fall.volume * record.fall.fluid_density)});
            pictures.push_back(fall_picture(body_, record));
        });
    }
    progress(1.0);
    if (rows.empty()) return;
    ReportPart part{
        "Falls by full CFD and simulated",
        {text_block(
             "Descent speed, frequency, 95th percentile of the inclination, rms angular speed and regime of "
             "the free falls by full CFD, and of simulations from the same starts with this file."),
         table_block({"fall", "solved", "simulated", "descent speeds differ by",
                      "momentum balance (force, moment)", "density kg/m³"},
                     rows)}};
    part.blocks.insert(part.blocks.end(), pictures.begin(), pictures.end());
    report_.parts.push_back(std::move(part));
    if (farthest > 0.0) {
        report_.findings.push_back(
            {farthest <= good_fall   ? Grade::good
             : farthest <= poor_fall ? Grade::limited
                                     : Grade::bad,
             "falls",
             fmt::format("descent speeds simulated from the starts of the solved falls differ by up to {}",
                         per_cent(farthest))});
        report_.findings.push_back(oscillations.finding());
        report_.findings.push_back(
            {is_unbalanced(worst) ? Grade::limited : Grade::good, "balance",
             fmt::format("the momentum balance of the solved falls is off by {} (force) and {} (moment)",
                         per_cent(worst.force), per_cent(worst.moment))});
    }
}

}  // namespace

CasesReport read_cases_for_report(const fs::path& folder, const Body& body, const ProgressCall& progress) {
    require_same_body(folder, body);
    CasesReport report;
    Folder read(folder, body, report);
    read.add_meshes([&](double share) { progress(0.6 * share); });
    read.add_histories([&](double share) { progress(0.6 + 0.2 * share); });
    read.add_falls([&](double share) { progress(0.8 + 0.2 * share); });
    return report;
}

}  // namespace samara

// Time to reduce one solved case of a million cells: three fields, the cell zone and the histories.

#include <cstdint>
#include <cstring>
#include <fstream>

#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include "converter/cases/case_reduction.hpp"
#include "converter/gzip.hpp"
#include "samara/core/files/folders.hpp"

namespace samara {
namespace {

namespace fs = std::filesystem;

/// A number between 0 and 1 without a pattern that would pack well.
double fraction(std::size_t i) {
    return static_cast<double>(static_cast<std::uint32_t>(i * 2654435761U)) / 4294967296.0;
}

/// A cube of `edge`^3 cells of size 1/edge, solved, a tenth of which is the near wake.
class LargeCase {
  public:
    LargeCase(std::int64_t edge, bool binary, bool packed) : edge_(edge), binary_(binary), packed_(packed) {
        write_field("1/k", [](double s) { return 0.01 + 0.001 * s; });
        write_field("1/epsilon", [](double s) { return 0.02 + 0.003 * s; });
        write_field("1/V", [&](double) { return volume(); });
        write_zone();
        write_histories();
    }

    [[nodiscard]] const fs::path& path() const { return folder_.path(); }

    /// The mesh itself, with which V can be done without.
    void write_mesh() {
        fs::remove(path() / "case" / "1" / (packed_ ? "V.gz" : "V"));
        std::vector<double> points;
        const std::int64_t nodes = edge_ + 1;
        for (std::int64_t i = 0; i < nodes * nodes * nodes; ++i) {
            for (const std::int64_t n : {i % nodes, i / nodes % nodes, i / nodes / nodes}) {
                points.push_back(static_cast<double>(n) / static_cast<double>(edge_));
            }
        }
        write("constant/polyMesh/points", "vectorField", list(points, 3));
        std::vector<std::int32_t> inner;
        std::vector<std::int32_t> outer;
        std::vector<std::int32_t> owner;
        std::vector<std::int32_t> neighbour;
        std::vector<std::int32_t> outer_owner;
        const std::int64_t steps[] = {1, edge_, edge_ * edge_};
        for (std::int64_t cell = 0; cell < edge_ * edge_ * edge_; ++cell) {
            const std::int64_t at[] = {cell % edge_, cell / edge_ % edge_, cell / edge_ / edge_};
            for (std::size_t axis = 0; axis < 3; ++axis) {
                if (at[axis] == 0) {
                    append_face(outer, at, axis, 0);
                    outer_owner.push_back(static_cast<std::int32_t>(cell));
                }
                const bool last = at[axis] + 1 == edge_;
                append_face(last ? outer : inner, at, axis, 1);
                (last ? outer_owner : owner).push_back(static_cast<std::int32_t>(cell));
                if (!last) neighbour.push_back(static_cast<std::int32_t>(cell + steps[axis]));
            }
        }
        inner.insert(inner.end(), outer.begin(), outer.end());
        owner.insert(owner.end(), outer_owner.begin(), outer_owner.end());
        std::vector<std::int32_t> starts;
        for (std::size_t i = 0; i <= owner.size(); ++i) starts.push_back(static_cast<std::int32_t>(4 * i));
        write("constant/polyMesh/faces", "faceCompactList", list(starts) + list(inner));
        write("constant/polyMesh/owner", "labelList", list(owner));
        write("constant/polyMesh/neighbour", "labelList", list(neighbour));
    }

  private:
    [[nodiscard]] double volume() const {
        const auto edge = static_cast<double>(edge_);
        return 1.0 / (edge * edge * edge);
    }
    [[nodiscard]] std::size_t cells() const { return static_cast<std::size_t>(edge_ * edge_ * edge_); }

    /// The face of a cell across an axis, before (side 0) or behind it (1), its normal out of the cell.
    void append_face(std::vector<std::int32_t>& faces, const std::int64_t* at, std::size_t axis,
                     std::int64_t side) const {
        const std::int64_t nodes = edge_ + 1;
        const std::int64_t steps[] = {1, nodes, nodes * nodes};
        const std::int64_t u = steps[(axis + 1) % 3];
        const std::int64_t v = steps[(axis + 2) % 3];
        const std::int64_t corner = at[0] + nodes * (at[1] + nodes * at[2]) + side * steps[axis];
        const std::int64_t first = side == 1 ? u : v;
        const std::int64_t second = side == 1 ? v : u;
        for (const std::int64_t point : {corner, corner + first, corner + u + v, corner + second}) {
            faces.push_back(static_cast<std::int32_t>(point));
        }
    }

    /// "N (...)" as the format has it; `components` numbers make one value.
    template <typename Number>
    [[nodiscard]] std::string list(const std::vector<Number>& numbers, std::size_t components = 1) const {
        std::string text = fmt::format("\n{}\n(", numbers.size() / components);
        if (binary_) {
            const std::size_t start = text.size();
            text.resize(start + numbers.size() * sizeof(Number));
            std::memcpy(text.data() + start, numbers.data(), numbers.size() * sizeof(Number));
        } else {
            for (const Number number : numbers) text += fmt::format("\n{:.8g}", static_cast<double>(number));
        }
        return text + ")\n";
    }

    template <typename Law>
    void write_field(const std::string& name, const Law& law) {
        std::vector<double> values;
        for (std::size_t i = 0; i < cells(); ++i) {
            values.push_back(law(fraction(i)));
        }
        write(name, "volScalarField", "internalField nonuniform List<scalar> " + list(values) + ";\n");
    }

    void write_zone() {
        std::vector<std::int32_t> zone;
        for (std::size_t i = 0; i < cells(); i += 10) zone.push_back(static_cast<std::int32_t>(i));
        write("constant/polyMesh/cellZones", "regIOobject",
              "1\n(\nnearWake\n{\ntype cellZone;\ncellLabels List<label> " + list(zone) + ";\n}\n)\n");
        zone_ = zone;
    }

    void write_histories() {
        double sum = 0.0;
        double k = 0.0;
        double epsilon = 0.0;
        for (const std::int32_t cell : zone_) {
            const double s = fraction(static_cast<std::size_t>(cell));
            const double weight = 0.01 + 0.001 * s;
            sum += weight;
            k += weight * weight;
            epsilon += weight * (0.02 + 0.003 * s);
        }
        std::string loads = "# Time total_x total_y total_z\n";
        std::string means = "# Time weightedVolAverage(k) weightedVolAverage(epsilon)\n";
        for (int i = 1; i <= 1000; ++i) {
            loads += fmt::format("{}\t-1\t0\t0\n", 0.001 * i);
            means += fmt::format("{}\t{}\t{}\n", 0.001 * i, k / sum, epsilon / sum);
        }
        write_plainly("postProcessing/forces/0/force.dat", loads);
        write_plainly("postProcessing/forces/0/moment.dat", loads);
        write_plainly("postProcessing/nearWake/0/volFieldValue.dat", means);
    }

    void write(const std::string& name, const char* kind, const std::string& body) const {
        const std::string text = fmt::format(
            "FoamFile {{ version 2.0; format {}; arch \"LSB;label=32;scalar=64\"; class {}; object any; "
            "}}\n{}",
            binary_ ? "binary" : "ascii", kind, body);
        write_plainly(packed_ ? name + ".gz" : name, packed_ ? test::gzipped(text) : text);
    }

    void write_plainly(const std::string& name, const std::string& text) const {
        const fs::path file = folder_.path() / "case" / name;
        fs::create_directories(file.parent_path());
        std::ofstream(file, std::ios::binary) << text;
    }

    TemporaryFolder folder_;
    std::int64_t edge_;
    bool binary_;
    bool packed_;
    std::vector<std::int32_t> zone_;
};

void reduce(benchmark::State& state, const LargeCase& large) {
    CasePlan plan;
    plan.axes = plan.case_axes = Matrix3d::Identity();
    plan.solved_by_user = true;
    double drag = 0.0;
    while (state.KeepRunning()) {
        MeshZones zones;
        drag =
            -reduce_case(large.path(), plan, {"case", Vector3d::UnitX(), 1e4}, zones).sample.entry.force.x();
        benchmark::DoNotOptimize(drag);
    }
    state.counters["cells"] = 1e6;
}

void reduction_of_a_case(benchmark::State& state, bool binary, bool packed) {
    reduce(state, LargeCase(100, binary, packed));
}

void reduction_of_a_case_without_volumes(benchmark::State& state, bool binary) {
    LargeCase large(100, binary, false);
    large.write_mesh();
    reduce(state, large);
}

BENCHMARK_CAPTURE(reduction_of_a_case, ascii, false, false)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK_CAPTURE(reduction_of_a_case, ascii_gz, false, true)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK_CAPTURE(reduction_of_a_case, binary, true, false)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK_CAPTURE(reduction_of_a_case, binary_gz, true, true)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK_CAPTURE(reduction_of_a_case_without_volumes, binary, true)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

}  // namespace
}  // namespace samara

// k and epsilon of one bake in the tables of another.
#include "converter/tables/replaced_turbulence.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "samara/core/surface/octahedral_map.hpp"
#include "samara/formats/json_text.hpp"

namespace samara {
namespace {

/// Tables whose force is `force` and whose k is `k` times 1 + d_x^2, at two Reynolds numbers.
LoadTables tables_of(int subdivisions, double force, double k, const char* provenance) {
    LoadTables tables;
    tables.reference_length = 0.04;
    tables.subdivisions = subdivisions;
    tables.reynolds_numbers = {1e3, 1e4};
    tables.provenance = provenance;
    for (std::size_t i = 0; i < tables.reynolds_numbers.size(); ++i) {
        for (const Vector3d& d : octahedral_nodes(subdivisions)) {
            const double here = k * (1.0 + d.x() * d.x());
            tables.entries.push_back({force * d, Vector3d::Zero(), here, 0.5 * here});
            tables.errors.push_back(
                {Vector3d::Constant(0.1 * force), Vector3d::Zero(), 0.2 * here, 0.1 * here});
        }
    }
    tables.error_sources = {{ErrorSource::mesh, force, force, k, k}};
    return tables;
}

TEST(ReplacedTurbulence, LeavesLoadsAndTheirErrorsAlone) {
    LoadTables before = tables_of(4, -1.0, 0.01, R"([{"name": "a", "purpose": "table", "turbulence": {}}])");
    before.turbulence_mean = TurbulenceMean::shell;
    const LoadTables turbulence = tables_of(4, -7.0, 0.03, R"([{"name": "b", "purpose": "table"}])");
    const LoadTables after = with_replaced_turbulence(before, turbulence);
    EXPECT_EQ(after.turbulence_mean, TurbulenceMean::near_wake);
    for (std::size_t i = 0; i < after.entries.size(); ++i) {
        EXPECT_EQ(after.entries[i].force, before.entries[i].force);
        EXPECT_EQ(after.errors[i].force, before.errors[i].force);
        EXPECT_NEAR(after.entries[i].turbulent_kinetic_energy, turbulence.entries[i].turbulent_kinetic_energy,
                    1e-15);
        EXPECT_NEAR(after.errors[i].dissipation_rate, turbulence.errors[i].dissipation_rate, 1e-15);
    }
    ASSERT_EQ(after.error_sources.size(), 1U);
    EXPECT_EQ(after.error_sources[0].force, -1.0);
    EXPECT_EQ(after.error_sources[0].turbulent_kinetic_energy, 0.03);
}

TEST(ReplacedTurbulence, IsLookedUpWhereTheMapsDiffer) {
    const LoadTables after =
        with_replaced_turbulence(tables_of(2, -1.0, 0.01, "[]"), tables_of(8, -1.0, 0.03, "[]"));
    const LoadTables exact = tables_of(2, -1.0, 0.03, "[]");
    for (std::size_t i = 0; i < after.entries.size(); ++i) {
        EXPECT_NEAR(after.entries[i].turbulent_kinetic_energy, exact.entries[i].turbulent_kinetic_energy,
                    1e-15);
    }
}

TEST(ReplacedTurbulence, KeepsTheRecordsOfBothOnceEach) {
    const char* const loads = R"([{"name": "a", "purpose": "table", "turbulence": {"k": 1}}])";
    const LoadTables turbulence = tables_of(1, -1.0, 0.03, R"([{"name": "b", "purpose": "mesh"}])");
    LoadTables after = with_replaced_turbulence(tables_of(1, -1.0, 0.01, loads), turbulence);
    after = with_replaced_turbulence(after, turbulence);
    EXPECT_EQ(parse_json(after.provenance),
              parse_json(R"([{"name": "a", "purpose": "table"}, {"name": "b", "purpose": "turbulence"}])"));
}

}  // namespace
}  // namespace samara

#include "samara/core/body/body_check.hpp"

#include <cmath>
#include <functional>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "paths.hpp"
#include "samara/core/body/body_file.hpp"
#include "support/expect_error.hpp"
#include "support/known_bodies.hpp"
#include "support/program_run.hpp"
#include "support/test_shapes.hpp"

namespace samara {
namespace {

using testing::HasSubstr;

/// What body_check says of the full body after the change.
std::string error_after(const std::function<void(Body&)>& change) {
    Body body = test::full_body();
    change(body);
    return error_of(body);
}

TEST(BodyCheck, SoundBodiesPass) {
    EXPECT_EQ(error_of(test::full_body()), "");
    EXPECT_EQ(error_of(test::rubber_ellipsoid()), "");
    EXPECT_EQ(error_of(test::exact_sphere(0.01)), "");  // rotates without moving any fluid
    EXPECT_EQ(error_of(test::lopsided_shape()), "");
    for (const double size : {1e-6, 1e6}) {
        Body body = test::full_body();
        body.kirchhoff.reset();
        body.tables.reset();
        body.dynamic.reset();
        body.surface = test::ellipsoid(size * Vector3d(0.1, 0.2, 0.4), 3, size * Vector3d(5.0, 0.0, 0.0));
        body.moments = test::moments_of(body.surface);
        EXPECT_EQ(error_of(body), "") << size;
    }
}

TEST(BodyCheck, TheReadyBakedBodiesPass) {
    int bodies = 0;
    for (const auto& entry :
         std::filesystem::directory_iterator(std::string(SAMARA_SOURCE_DIRECTORY) + "/runtime/bodies")) {
        if (!is_body_file_name(entry.path())) continue;
        EXPECT_NO_THROW((void)read_body_file(entry.path())) << entry.path();
        ++bodies;
    }
    EXPECT_EQ(bodies, 10);
}

TEST(BodyCheck, AddedMassThatNoBodyHasIsRefused) {
    const auto error = [](const std::function<void(KirchhoffTensor&)>& change) {
        return error_after([&](Body& body) { change(*body.kirchhoff); });
    };
    EXPECT_THAT(error([](KirchhoffTensor& k) { k.matrix(3, 4) *= 1.001; }), HasSubstr("is not symmetric"));
    EXPECT_THAT(error([](KirchhoffTensor& k) { k.matrix(4, 4) = -k.matrix(4, 4); }),
                HasSubstr("/kirchhoff/added_mass is not positive semidefinite"));
    EXPECT_THAT(error([](KirchhoffTensor& k) { k.matrix(0, 4) = k.matrix(4, 0) = 1e-2; }),
                HasSubstr("is not positive semidefinite"));
    EXPECT_THAT(error([](KirchhoffTensor& k) { k.matrix.setZero(); }),
                HasSubstr("is not positive for every velocity"));
    EXPECT_THAT(error([](KirchhoffTensor& k) { k.matrix *= 1e4; }), HasSubstr("too large for the body"));
    EXPECT_THAT(error([](KirchhoffTensor& k) { k.matrix *= 1e300; }), HasSubstr("/kirchhoff/added_mass"));
    EXPECT_THAT(error([](KirchhoffTensor& k) { k.error_estimate = std::nan(""); }),
                HasSubstr("error_estimate"));
    EXPECT_THAT(error([](KirchhoffTensor& k) { k.asymmetry = -1.0; }), HasSubstr("asymmetry"));
    EXPECT_THAT(error([](KirchhoffTensor& k) { k.triangles = -1; }), HasSubstr("negative number"));
}

TEST(BodyCheck, MomentsThatTheSurfaceDoesNotHaveAreRefused) {
    const auto error = [](const std::function<void(VolumeMoments&)>& change) {
        return error_after([&](Body& body) { change(body.moments); });
    };
    const double infinity = std::numeric_limits<double>::infinity();
    EXPECT_THAT(error([](VolumeMoments& m) { m.volume = 0.0; }), HasSubstr("volume is not positive"));
    EXPECT_THAT(error([&](VolumeMoments& m) { m.volume = infinity; }), HasSubstr("volume is not positive"));
    EXPECT_THAT(error([](VolumeMoments& m) { m.volume *= 2.0; }), HasSubstr("does not match the surface"));
    EXPECT_THAT(error([](VolumeMoments& m) { m.surface_area = std::nan(""); }), HasSubstr("surface area"));
    EXPECT_THAT(error([](VolumeMoments& m) { m.surface_area *= 0.1; }), HasSubstr("surface area"));
    EXPECT_THAT(error([](VolumeMoments& m) { m.centroid.x() = 1.0; }), HasSubstr("/moments/centroid"));
    EXPECT_THAT(error([](VolumeMoments& m) { m.centroid.x() = 1e250; }), HasSubstr("which is too large"));
    EXPECT_THAT(error([](VolumeMoments& m) { m.second_moments *= 1e250; }), HasSubstr("second_moments"));
    EXPECT_THAT(error([](VolumeMoments& m) { m.second_moments *= 1e-3; }), HasSubstr("second_moments"));
    EXPECT_THAT(error([](VolumeMoments& m) { m.second_moments(0, 0) *= -1.0; }), HasSubstr("second_moments"));
    EXPECT_THAT(error([](VolumeMoments& m) { m.second_moments(0, 1) += 1e-4; }), HasSubstr("not symmetric"));
}

TEST(BodyCheck, SurfacesThatEncloseNothingAreRefused) {
    EXPECT_THAT(error_after([](Body& b) { b.surface = {}; }), HasSubstr("no triangle"));
    EXPECT_THAT(error_after([](Body& b) { b.surface.vertices[0] *= 1e200; }),
                HasSubstr("which is too large"));
    const auto inside_out = [](Body& b) {
        for (auto& triangle : b.surface.corners) std::swap(triangle[0], triangle[1]);
        b.surface.edge_nodes.clear();
    };
    EXPECT_THAT(error_after(inside_out), HasSubstr("does not match the surface"));
}

TEST(BodyCheck, AxesThatAreNoneAreRefused) {
    EXPECT_THAT(error_after([](Body& b) { b.symmetry.axes.setZero(); }), HasSubstr("/symmetry/axes"));
    EXPECT_THAT(error_after([](Body& b) { b.symmetry.axis.setZero(); }), HasSubstr("/symmetry/axis"));
    EXPECT_THAT(error_after([](Body& b) { b.symmetry.elements.clear(); }), HasSubstr("identity"));
    EXPECT_THAT(error_after([](Body& b) { b.symmetry.elements[1](0, 0) = 3.0; }), HasSubstr("orthogonal"));
    EXPECT_THAT(error_after([](Body& b) { b.symmetry.tolerance = std::nan(""); }), HasSubstr("tolerance"));
    EXPECT_THAT(error_after([](Body& b) { b.tables->axes.col(2).setZero(); }), HasSubstr("/tables/axes"));
}

TEST(BodyCheck, TablesThatNoFlowGivesAreRefused) {
    const auto error = [](const std::function<void(LoadTables&)>& change) {
        return error_after([&](Body& body) { change(*body.tables); });
    };
    EXPECT_THAT(error([](LoadTables& t) { t.entries[3].turbulent_kinetic_energy = -1e-9; }),
                HasSubstr("/tables/turbulent_kinetic_energy is negative"));
    EXPECT_THAT(error([](LoadTables& t) { t.entries[3].dissipation_rate = -1e-9; }),
                HasSubstr("/tables/dissipation_rate is negative"));
    EXPECT_THAT(error([](LoadTables& t) { t.entries[3].dissipation_rate = 1e20; }),
                HasSubstr("coefficient of 1e+20"));
    EXPECT_THAT(error([](LoadTables& t) { t.entries[5].force.y() = -1e6; }), HasSubstr("coefficient of"));
    EXPECT_THAT(error([](LoadTables& t) { t.errors[5].moment.z() = -0.1; }), HasSubstr("standard error"));
    EXPECT_THAT(error([](LoadTables& t) { t.reference_length = 50.0; }), HasSubstr("reference_length"));
    EXPECT_THAT(error([](LoadTables& t) { t.error_sources[0].moment = -0.1; }), HasSubstr("error_sources"));
}

TEST(BodyCheck, CoefficientsOfAnotherBodysSizeAreRefused) {
    for (const TensorOfMotion& tensor : tensors_of_motion) {
        EXPECT_THAT(error_after([&](Body& b) { (b.dynamic->values.*tensor.member) *= 1e9; }),
                    HasSubstr(std::string(tensor.name) + " is too large"));
    }
    EXPECT_THAT(error_after([](Body& b) { b.dynamic->values.unsteady_factor = 1e9; }),
                HasSubstr("unsteady_factor"));
    EXPECT_THAT(error_after([](Body& b) { b.dynamic->values.half_length = 1e9; }), HasSubstr("half_length"));
}

TEST(BodyCheck, ABodyThatWouldRiseIsRefusedByEveryReader) {
    const test::TemporaryFolder folder;
    Body body = test::full_body();
    body.kirchhoff->matrix(5, 5) *= -5.0;
    write_body_file(folder / "a.body.h5", body);
    const std::string wanted = "a.body.h5: /kirchhoff/added_mass is not positive semidefinite";
    EXPECT_THAT(test::error_of([&] { (void)read_body_file(folder / "a.body.h5"); }), HasSubstr(wanted));
    const test::ProgramRun info = run_program_in(folder, {"samara", "info", "a.body.h5"});
    EXPECT_EQ(info.status, 1);
    EXPECT_TRUE(test::is_one_line(info.error));
    EXPECT_THAT(info.error, HasSubstr(wanted));
}

}  // namespace
}  // namespace samara

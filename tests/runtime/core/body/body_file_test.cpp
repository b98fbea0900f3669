#include "samara/core/body/body_file.hpp"

#include <cmath>
#include <cstdlib>
#include <limits>
#include <random>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "samara/core/files/content_hash.hpp"
#include "samara/core/files/hdf5_reader.hpp"
#include "samara/core/files/hdf5_writer.hpp"
#include "samara/core/files/replace_file.hpp"
#include "support/expect_error.hpp"
#include "support/temporary_folder.hpp"
#include "support/test_shapes.hpp"

namespace samara {
namespace {

using test::error_of;
using testing::AllOf;
using testing::HasSubstr;

void expect_equal(const LoadEntry& a, const LoadEntry& b) {
    EXPECT_EQ(a.force, b.force);
    EXPECT_EQ(a.moment, b.moment);
    EXPECT_EQ(a.turbulent_kinetic_energy, b.turbulent_kinetic_energy);
    EXPECT_EQ(a.dissipation_rate, b.dissipation_rate);
}

void expect_equal(const ErrorShare& a, const ErrorShare& b) {
    EXPECT_EQ(a.source, b.source);
    EXPECT_EQ(a.force, b.force);
    EXPECT_EQ(a.moment, b.moment);
    EXPECT_EQ(a.turbulent_kinetic_energy, b.turbulent_kinetic_energy);
    EXPECT_EQ(a.dissipation_rate, b.dissipation_rate);
}

void expect_equal(const DynamicCoefficients& a, const DynamicCoefficients& b) {
    for (const NumberOfMotion& number : numbers_of_motion) {
        EXPECT_EQ(a.*number.member, b.*number.member) << number.name;
    }
    for (const TensorOfMotion& tensor : tensors_of_motion) {
        EXPECT_EQ(a.*tensor.member, b.*tensor.member) << tensor.name;
    }
    EXPECT_EQ(a.half_length, b.half_length);
    EXPECT_EQ(a.origin, b.origin);
}

void expect_equal(const Body& a, const Body& b) {
    EXPECT_EQ(a.name, b.name);
    EXPECT_EQ(a.source, b.source);
    EXPECT_EQ(a.surface.vertices, b.surface.vertices);
    EXPECT_EQ(a.surface.corners, b.surface.corners);
    EXPECT_EQ(a.surface.edge_nodes, b.surface.edge_nodes);
    EXPECT_EQ(a.moments.volume, b.moments.volume);
    EXPECT_EQ(a.moments.centroid, b.moments.centroid);
    EXPECT_EQ(a.moments.second_moments, b.moments.second_moments);
    EXPECT_EQ(a.moments.surface_area, b.moments.surface_area);
    EXPECT_EQ(a.symmetry.type, b.symmetry.type);
    EXPECT_EQ(a.symmetry.axis, b.symmetry.axis);
    EXPECT_EQ(a.symmetry.elements, b.symmetry.elements);
    EXPECT_EQ(a.symmetry.axes, b.symmetry.axes);
    EXPECT_EQ(a.symmetry.tolerance, b.symmetry.tolerance);
    ASSERT_EQ(a.kirchhoff.has_value(), b.kirchhoff.has_value());
    if (a.kirchhoff) {
        EXPECT_EQ(a.kirchhoff->matrix, b.kirchhoff->matrix);
        EXPECT_EQ(a.kirchhoff->error_estimate, b.kirchhoff->error_estimate);
        EXPECT_EQ(a.kirchhoff->asymmetry, b.kirchhoff->asymmetry);
        EXPECT_EQ(a.kirchhoff->triangles, b.kirchhoff->triangles);
        EXPECT_EQ(a.kirchhoff->method, b.kirchhoff->method);
    }
    ASSERT_EQ(a.dynamic.has_value(), b.dynamic.has_value());
    if (a.dynamic) {
        expect_equal(a.dynamic->values, b.dynamic->values);
        expect_equal(a.dynamic->standard_errors, b.dynamic->standard_errors);
        EXPECT_EQ(a.dynamic->densities.lowest, b.dynamic->densities.lowest);
        EXPECT_EQ(a.dynamic->densities.highest, b.dynamic->densities.highest);
    }
    EXPECT_EQ(a.mass, b.mass);
    EXPECT_EQ(a.recommended, b.recommended);
    ASSERT_EQ(a.surface_loads.has_value(), b.surface_loads.has_value());
    if (a.surface_loads) {
        EXPECT_EQ(a.surface_loads->surface.vertices, b.surface_loads->surface.vertices);
        EXPECT_EQ(a.surface_loads->surface.corners, b.surface_loads->surface.corners);
        EXPECT_EQ(a.surface_loads->potentials, b.surface_loads->potentials);
    }
    ASSERT_EQ(a.tables.has_value(), b.tables.has_value());
    if (!a.tables) return;
    EXPECT_EQ(a.tables->reference_length, b.tables->reference_length);
    EXPECT_EQ(a.tables->subdivisions, b.tables->subdivisions);
    EXPECT_EQ(a.tables->axes, b.tables->axes);
    EXPECT_EQ(a.tables->reynolds_numbers, b.tables->reynolds_numbers);
    EXPECT_EQ(a.tables->quality, b.tables->quality);
    EXPECT_EQ(a.tables->provenance, b.tables->provenance);
    ASSERT_EQ(a.tables->error_sources.size(), b.tables->error_sources.size());
    for (std::size_t i = 0; i < a.tables->error_sources.size(); ++i) {
        expect_equal(a.tables->error_sources[i], b.tables->error_sources[i]);
    }
    EXPECT_EQ(a.tables->left_out, b.tables->left_out);
    ASSERT_EQ(a.tables->entries.size(), b.tables->entries.size());
    ASSERT_EQ(a.tables->errors.size(), b.tables->errors.size());
    for (std::size_t i = 0; i < a.tables->entries.size(); ++i) {
        expect_equal(a.tables->entries[i], b.tables->entries[i]);
        expect_equal(a.tables->errors[i], b.tables->errors[i]);
    }
}

std::string error_of_file(const std::filesystem::path& file) {
    return error_of([&] { (void)read_body_file(file); });
}

TEST(BodyFile, KeepsHowFarTheSurfaceIsFromItsShape) {
    const test::TemporaryFolder folder;
    Body body = test::full_body();
    write_body_file(folder / "a.body.h5", body);
    EXPECT_FALSE(read_body_file(folder / "a.body.h5").shape_error.has_value());
    body.shape_error = ShapeError{0.001, 0.0002, -0.003, 0.004, 0.005};
    write_body_file(folder / "b.body.h5", body);
    const ShapeError found = *read_body_file(folder / "b.body.h5").shape_error;
    EXPECT_EQ(found.distance, 0.001);
    EXPECT_EQ(found.mean_distance, 0.0002);
    EXPECT_EQ(found.volume, -0.003);
    EXPECT_EQ(found.area, 0.004);
    EXPECT_EQ(found.faceting, 0.005);
    body.shape_error->distance = -1.0;
    write_body_file(folder / "c.body.h5", body);
    EXPECT_THAT(error_of([&] { read_body_file(folder / "c.body.h5"); }),
                HasSubstr("distance from its shape"));
}

TEST(BodyFile, GivesBackTheBodyToTheLastBit) {
    const test::TemporaryFolder folder;
    const Body body = test::full_body();
    write_body_file(folder / "a.body.h5", body);
    expect_equal(read_body_file(folder / "a.body.h5"), body);
}

TEST(BodyFile, GivesBackABodyWithoutTensorTablesAndCoefficients) {
    const test::TemporaryFolder folder;
    Body body = test::full_body();
    body.kirchhoff.reset();
    body.surface_loads.reset();
    body.tables.reset();
    body.dynamic.reset();
    body.surface.edge_nodes.clear();
    body.symmetry.type = Symmetry::Type::spherical;
    write_body_file(folder / "a.body.h5", body);
    expect_equal(read_body_file(folder / "a.body.h5"), body);
}

TEST(BodyFile, GivesBackWhatTheBodyWeighs) {
    const test::TemporaryFolder folder;
    Body body = test::full_body();
    MassSpecification uniform;
    uniform.density = 700.0;
    MassSpecification of_parts;
    of_parts.mass = 0.25;
    of_parts.center_of_mass = body.moments.centroid + Vector3d(1e-3, -2e-3, 3e-3);
    of_parts.inertia = Vector3d(3.0, 4.0, 5.0).asDiagonal();
    for (const MassSpecification& mass : {uniform, of_parts}) {
        body.mass = mass;
        write_body_file(folder / "a.body.h5", body);
        expect_equal(read_body_file(folder / "a.body.h5"), body);
    }
}

TEST(BodyFile, RefusesAMassThatContradictsTheShapeOrItself) {
    const test::TemporaryFolder folder;
    using Spoil = void (*)(MassSpecification&);
    const std::vector<std::pair<const char*, Spoil>> cases = {
        {"density",
         [](MassSpecification& m) {
             m = {.density = -1.0, .mass = {}, .center_of_mass = {}, .inertia = {}};
         }},
        {"/mass must hold", [](MassSpecification& m) { m.density = 1.0; }},
        {"/mass must hold", [](MassSpecification& m) { m.mass.reset(); }},
        {"within the box", [](MassSpecification& m) { m.center_of_mass = Vector3d(0.0, 0.0, 1e3); }},
        {"symmetric", [](MassSpecification& m) { (*m.inertia)(0, 1) = 1.0; }},
        {"sum of the others", [](MassSpecification& m) { (*m.inertia)(2, 2) = 8.0; }},
    };
    for (const auto& [words, spoil] : cases) {
        Body body = test::full_body();
        body.mass = MassSpecification{.density = {},
                                      .mass = 0.25,
                                      .center_of_mass = body.moments.centroid,
                                      .inertia = Matrix3d(Vector3d(3.0, 4.0, 5.0).asDiagonal())};
        spoil(*body.mass);
        write_body_file(folder / "a.body.h5", body);
        EXPECT_THAT(error_of_file(folder / "a.body.h5"), AllOf(HasSubstr("a.body.h5"), HasSubstr(words)));
    }
}

TEST(BodyFile, RewritingGivesEqualBytes) {
    const test::TemporaryFolder folder;
    write_body_file(folder / "a.body.h5", test::full_body());
    const std::string bytes = read_bytes(folder / "a.body.h5");
    write_body_file(folder / "b.body.h5", read_body_file(folder / "a.body.h5"));
    write_body_file(folder / "a.body.h5", test::full_body());
    EXPECT_EQ(read_bytes(folder / "b.body.h5"), bytes);
    EXPECT_EQ(read_bytes(folder / "a.body.h5"), bytes);
    EXPECT_EQ(folder.file_count(), 2);
}

TEST(BodyFile, MissingFileIsNamed) {
    EXPECT_THAT(error_of_file("nowhere/a.body.h5"),
                HasSubstr("nowhere/a.body.h5: does not exist; check the name"));
}

TEST(BodyFile, FileCutShortIsRefusedAtEveryLength) {
    const test::TemporaryFolder folder;
    write_body_file(folder / "a.body.h5", test::full_body());
    const std::string bytes = read_bytes(folder / "a.body.h5");
    for (std::size_t tenths = 0; tenths < 10; ++tenths) {
        replace_file_with(folder / "cut.body.h5",
                          std::string_view(bytes).substr(0, tenths * bytes.size() / 10));
        EXPECT_THAT(error_of_file(folder / "cut.body.h5"), HasSubstr("cut.body.h5"));
    }
}

TEST(BodyFile, RandomBytesAreRefused) {
    const test::TemporaryFolder folder;
    std::mt19937 generator(1);
    std::string bytes(5000, '\0');
    for (char& byte : bytes) byte = static_cast<char>(generator() & 0xffU);
    replace_file_with(folder / "a.body.h5", bytes);
    EXPECT_THAT(error_of_file(folder / "a.body.h5"), HasSubstr("is not an HDF5 file"));
}

TEST(BodyFile, ForeignHdf5IsRefused) {
    const test::TemporaryFolder folder;
    write_hdf5(folder / "a.body.h5", [](Hdf5Writer& file) {
        file.write("/density", std::vector<double>{1.0}, {1}, "kg/m^3", "of something");
    });
    EXPECT_THAT(error_of_file(folder / "a.body.h5"), HasSubstr("not a body file"));
}

/// Reads 400 copies of a body file with one bit flipped in each. Returns whether every one was rejected by
/// name or gave the same body (bits that are not read may be flipped), and most were rejected.
bool every_flip_is_seen(const test::TemporaryFolder& folder) {
    const Body body = test::full_body();
    const std::filesystem::path file = folder / "a.body.h5";
    write_body_file(file, body);
    const std::string bytes = read_bytes(file);
    std::mt19937 generator(2);
    int rejected = 0;
    constexpr int trials = 400;
    for (int trial = 0; trial < trials; ++trial) {
        std::string flipped = bytes;
        const std::size_t place = generator() % bytes.size();
        flipped[place] = static_cast<char>(flipped[place] ^ static_cast<char>(1U << (generator() % 8)));
        replace_file_with(file, flipped);
        try {
            expect_equal(read_body_file(file), body);
        } catch (const Error& error) {
            EXPECT_THAT(error.what(), HasSubstr("a.body.h5"));
            ++rejected;
        }
    }
    EXPECT_GT(rejected, trials / 2);
    return !testing::Test::HasFailure();
}

TEST(BodyFile, FlippedBitNeverGivesAnotherBodyInSilence) {
    // In a process of its own: HDF5 1.10 loses memory on damaged metadata, as a plain C program that opens
    // and closes such files shows.
    const test::TemporaryFolder folder;
    EXPECT_EXIT(std::_Exit(every_flip_is_seen(folder) ? 0 : 1), testing::ExitedWithCode(0), "");
}

TEST(BodyFile, NewerFormatAsksForAnUpdate) {
    const test::TemporaryFolder folder;
    write_hdf5(folder / "a.body.h5", [](Hdf5Writer& file) {
        file.attribute("/", "format_version", std::int64_t{1000});
        file.attribute("/surface", "source", std::string_view("x"));
        file.attribute("/moments", "volume", 1.0);
    });
    EXPECT_THAT(error_of_file(folder / "a.body.h5"), HasSubstr("newer version"));
}

TEST(BodyFile, TriangleBeyondTheVerticesIsNamed) {
    const test::TemporaryFolder folder;
    Body body = test::full_body();
    body.surface.corners[3][1] = static_cast<std::int32_t>(body.surface.vertices.size());
    write_body_file(folder / "a.body.h5", body);
    EXPECT_THAT(error_of_file(folder / "a.body.h5"), HasSubstr("/surface/corners row 3"));
    body.surface.corners[3][1] = -1;
    write_body_file(folder / "a.body.h5", body);
    EXPECT_THAT(error_of_file(folder / "a.body.h5"), HasSubstr("/surface/corners row 3"));
}

TEST(BodyFile, ValuesThatAreNotFiniteAreNamed) {
    const test::TemporaryFolder folder;
    Body body = test::full_body();
    body.tables->entries[4].force.x() = std::nan("");
    write_body_file(folder / "a.body.h5", body);
    EXPECT_THAT(error_of_file(folder / "a.body.h5"), HasSubstr("/tables/force"));
}

TEST(BodyFile, SurfaceLoadsThatAreNoneAreNamedWithTheirRemedy) {
    const test::TemporaryFolder folder;
    Body body = test::full_body();
    body.surface_loads->potentials[3].y() = 5e5;
    write_body_file(folder / "a.body.h5", body);
    EXPECT_THAT(error_of_file(folder / "a.body.h5"),
                AllOf(HasSubstr("/surface_loads holds a length of 500000 L"), HasSubstr("samara kirchhoff")));
    body = test::full_body();
    body.surface_loads->potentials[1].x() = std::numeric_limits<double>::quiet_NaN();
    write_body_file(folder / "b.body.h5", body);
    EXPECT_THAT(error_of_file(folder / "b.body.h5"), HasSubstr("/surface_loads/potentials"));
    body = test::full_body();
    body.surface_loads->potentials.pop_back();
    write_body_file(folder / "c.body.h5", body);
    EXPECT_THAT(error_of_file(folder / "c.body.h5"), HasSubstr("/surface_loads/potentials"));
    body = test::full_body();
    body.surface_loads->surface.corners[2][1] = 1000;
    write_body_file(folder / "d.body.h5", body);
    EXPECT_THAT(error_of_file(folder / "d.body.h5"), HasSubstr("/surface_loads/corners row 2"));
}

TEST(BodyFile, DynamicCoefficientsThatAreNoneAreNamed) {
    const test::TemporaryFolder folder;
    const double infinity = std::numeric_limits<double>::infinity();
    const auto rejected = [&](const auto& spoil, const std::string& what) {
        Body body = test::full_body();
        spoil(*body.dynamic);
        write_body_file(folder / "a.body.h5", body);
        const std::string error = error_of_file(folder / "a.body.h5");
        EXPECT_THAT(error, AllOf(HasSubstr("a.body.h5"), HasSubstr("/dynamic_coefficients/" + what)));
        EXPECT_EQ(error.find('\n'), std::string::npos);
    };
    using Identified = IdentifiedCoefficients;
    for (const NumberOfMotion& number : numbers_of_motion) {
        const std::string name = number.name;
        rejected([&](Identified& c) { c.values.*number.member = std::nan(""); }, name + " is not finite");
        rejected([&](Identified& c) { c.standard_errors.*number.member = -1.0; }, name + "_error");
        rejected([&](Identified& c) { c.standard_errors.*number.member = infinity; }, name + "_error");
    }
    rejected([&](Identified& c) { c.values.unsteady_factor = 0.0; }, "unsteady_factor is not positive");
    rejected([&](Identified& c) { c.values.half_length = 0.0; }, "half_length is not a positive");
    rejected([&](Identified& c) { c.values.half_length = infinity; }, "half_length is not a positive");
    rejected([&](Identified& c) { c.values.drag_in_motion(2, 2) = -0.1; },
             "drag_in_motion is not positive semidefinite");
    rejected([&](Identified& c) { c.values.rotational_drag(0, 2) = c.values.rotational_drag(2, 0) = 0.01; },
             "rotational_drag is not positive semidefinite");
    for (const IdentifiedDensities none :
         {IdentifiedDensities{2.0, 1.0}, IdentifiedDensities{2.0, infinity}}) {
        rejected([&](Identified& c) { c.densities = none; }, "lowest_density");
    }
    for (const TensorOfMotion& tensor : tensors_of_motion) {
        const std::string name = tensor.name;
        rejected([&](Identified& c) { (c.values.*tensor.member)(1, 1) = infinity; }, name);
        rejected([&](Identified& c) { (c.values.*tensor.member)(0, 1) += 1e-3; }, name + " is not symmetric");
        rejected([&](Identified& c) { (c.standard_errors.*tensor.member)(0, 1) = -0.1; }, name + "_error");
        rejected([&](Identified& c) { (c.standard_errors.*tensor.member)(2, 2) = std::nan(""); },
                 name + "_error");
    }
}

TEST(BodyFile, DynamicCoefficientsOfAnEarlierFormAreRefusedWithARemedy) {
    const test::TemporaryFolder folder;
    Body body = test::full_body();
    body.dynamic.reset();
    write_body_file(folder / "a.body.h5", body);
    {
        H5::H5File file((folder / "a.body.h5").string(), H5F_ACC_RDWR);
        const H5::Group group = file.createGroup("/dynamic_coefficients");
        const double value = 0.75;
        for (const char* name : {"force_transport", "moment_transport"}) {
            group.createAttribute(name, H5::PredType::NATIVE_DOUBLE, H5::DataSpace())
                .write(H5::PredType::NATIVE_DOUBLE, &value);
        }
    }
    const std::string error = error_of_file(folder / "a.body.h5");
    EXPECT_THAT(error, AllOf(HasSubstr("a.body.h5: /dynamic_coefficients has an outdated form"),
                             HasSubstr("remove the group to use the defaults")));
    EXPECT_EQ(error.find('\n'), std::string::npos);
}

TEST(BodyFile, DynamicCoefficientsWithTermsOfBeforeAreRefusedButWhereTheyAreNone) {
    const test::TemporaryFolder folder;
    const std::string path = (folder / "a.body.h5").string();
    const Body body = test::full_body();
    for (const double value : {0.0, 1e-7}) {
        write_body_file(path, body);
        {
            H5::H5File file(path, H5F_ACC_RDWR);
            const hsize_t shape[] = {3, 3};
            const std::vector<double> numbers(9, value);
            for (const char* name : {"wake_by_velocity", "wake_by_turning", "entrained_inertia"}) {
                file.openGroup("/dynamic_coefficients")
                    .createDataSet(name, H5::PredType::NATIVE_DOUBLE, H5::DataSpace(2, shape))
                    .write(numbers.data(), H5::PredType::NATIVE_DOUBLE);
            }
        }
        if (value == 0.0) {
            expect_equal(read_body_file(path), body);
        } else {
            EXPECT_THAT(error_of_file(path),
                        AllOf(HasSubstr("a.body.h5: /dynamic_coefficients has an outdated form"),
                              HasSubstr("bake the body again")));
        }
    }
}

TEST(BodyFile, DynamicCoefficientsFromBeforeThereWereTheirLaterNumbersHaveThoseOfNoEffect) {
    const test::TemporaryFolder folder;
    Body body = test::full_body();
    write_body_file(folder / "a.body.h5", body);
    {
        H5::H5File file((folder / "a.body.h5").string(), H5F_ACC_RDWR);
        H5::Group group = file.openGroup("/dynamic_coefficients");
        for (const char* name :
             {"unsteady_factor", "unsteady_factor_error", "settling_length", "settling_length_error"}) {
            group.removeAttr(name);
        }
    }
    body.dynamic->values.unsteady_factor = 1.0;
    body.dynamic->standard_errors.unsteady_factor = 0.0;
    body.dynamic->values.settling_length = usual_settling_length;
    body.dynamic->standard_errors.settling_length = 0.0;
    expect_equal(read_body_file(folder / "a.body.h5"), body);
}

TEST(BodyFile, TheSettlingLengthIsReadByTheNameThatItHadBefore) {
    const test::TemporaryFolder folder;
    Body body = test::full_body();
    body.dynamic->values.settling_length = 3.5;
    write_body_file(folder / "a.body.h5", body);
    {
        H5::H5File file((folder / "a.body.h5").string(), H5F_ACC_RDWR);
        H5::Group group = file.openGroup("/dynamic_coefficients");
        for (const char* end : {"", "_error"}) {
            ASSERT_GE(H5Arename(group.getId(), (std::string("settling_length") + end).c_str(),
                                (std::string("settling_ways") + end).c_str()),
                      0);
        }
    }
    expect_equal(read_body_file(folder / "a.body.h5"), body);
}

TEST(BodyFile, DynamicCoefficientsFromBeforeTheDensitiesOfTheirFallsWereKeptKnowNone) {
    const test::TemporaryFolder folder;
    Body body = test::full_body();
    write_body_file(folder / "a.body.h5", body);
    {
        H5::H5File file((folder / "a.body.h5").string(), H5F_ACC_RDWR);
        H5::Group group = file.openGroup("/dynamic_coefficients");
        for (const char* name : {"lowest_density", "highest_density"}) group.removeAttr(name);
    }
    body.dynamic->densities = {};
    expect_equal(read_body_file(folder / "a.body.h5"), body);
}

TEST(BodyFile, DynamicCoefficientsOfRankOneAndZeroAndIndefiniteWhereTheyMayAreAllowed) {
    const test::TemporaryFolder folder;
    Body body = test::full_body();
    const Vector3d arm(0.1, 0.2, 0.3);
    body.dynamic->values.drag_in_motion = arm * arm.transpose();
    body.dynamic->values.rotational_drag.setZero();
    body.dynamic->values.transport = Vector3d(-0.1, 0.2, 0.0).asDiagonal();
    body.dynamic->values.rotational_transport = -0.3;
    write_body_file(folder / "a.body.h5", body);
    expect_equal(read_body_file(folder / "a.body.h5"), body);
}

TEST(BodyFile, NothingIsLeftWhereTheFolderDoesNotExist) {
    const test::TemporaryFolder folder;
    EXPECT_THAT(error_of([&] { write_body_file(folder / "no/a.body.h5", test::full_body()); }),
                HasSubstr("does not exist"));
    EXPECT_EQ(folder.file_count(), 0);
}

TEST(BodyFile, AFolderThatTakesNoFilesIsNamed) {
    // The kernel's own folder: not even root can write there.
    EXPECT_THAT(error_of([&] { write_body_file("/proc/a.body.h5", test::full_body()); }),
                AllOf(HasSubstr("/proc/a.body.h5"), HasSubstr("cannot be written")));
}

TEST(BodyFile, NameOfTheBodyIsTheStem) {
    EXPECT_EQ(body_name_of("dir/rubber.body.h5"), "rubber");
    EXPECT_EQ(body_name_of("dir/rubber.stl"), "rubber");
    EXPECT_TRUE(is_body_file_name("dir/rubber.body.h5"));
    EXPECT_FALSE(is_body_file_name("dir/rubber.h5"));
}

TEST(BodyFile, SurfaceHashKnowsEveryVertexAndTriangle) {
    Body body = test::full_body();
    const std::string hash = surface_hash(body.surface);
    Surface moved = body.surface;
    moved.vertices[0].x() = std::nextafter(moved.vertices[0].x(), 1.0);
    EXPECT_NE(surface_hash(moved), hash);
    Surface turned = body.surface;
    std::swap(turned.corners[0][0], turned.corners[0][1]);
    EXPECT_NE(surface_hash(turned), hash);
}

TEST(BodyFile, OfTablesWithoutErrorSourcesReadsAsOneThatDoesNotSay) {
    const test::TemporaryFolder folder;
    Body body = test::full_body();
    body.tables->error_sources.clear();
    body.tables->left_out.clear();
    write_body_file(folder / "a.body.h5", body);
    EXPECT_FALSE(Hdf5Reader(folder / "a.body.h5").has("/tables/error_sources"));
    expect_equal(read_body_file(folder / "a.body.h5"), body);
}

}  // namespace
}  // namespace samara

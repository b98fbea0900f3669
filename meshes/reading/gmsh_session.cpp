#include "meshes/reading/gmsh_session.hpp"

#include <cmath>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <gmsh.h>

#include "samara/core/base/error.hpp"

namespace samara {
namespace {

constexpr std::string_view error_prefix = "Error: ";

// The first error is the cause; the later ones follow from it.
std::string first_logged_error() {
    std::vector<std::string> log;
    gmsh::logger::get(log);
    for (const std::string& line : log) {
        if (line.starts_with(error_prefix)) return line.substr(error_prefix.size());
    }
    return {};
}

std::string one_line(std::string text) {
    for (char& character : text) {
        if (character == '\n' || character == '\r') character = ' ';
    }
    return text;
}

// Cuts solids that overlap or touch into pieces that share their walls, so that the boundary of all pieces is
// that of the union.
bool cut_solids() {
    gmsh::vectorpair solids;
    gmsh::model::occ::getEntities(solids, 3);
    if (solids.size() < 2) return false;
    gmsh::vectorpair pieces;
    std::vector<gmsh::vectorpair> pieces_of_each;
    gmsh::model::occ::fragment(solids, {}, pieces, pieces_of_each);
    return true;
}

[[noreturn]] void fail(const std::string& label, const std::string& what, const std::string& thrown) {
    const std::string logged = first_logged_error();
    const std::string reason = logged.empty() ? thrown : logged;
    throw Error(fmt::format("{}: {}{}{}", label, what, reason.empty() ? "" : ": ", one_line(reason)));
}

}  // namespace

GmshSession::GmshSession() {
    constexpr bool read_user_options = false;
    gmsh::initialize(0, nullptr, read_user_options);
    gmsh::option::setNumber("General.Terminal", 0);
    gmsh::logger::start();
}

GmshSession::~GmshSession() {
    gmsh::logger::stop();
    // Variables of .geo files would otherwise outlive the session and override the defaults of the next.
    gmsh::onelab::clear();
    gmsh::clear();
    gmsh::finalize();
}

void GmshSession::run(const std::string& label, const std::string& what, const std::function<void()>& calls) {
    try {
        calls();
    } catch (const Error&) {
        throw;
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const std::exception& error) {
        fail(label, what, error.what());
    } catch (const std::string& error) {
        fail(label, what, error);
    } catch (const char* error) {
        fail(label, what, error);
    } catch (...) {
        fail(label, what, {});
    }
}

void GmshSession::open(const std::string& label) {
    load(label, [&] {
        gmsh::open(label);
        if (cut_solids()) gmsh::model::occ::synchronize();
    });
}

double GmshSession::import_shapes(const std::string& label, const std::string& format) {
    // Shapes that are small or large relative to the tolerance of 1e-7 are read again, scaled.
    constexpr double least_diagonal = 10.0;
    constexpr double largest_diagonal = 1000.0;
    constexpr double usual_diagonal = 100.0;
    double factor = 1.0;
    const auto import = [&] {
        gmsh::vectorpair shapes;
        constexpr bool highest_dimension_alone = false;
        gmsh::option::setNumber("Geometry.OCCScaling", factor);
        gmsh::model::occ::importShapes(label, shapes, highest_dimension_alone, format);
        gmsh::model::occ::synchronize();
    };
    gmsh::option::setString("Geometry.OCCTargetUnit", "MM");
    load(label, [&] {
        import();
        double low[3];
        double high[3];
        gmsh::model::getBoundingBox(-1, -1, low[0], low[1], low[2], high[0], high[1], high[2]);
        const double diagonal = std::hypot(high[0] - low[0], high[1] - low[1], high[2] - low[2]);
        if (diagonal > 0.0 && std::isfinite(diagonal) &&
            (diagonal < least_diagonal || diagonal > largest_diagonal)) {
            gmsh::clear();
            factor = usual_diagonal / diagonal;
            import();
        }
        if (cut_solids()) gmsh::model::occ::synchronize();
    });
    constexpr double millimetres = 1000.0;
    return format == "step" ? millimetres * factor : factor;
}

void GmshSession::load(const std::string& label, const std::function<void()>& calls) {
    constexpr const char* what = "gmsh cannot read it";
    // An exception out of the parser would leave its state to the next file, so it parses to the end instead.
    double abort_on_error = 0.0;
    gmsh::option::getNumber("General.AbortOnError", abort_on_error);
    gmsh::option::setNumber("General.AbortOnError", 0);
    run(label, what, calls);
    if (!first_logged_error().empty()) fail(label, what, {});
    // A .geo file may have set these for itself.
    gmsh::option::setNumber("General.AbortOnError", abort_on_error);
    gmsh::option::setNumber("General.Terminal", 0);
}

void GmshSession::generate_surface_mesh() {
    // gmsh meshes surfaces in parallel, where an exception would end the program, and it recovers from much
    // of what it reports as an error.
    double abort_on_error = 0.0;
    gmsh::option::getNumber("General.AbortOnError", abort_on_error);
    gmsh::option::setNumber("General.AbortOnError", 0);
    gmsh::model::mesh::clear();
    gmsh::model::mesh::generate(2);
    gmsh::option::setNumber("General.AbortOnError", abort_on_error);
}

std::string gmsh_version() {
    return GMSH_API_VERSION;
}

}  // namespace samara

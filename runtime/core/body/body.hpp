#pragma once

#include <optional>
#include <string>
#include <vector>

#include "samara/core/base/linear_algebra.hpp"
#include "samara/core/body/dynamic_coefficients.hpp"
#include "samara/core/body/load_tables.hpp"
#include "samara/core/body/surface_loads.hpp"
#include "samara/core/physics/mass_specification.hpp"
#include "samara/core/surface/surface.hpp"

namespace samara {

/// Integrals over the body's volume, from its surface alone: they know nothing of density.
struct VolumeMoments {
    double volume = 0.0;  ///< m^3
    Vector3d centroid =
        Vector3d::Zero();  ///< m, shape axes: the reference point of everything in a body file
    Matrix3d second_moments =
        Matrix3d::Zero();       ///< integral of x x^T dV about the centroid (m^5), shape axes
    double surface_area = 0.0;  ///< m^2
};

/// The unit vectors of the body's principal axes as columns, from the shortest to the longest extent,
/// right-handed, shape axes: the eigenvectors of the second moments.
Matrix3d principal_axes(const VolumeMoments& moments);

/// The inertia tensor (kg m^2) about the centroid of the body filled with the uniform density (kg/m^3), shape
/// axes.
Matrix3d uniform_inertia(const VolumeMoments& moments, double density);

/// The rotations and reflections about the centroid that map the surface onto itself, in shape axes.
struct Symmetry {
    /// The type of their group.
    enum class Type {
        finite,     ///< `elements` lists the whole group
        axial,      ///< every rotation about `axis`, beside `elements`
        spherical,  ///< every rotation
    };
    Type type = Type::finite;                                 ///< of the group
    Vector3d axis = Vector3d::UnitZ();                        ///< unit vector; of meaning where kind is axial
    std::vector<Matrix3d> elements = {Matrix3d::Identity()};  ///< orthogonal matrices, the identity first
    Matrix3d axes =
        Matrix3d::Identity();  ///< columns: a right-handed frame aligned with the mirrors and rotation axes,
                               ///< the shape axes themselves where these are so aligned
    double tolerance = 0.0;    ///< the distance over the body's size within which the images were accepted
};

/// "finite", "axial" or "spherical", as body files and reports say it.
const char* name_of(Symmetry::Type type);

/// The fluid's inertia: l and p of the fluid are K_fluid (omega, v), order omega then v, in shape axes, about
/// the centroid of the volume, for a fluid of density 1 kg/m^3. Blocks: m^5, m^4, m^3.
struct KirchhoffTensor {
    Matrix6d matrix = Matrix6d::Zero();  ///< symmetric 6x6 (rho_f = 1 kg/m^3)
    double error_estimate = 0.0;         ///< relative tensor error (docs/theory, measures)
    double asymmetry = 0.0;              ///< relative asymmetry before it was symmetrised
    int triangles = 0;                   ///< of the finest surface used
    std::string method;                  ///< in words: the boundary elements that were used
};

/// The same tensor about the point `point` (m) instead of the one it is about: K' = X^T K X with v = v' +
/// omega x (old - new).
Matrix6d about_point(const Matrix6d& tensor, const Vector3d& old_point, const Vector3d& new_point);

/// The same tensor in axes turned by `rotation`: a vector a of the old axes is rotation * a in the new ones.
Matrix6d in_rotated_axes(const Matrix6d& tensor, const Matrix3d& rotation);

/// How far a body's surface is from the shape file that it was made of.
struct ShapeError {
    double distance = 0.0;  ///< the greatest between the two, over the diagonal of the shape's bounding box
    double mean_distance = 0.0;  ///< between the two, over the area (m)
    double volume = 0.0;         ///< relative change
    double area = 0.0;           ///< relative change
    double faceting = 0.0;  ///< of a shape of triangles: the volume between its facets and the smooth shape
                            ///< through their vertices, over the whole, at most 1
};

/// The relative error of the added mass that `error` may bring about, the greatest of 5/3 of the changes of
/// volume, 5/3 of the faceting, and the volume of the mean distance over the surface, relative to the
/// displaced volume and the mean of the added masses `tensor`.
double tensor_error_of(const ShapeError& error, const VolumeMoments& moments, const Matrix6d& tensor);

/// All that a body file holds. Each stage adds a part: mesh the first six, kirchhoff two, and
/// convert one.
struct Body {
    std::string name;    ///< of the file it came from, or of the scene
    std::string source;  ///< how the surface was made, one line: the shape file's name and hash, the options
    Surface surface;     ///< in shape axes
    VolumeMoments moments;                          ///< of the volume within the surface
    Symmetry symmetry;                              ///< of the surface
    std::optional<ShapeError> shape_error;          ///< of the surface; none where it is not known
    std::optional<KirchhoffTensor> kirchhoff;       ///< none before `samara kirchhoff`
    std::optional<SurfaceLoads> surface_loads;      ///< none before `samara kirchhoff`
    std::optional<LoadTables> tables;               ///< none before `samara bake`
    std::optional<IdentifiedCoefficients> dynamic;  ///< of a body in rotation; without them, defaults
    std::optional<MassSpecification> mass;          ///< what it weighs where nobody says otherwise
};

/// The mass of a body for which `asked` is asked: that, where it is one, else the body's own; not given where
/// neither has one.
MassSpecification mass_asked_or_own(const MassSpecification& asked, const Body& body);

/// A mass in figures.
struct MassProperties {
    double mass = 0.0;                           ///< kg
    Vector3d center_of_mass = Vector3d::Zero();  ///< m, shape axes
    Matrix3d inertia = Matrix3d::Zero();         ///< kg m^2 about the centre of mass, shape axes
};

/// What a mass that is given to a body comes to. It is not checked.
MassProperties mass_properties(const Body& body, const MassSpecification& mass);

/// The body's lengths along its principal axes (m), shortest first.
Vector3d principal_extents(const Body& body);

}  // namespace samara

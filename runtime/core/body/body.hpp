#pragma once

#include <optional>
#include <string>
#include <vector>

#include "samara/core/base/linear_algebra.hpp"
#include "samara/core/body/dynamic_coefficients.hpp"
#include "samara/core/body/load_tables.hpp"
#include "samara/core/body/recommended_models.hpp"
#include "samara/core/body/surface_loads.hpp"
#include "samara/core/physics/mass_specification.hpp"
#include "samara/core/surface/surface.hpp"

namespace samara {

/// Integrals over the body's volume, from its surface alone: independent of density.
struct VolumeMoments {
    double volume = 0.0;  ///< m^3
    /// m, shape axes: the reference point of everything in a body file
    Vector3d centroid = Vector3d::Zero();
    /// integral of x x^T dV about the centroid (m^5), shape axes
    Matrix3d second_moments = Matrix3d::Zero();
    double surface_area = 0.0;  ///< m^2
};

/// Returns the unit vectors of the body's principal axes as columns, from the shortest to the longest extent,
/// right-handed, shape axes: the eigenvectors of the second moments.
Matrix3d principal_axes(const VolumeMoments& moments);

/// Returns the inertia tensor (kg m^2, shape axes) about the centroid of the body filled with a uniform
/// density (kg/m^3).
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
    Vector3d axis = Vector3d::UnitZ();                        ///< unit vector; used where the type is axial
    std::vector<Matrix3d> elements = {Matrix3d::Identity()};  ///< orthogonal matrices, the identity first
    /// columns: a right-handed frame aligned with the mirrors and rotation axes, the shape axes themselves
    /// where these are aligned with them
    Matrix3d axes = Matrix3d::Identity();
    /// relative to the body's size: the distance within which the images were accepted
    double tolerance = 0.0;
};

/// Returns "finite", "axial" or "spherical", as body files and reports write it.
const char* name_of(Symmetry::Type type);

/// The fluid's inertia: l and p of the fluid are K_fluid (omega, v), order omega then v, in shape axes, about
/// the centroid of the volume, for a fluid of density 1 kg/m^3. Blocks: m^5, m^4, m^3.
struct KirchhoffTensor {
    Matrix6d matrix = Matrix6d::Zero();  ///< symmetric 6x6 (rho_f = 1 kg/m^3)
    double error_estimate = 0.0;         ///< relative tensor error (docs/reference/metrics.md)
    double asymmetry = 0.0;              ///< relative asymmetry before it was symmetrised
    int triangles = 0;                   ///< of the finest surface used
    std::string method;                  ///< in words: the boundary elements that were used
};

/// Returns a Kirchhoff tensor about `new_point` (m) that is given about `old_point`: K' = X^T K X with v = v'
/// + omega x (old - new).
Matrix6d about_point(const Matrix6d& tensor, const Vector3d& old_point, const Vector3d& new_point);

/// Returns a Kirchhoff tensor in rotated axes: a vector a of the old axes is rotation * a in the new ones.
Matrix6d in_rotated_axes(const Matrix6d& tensor, const Matrix3d& rotation);

/// The difference between a body's surface and the shape file that it was made of.
struct ShapeError {
    double distance = 0.0;       ///< the greatest, relative to the diagonal of the shape's bounding box
    double mean_distance = 0.0;  ///< m: the mean over the area
    double volume = 0.0;         ///< relative change
    double area = 0.0;           ///< relative change
    /// of a shape of triangles: the volume between its facets and the smooth shape through their vertices,
    /// relative to the whole, at most 1
    double faceting = 0.0;
};

/// Returns the relative error of the added mass that `error` may cause: the greater of 5/3 of the change of
/// volume or of the faceting, times 1.5 of the share of the displaced volume in that and the mean of the
/// added masses `tensor`, at most 1; and the volume of the mean distance times the surface area, relative to
/// both.
double tensor_error_of(const ShapeError& error, const VolumeMoments& moments, const Matrix6d& tensor);

/// All that a body file holds. Each program adds a part: `samara mesh` the first six, `samara kirchhoff` two,
/// `samara convert` the tables.
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
    std::optional<IdentifiedCoefficients> dynamic;  ///< of a body in unsteady motion; defaults where absent
    std::optional<MassSpecification> mass;          ///< its mass where a scene gives none
    std::optional<RecommendedModels> recommended;   ///< its models where a scene gives none
};

/// Returns the mass that a user asked for, or the body's own where `asked` is not given; not given where
/// neither is.
MassSpecification mass_asked_or_own(const MassSpecification& asked, const Body& body);

/// The mass, centre of mass and inertia of a body.
struct MassProperties {
    double mass = 0.0;                           ///< kg
    Vector3d center_of_mass = Vector3d::Zero();  ///< m, shape axes
    Matrix3d inertia = Matrix3d::Zero();         ///< kg m^2 about the centre of mass, shape axes
};

/// Returns the mass properties of a body with this mass specification. Nothing is checked.
MassProperties mass_properties(const Body& body, const MassSpecification& mass);

/// Returns the body's extents (m) along its principal axes, shortest first.
Vector3d principal_extents(const Body& body);

}  // namespace samara

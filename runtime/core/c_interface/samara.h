/* The C interface of samara: rigid bodies that fall, flutter and tumble through a fluid.
 *
 * For animation tools and game engines, in C99 and any language that calls C (docs/reference/c.md, with an
 * example). SI units; angles in radians; world z is up; quaternions are (w, x, y, z) and rotate the axes of
 * the shape to the world's.
 *
 * Every function that can fail returns a samara_status and, where it is not SAMARA_OK, writes one line of
 * text into `error`, a buffer of `error_size` bytes that may be null or too short (the text is then cut). A
 * call that fails changes nothing, unless it says otherwise. No function throws, exits or writes to the
 * terminal.
 *
 * There is no global state. Different objects may be used from different threads at the same time; one object
 * may be read by several threads at the same time, but while a thread changes it no other may use it.
 */
#ifndef SAMARA_H
#define SAMARA_H

#include <stddef.h>
#include <stdint.h>

#if defined(__GNUC__)
#define SAMARA_API __attribute__((visibility("default")))
#else
#define SAMARA_API
#endif

#ifdef __cplusplus
extern "C" {
#endif

/* The version of this header: it grows with every addition; what exists does not change. */
#define SAMARA_API_VERSION 11

/* The SAMARA_API_VERSION of the library that is linked: at least that of the header, or functions may be
 * missing. */
SAMARA_API int samara_api_version(void);

/* The version of samara, such as "0.1.0". */
SAMARA_API const char* samara_version(void);

typedef enum samara_status {
    SAMARA_OK = 0,
    SAMARA_INVALID_ARGUMENT = 1, /* a null pointer, an index or a number out of its range, a number that is
                                    not finite, settings that contradict each other */
    SAMARA_UNREADABLE_FILE = 2,  /* missing, cut short, damaged, of another type, or from a newer samara */
    SAMARA_MISSING_DATA = 3,     /* the body file lacks data that the settings need */
    SAMARA_TIME_PASSED = 4,      /* the simulation cannot go back */
    SAMARA_FOREIGN_STATE = 5,    /* the bytes are no state of this simulation, or are damaged */
    SAMARA_OUT_OF_RANGE = 6,     /* a body's motion left the range of numbers */
    SAMARA_OUT_OF_MEMORY = 7,
    SAMARA_INTERNAL_ERROR = 8 /* please report it */
} samara_status;

/* ---- Bodies ----------------------------------------------------------------------------------------------
 */

/* The content of a body file (NAME.body.h5). */
typedef struct samara_body samara_body;

/* Reads a body file into *body, which samara_body_free frees. `file`: UTF-8. */
SAMARA_API samara_status samara_body_load(const char* file, samara_body** body, char* error,
                                          size_t error_size);

/* Reads a body file that is not trusted into *body: a process of its own (fork) reads it first, so that a
 * file which crashes or hangs its reader, or takes too much memory, gives SAMARA_UNREADABLE_FILE and harms
 * nothing. It takes some milliseconds more. The file must stay as it is until the call returns. While another
 * thread is inside HDF5 it may fail, after half a minute. Since version 3. */
SAMARA_API samara_status samara_body_load_untrusted(const char* file, samara_body** body, char* error,
                                                    size_t error_size);

/* Frees a body. Simulations that were given it keep and share what they need of it. Null is allowed. */
SAMARA_API void samara_body_free(samara_body* body);

/* The following return an empty text, or 0, for a null body. Texts live as long as the body. */
SAMARA_API const char* samara_body_name(const samara_body* body);
SAMARA_API const char* samara_body_source(const samara_body* body); /* one line: the shape file it is from */
SAMARA_API double samara_body_volume(const samara_body* body);      /* m^3 */
SAMARA_API double samara_body_mass(const samara_body* body); /* kg: its file's; 0: none. Since version 6 */
SAMARA_API int samara_body_has_added_mass(const samara_body* body);    /* needed by default */
SAMARA_API int samara_body_has_tables(const samara_body* body);        /* of loads and turbulence */
SAMARA_API int samara_body_has_surface_loads(const samara_body* body); /* without CFD. Since version 8 */
/* What SAMARA_LOADS_OF_BODY means for this body: TABLE, SURFACE, or NONE without both. Since version 9. */
SAMARA_API int samara_body_recommended_loads(const samara_body* body);

/* The numbers of vertices and triangles of the surface, to show the body: flat triangles, into four of which
 * each curved one is cut. */
SAMARA_API size_t samara_body_vertex_count(const samara_body* body);
SAMARA_API size_t samara_body_triangle_count(const samara_body* body);

/* Copies x, y, z (m, shape axes) of all vertices; `capacity` is the number of doubles in `coordinates`, at
 * least 3 samara_body_vertex_count. */
SAMARA_API samara_status samara_body_get_vertices(const samara_body* body, double* coordinates,
                                                  size_t capacity, char* error, size_t error_size);

/* Copies three vertex numbers for each triangle, counter-clockwise seen from outside; `capacity` is the
 * number of entries in `corners`, at least 3 samara_body_triangle_count. */
SAMARA_API samara_status samara_body_get_triangles(const samara_body* body, int32_t* corners, size_t capacity,
                                                   char* error, size_t error_size);

/* ---- Settings --------------------------------------------------------------------------------------------
 */

/* A wind that the caller computes, since version 5. Fills `velocities` with the fluid's velocity beyond
 * `current` and gust (x, y, z of each; m/s, world axes) at `count` places (x, y, z of each; m, world) at a
 * time (s). It is called inside samara_advance_to, and for the Reynolds number by samara_get_report, for a
 * block of bodies at a time: with six places around each body and twice a step, so that its differences give
 * the gradient and the acceleration. Must give the same for the same arguments, whatever the order, must not
 * throw or call this simulation, and with `threads` other than 1 is called by several threads at once. A
 * velocity that is not finite, or beyond 1e30, ends samara_advance_to with SAMARA_OUT_OF_RANGE. */
typedef void (*samara_wind_function)(void* context, double time, size_t count, const double* places,
                                     double* velocities);

/* The settings of a simulation. Fill them with samara_default_settings, then change members: later versions
 * may add members at the end, and `size` tells the library which ones are there. */
typedef struct samara_settings {
    size_t size;              /* sizeof(samara_settings): which members are there */
    double fluid_density;     /* kg/m^3; default: water at 20 degrees Celsius, 998.2 */
    double fluid_viscosity;   /* dynamic, Pa s; default: 1.002e-3 */
    double current[3];        /* m/s; uniform and steady */
    double gust_amplitude[3]; /* m/s; the current oscillates by amplitude sin(2 pi t/period) */
    double gust_period;       /* s */
    double gravity[3];        /* m/s^2; default: 0, 0, -9.81 */
    double step;        /* s; default: 0.002. The grid of the time steps, whatever times are asked for */
    uint64_t seed;      /* of the noise; default: 1 */
    uint32_t run;       /* another run of the same seed has other noise; default: 0 */
    int32_t threads;    /* for many bodies; 0: all cores; default: 1. Does not change the motion */
    int32_t has_ground; /* whether there is level ground, on which bodies settle; default: 0 */
    double ground;      /* m: its height, with has_ground; a group that starts below it is rejected */

    /* since SAMARA_API_VERSION 5 */
    samara_wind_function wind; /* default (null): none */
    void* wind_context;        /* passed to `wind`; must live as long as the simulation */

    /* since SAMARA_API_VERSION 8 */
    int32_t bodies_collide; /* whether bodies touch each other as they touch the ground; default: 0. A group
                             * then starts at the next step of the simulation's grid */

    /* since SAMARA_API_VERSION 11 */
    uint64_t precision; /* SAMARA_PRECISION_...; default: DOUBLE */
} samara_settings;

/* The numbers of the steps. With SINGLE those of a crowd in the air take about half of the time, those of a
 * group of one body three times. Positions and contact are of double precision in both. SINGLE is rejected
 * with bodies_collide. */
enum { SAMARA_PRECISION_DOUBLE = 0, SAMARA_PRECISION_SINGLE = 1 };

SAMARA_API samara_status samara_default_settings(samara_settings* settings, size_t size, char* error,
                                                 size_t error_size);

/* The models, described in docs/explanation/model.md: of loads, turbulence and the Langevin equation. */
enum {
    SAMARA_LOADS_NONE = 0,
    SAMARA_LOADS_COEFFICIENTS = 1,
    SAMARA_LOADS_TABLE = 2,
    SAMARA_LOADS_SURFACE = 3, /* since version 8 */
    SAMARA_LOADS_OF_BODY = 4  /* since version 9: those the body file recommends, or the best it holds */
};
enum {
    SAMARA_TURBULENCE_NONE = 0,
    SAMARA_TURBULENCE_CONSTANT = 1,
    SAMARA_TURBULENCE_TABLE = 2,
    SAMARA_TURBULENCE_AS_LOADS = 3 /* as the file recommends, or noise with table and surface loads */
};
enum {
    SAMARA_LANGEVIN_SEEN_FLUID = 0,
    SAMARA_LANGEVIN_BODY_VELOCITY = 1,
    SAMARA_LANGEVIN_WAKE = 2 /* the body's own wake; with CONSTANT turbulence as SEEN_FLUID */
};
/* The source of the coefficients of the loads beyond those of a steady translation. */
enum {
    SAMARA_DYNAMIC_OF_BODY = 0, /* the body file's, or the defaults where it has none */
    SAMARA_DYNAMIC_DEFAULT = 1, /* the defaults */
    SAMARA_DYNAMIC_NONE = 2     /* none; with loads by coefficients: no rotational drag */
};

/* One body group of a simulation: bodies that share their physics. Fill it with samara_default_body_group; it
 * has no default mass. */
typedef struct samara_body_group {
    size_t size;      /* sizeof(samara_body_group): which members are there */
    const char* name; /* keys the noise: letters, digits, - and _; default (null): the body file's name */
    uint32_t count;   /* how many; default: 1 */

    double density;             /* kg/m^3, uniform; 0: not given */
    double mass;                /* kg, in place of a density. Neither: the body file's */
    int32_t has_center_of_mass; /* whether the next member counts */
    double center_of_mass[3];   /* m, shape axes, with `mass`; else the centroid of the volume */
    double inertia[9]; /* kg m^2 about the centre of mass, shape axes, with `mass`; all 0: as if uniform */

    double position[3];         /* where the shape's origin starts, m */
    double orientation[4];      /* w, x, y, z; is normalised; default: 1, 0, 0, 0 */
    double velocity[3];         /* of the centre of mass, m/s, world axes */
    double angular_velocity[3]; /* rad/s, world axes */
    double start;               /* s; held at rest until then */
    double spread_position[3];  /* m: several start up to this far from `position` along each axis ... */
    double spread_angle;        /* rad: ... and rotated by up to this, drawn from the seed */

    int32_t loads;                /* SAMARA_LOADS_...; default: OF_BODY, before version 9 TABLE */
    double drag_coefficient;      /* with COEFFICIENTS, as all of the next five; default: 1 */
    double lift_coefficient;      /* default: 0 */
    double reference_area;        /* m^2; default (0): the area projected along the motion */
    double normal[3];             /* shape axes; default (0, 0, 0): the axis of the shortest extent */
    double center_of_pressure[3]; /* m from the centroid of the volume, shape axes */

    int32_t turbulence;              /* SAMARA_TURBULENCE_...; default: AS_LOADS */
    double turbulent_kinetic_energy; /* m^2/s^2, with CONSTANT */
    double dissipation_rate;         /* m^2/s^3, with CONSTANT */
    int32_t langevin;                /* SAMARA_LANGEVIN_...; default: WAKE */

    /* since SAMARA_API_VERSION 2 */
    double table_reynolds_number; /* read the tables at this one alone; default (0): at the body's own */
    int32_t added_mass;           /* whether the fluid's inertia is part of the body's; default: 1 */
    int32_t dynamic_coefficients; /* SAMARA_DYNAMIC_...; default: OF_BODY */

    /* since SAMARA_API_VERSION 4 */
    int32_t patches; /* of the surface, each of which bears loads by its own velocity, 1 to 32; default (0):
                        as the body file recommends, or 1 */

    /* since SAMARA_API_VERSION 7 */
    double spread_start;  /* s: several start up to this after `start`, drawn from the seed */
    double smallest_size; /* relative to the shape, 0.001 to 1000, at its density: sizes of several lie ... */
    double largest_size;  /* ... between these two, drawn from the seed; one has both; default: 1 and 1 */

    /* since SAMARA_API_VERSION 10 */
    double area_density; /* g/m^2 of half the surface, in place of a density; sizes keep the thickness */
} samara_body_group;

SAMARA_API samara_status samara_default_body_group(samara_body_group* group, size_t size, char* error,
                                                   size_t error_size);

/* ---- Simulations -----------------------------------------------------------------------------------------
 */

typedef struct samara_simulation samara_simulation;

/* Makes an empty simulation at time 0 in *simulation, which samara_simulation_free frees. */
SAMARA_API samara_status samara_simulation_create(const samara_settings* settings,
                                                  samara_simulation** simulation, char* error,
                                                  size_t error_size);

SAMARA_API void samara_simulation_free(samara_simulation* simulation); /* null is allowed */

/* Adds the bodies of a group. Bodies are numbered from 0 in the order in which they are added; *first (may be
 * null) is the number of the first new one. Before version 6 only before the first advance; since then also
 * later, with a `start` at the simulation's time or after it. */
SAMARA_API samara_status samara_simulation_add(samara_simulation* simulation, const samara_body* body,
                                               const samara_body_group* group, size_t* first, char* error,
                                               size_t error_size);

/* The following return 0 for a null simulation. */
SAMARA_API size_t samara_simulation_count(const samara_simulation* simulation); /* bodies of all groups */
SAMARA_API double samara_simulation_time(const samara_simulation* simulation);  /* s */

/* Advances all bodies to a time (s); SAMARA_TIME_PASSED where it lies before the simulation's own. The steps
 * lie on a grid that `step` fixes, and poses in between are interpolated: asking at 24 or at 60 times a
 * second, or at any times, gives the same motion to the last bit. SAMARA_OUT_OF_RANGE: the simulation has
 * stopped, has no poses any more, and only samara_set_state brings it back. */
SAMARA_API samara_status samara_advance_to(samara_simulation* simulation, double time, char* error,
                                           size_t error_size);

/* Advances to a time (s) as samara_advance_to does, but takes no further step where that would probably end
 * later than `seconds` after the call, by the clock on the wall; one step at least. Where
 * samara_simulation_time is less than `time` then, the next call takes up the rest, or you give it less time:
 * the motion is the same. Forces and moments act in all steps that are taken. `seconds`: 0 or more, such as
 * 0.004 of a frame. Since version 11. */
SAMARA_API samara_status samara_advance_within(samara_simulation* simulation, double time, double seconds,
                                               char* error, size_t error_size);

/* The place and motion of one body at the simulation's time: 13 doubles without gaps. */
typedef struct samara_pose {
    double position[3];         /* of the shape's origin, m, world */
    double orientation[4];      /* w, x, y, z; shape axes to world; its sign is continuous in time */
    double velocity[3];         /* of the centre of mass, m/s, world axes */
    double angular_velocity[3]; /* rad/s, world axes */
} samara_pose;

/* Copies the poses of the bodies first ... first + count - 1. Pose i is at the address of `poses` plus i
 * times `stride` bytes; 0: they lie one after the other. */
SAMARA_API samara_status samara_get_poses(const samara_simulation* simulation, size_t first, size_t count,
                                          samara_pose* poses, size_t stride, char* error, size_t error_size);

/* Places bodies elsewhere at the simulation's time; orientations are normalised. A body keeps its sampled
 * turbulence and its wake, but one that was removed starts anew. Within a step the body moves steadily to the
 * step's end; normal stepping resumes at the next step. Before the body's start this is the place that
 * it will start from. A body below the ground is lifted onto it in the next step. */
SAMARA_API samara_status samara_set_poses(samara_simulation* simulation, size_t first, size_t count,
                                          const samara_pose* poses, size_t stride, char* error,
                                          size_t error_size);

/* Sets the noise of all steps to come. */
SAMARA_API samara_status samara_set_seed(samara_simulation* simulation, uint64_t seed, uint32_t run,
                                         char* error, size_t error_size);

/* The whole state as bytes: time, seed, report, all bodies, and the keys of obstacles, with which it grows;
 * without forces that no step has used yet, and without recorded contacts. A simulation that is set to it
 * continues as this one does, to the last bit. It fits simulations with the same settings, ground, wind,
 * obstacles and groups (threads, seed, run, the obstacles' keys and where the groups start may differ) of the
 * same samara on machines with the same byte order. */
SAMARA_API size_t samara_state_size(const samara_simulation* simulation); /* 0 for a null simulation */
SAMARA_API samara_status samara_get_state(const samara_simulation* simulation, void* bytes, size_t size,
                                          char* error, size_t error_size);
SAMARA_API samara_status samara_set_state(samara_simulation* simulation, const void* bytes, size_t size,
                                          char* error, size_t error_size);

/* ---- Surroundings, since SAMARA_API_VERSION 6 -------------------------------------------------------------
 */

/* The place of an obstacle at one time: 8 doubles without gaps. */
typedef struct samara_obstacle_key {
    double time;           /* s, of the simulation */
    double position[3];    /* of the obstacle's origin, m, world */
    double orientation[4]; /* w, x, y, z: the obstacle's axes to the world's; is normalised */
} samara_obstacle_key;

/* A solid that bodies touch and that does not react to them. Fill it with samara_default_obstacle. The
 * library copies the data behind the pointers. */
typedef struct samara_obstacle {
    size_t size;              /* sizeof(samara_obstacle): which members are there */
    const char* name;         /* for messages: letters, digits, - and _; default (null): "obstacle-" and its
                                 number */
    const double* vertices;   /* x, y, z of each, m, in the obstacle's axes; by default the world's */
    size_t vertex_count;      /* how many vertices */
    const int32_t* triangles; /* three vertex numbers each; of a closed surface counter-clockwise seen from
                                 outside; a sheet has two sides */
    size_t triangle_count;    /* how many triangles */
    double friction;          /* Coulomb's coefficient; default: 0.5 */
    double position[3];       /* where the obstacle's origin is, m; default: 0, 0, 0 */
    double orientation[4];    /* w, x, y, z; is normalised; default: 1, 0, 0, 0 */
    const samara_obstacle_key* keys; /* where it moves: in order of time, in place of the two above, and no
                                        point of it faster than 100 m/s */
    size_t key_count;                /* default: 0 */
} samara_obstacle;

SAMARA_API samara_status samara_default_obstacle(samara_obstacle* obstacle, size_t size, char* error,
                                                 size_t error_size);

/* Adds an obstacle: since version 10 at any time, before only before all bodies. Obstacles are numbered from
 * 0 in the order in which they are added; *index (may be null) is the number of the new one. A body that
 * starts or is inside of it is an error. */
SAMARA_API samara_status samara_simulation_add_obstacle(samara_simulation* simulation,
                                                        const samara_obstacle* obstacle, size_t* index,
                                                        char* error, size_t error_size);

/* Removes an obstacle: bodies that it bore fall, and the others keep their numbers. Since version 10. */
SAMARA_API samara_status samara_remove_obstacle(samara_simulation* simulation, size_t obstacle, char* error,
                                                size_t error_size);

SAMARA_API size_t samara_simulation_obstacle_count(const samara_simulation* simulation); /* 0 for null */

/* Replaces the keys of an obstacle. Between two it moves evenly on a straight line and by the shortest
 * rotation; after the last it stands. Once the simulation has advanced it moves from its place at the
 * simulation's time to the first key ahead, or within one step to the last key where none is: it never jumps.
 * An engine gives one key, its pose at the time of the next advance. Before the first advance the keys simply
 * replace those it has. */
SAMARA_API samara_status samara_set_obstacle_keys(samara_simulation* simulation, size_t obstacle,
                                                  const samara_obstacle_key* keys, size_t count, char* error,
                                                  size_t error_size);

/* Sets the wind in addition to `current`, gust and function of the settings, from the next step on: the keys
 * of [wind] of a scene (docs/reference/scene-file.md), in TOML:
 *
 *     "velocity = [4, 0, 0]\n"
 *     "profile = { law = \"log\" }\n"
 *     "gusts = { rms = 0.8, length = 2, seed = 3 }\n"
 *     "[[fan]]\n"
 *     "position = [0, 0, 1]\n" ...
 *
 * Gusts without a seed have the settings' own. The path of a [file] is taken from the working folder; after
 * its last time the wind stays, unless the file repeats. An empty text: no wind. At any time; bodies keep
 * their motion. In libsamara alone: libsamara-core, the core by itself, reads no TOML. */
SAMARA_API samara_status samara_set_wind(samara_simulation* simulation, const char* wind, char* error,
                                         size_t error_size);

/* Sets level ground at a height (m), or none with `has_ground` 0, from the next step on. Bodies at rest wake;
 * bodies below it are lifted onto it in the next step. */
SAMARA_API samara_status samara_set_ground(samara_simulation* simulation, int32_t has_ground, double height,
                                           char* error, size_t error_size);

/* ---- For game engines and robotics, since SAMARA_API_VERSION 7 --------------------------------------------
 */

/* Copies the sizes of the bodies first ... first + count - 1, relative to the shape. */
SAMARA_API samara_status samara_get_sizes(const samara_simulation* simulation, size_t first, size_t count,
                                          double* sizes, char* error, size_t error_size);

/* The mass properties of the body alone, without fluid, at its size: 13 doubles without gaps. */
typedef struct samara_mass_properties {
    double mass;              /* kg */
    double center_of_mass[3]; /* m, shape axes from the shape's origin */
    double inertia[9];        /* kg m^2 about the centre of mass, shape axes */
} samara_mass_properties;

SAMARA_API samara_status samara_get_mass_properties(const samara_simulation* simulation, size_t body,
                                                    samara_mass_properties* properties, char* error,
                                                    size_t error_size);

/* Pushes a body with a force (N, world axes) at a point (m, world; null: the centre of mass), or with a
 * moment (N m), in addition to fluid, gravity and contacts, in all steps of the next call of
 * samara_advance_to to a later time; then it ends. Several add up. A force that is given again before each
 * call acts evenly, at any frame rate; the momentum of one call alone is that of its steps, so give a blow as
 * an impulse. Before its start a body feels none. */
SAMARA_API samara_status samara_add_force(samara_simulation* simulation, size_t body, const double force[3],
                                          const double* point, char* error, size_t error_size);
SAMARA_API samara_status samara_add_moment(samara_simulation* simulation, size_t body, const double moment[3],
                                           char* error, size_t error_size);

/* Gives a body an impulse (N s, world axes) at a point (m, world; null: the centre of mass), or an angular
 * impulse (N m s), at the simulation's time. Body and fluid take it together: with the added inertia the
 * velocity changes by less than impulse over mass, and not along it. */
SAMARA_API samara_status samara_add_impulse(samara_simulation* simulation, size_t body,
                                            const double impulse[3], const double* point, char* error,
                                            size_t error_size);
SAMARA_API samara_status samara_add_angular_impulse(samara_simulation* simulation, size_t body,
                                                    const double angular_impulse[3], char* error,
                                                    size_t error_size);

/* Removes bodies: they stay in their place, cost no steps, touch nothing, and keep their numbers and poses.
 * samara_set_poses returns one, as a pool of objects does. */
SAMARA_API samara_status samara_remove(samara_simulation* simulation, size_t first, size_t count, char* error,
                                       size_t error_size);
SAMARA_API int samara_is_removed(const samara_simulation* simulation, size_t body); /* 0 for none such */

/* The contacts of a body with ground, obstacles and other bodies while it was watched, over all steps and
 * points: 96 bytes without gaps. A body at rest takes no steps, and records no more. */
typedef struct samara_contact {
    double impulse[3]; /* N s, world axes: the sum of all impulses on the body */
    double strongest;  /* N s: of one point in one step; 0: no contact, and the next four are 0 */
    double point[3];   /* m, world: the point of the strongest */
    double normal[3];  /* world axes: outwards from the touched surface there */
    double time;       /* s: the end of its step */
    int32_t obstacle;  /* number of the obstacle touched there; -1: level ground; -2 - i: body number i */
    int32_t at_rest;   /* whether the body is at rest now */
} samara_contact;

/* Records contacts from now on, or no longer with `watch` 0. Costs next to nothing; does not change the
 * motion. */
SAMARA_API samara_status samara_watch_contacts(samara_simulation* simulation, int32_t watch, char* error,
                                               size_t error_size);

/* Copies the contacts of the bodies first ... first + count - 1 since they were last taken. `stride` as in
 * samara_get_poses. SAMARA_INVALID_ARGUMENT while they are not watched (samara_watch_contacts). */
SAMARA_API samara_status samara_take_contacts(samara_simulation* simulation, size_t first, size_t count,
                                              samara_contact* contacts, size_t stride, char* error,
                                              size_t error_size);

/* The fluid's load on a body in its next step: for a host that integrates the body itself, alone or as part
 * of a mechanism. World axes, at the centre of mass; angular (three), then linear: 78 doubles without gaps,
 * matrices row by row. With M the body's own inertia, g its own wrench (weight, gyroscopic moment, joints,
 * contacts), h the step and a its acceleration (of the world, as derivative of the velocity),
 *
 *     (M + added_inertia + h damping) a = g + wrench
 *
 * is stable however stiff the drag is. A host that cannot add to M, and pushes with wrench - added_inertia a
 * of the acceleration before, diverges where the added inertia exceeds M. */
typedef struct samara_fluid_load {
    double wrench[6];         /* N m, N: of buoyancy, loads, turbulence, wind, and the fluid's own momentum */
    double added_inertia[36]; /* kg m^2, kg m, kg; symmetric */
    double damping[36];       /* N m s, N s, N s/m */
} samara_fluid_load;

/* Copies the fluid's load on a body. In each step call samara_set_poses with the host's result,
 * samara_get_fluid_load, samara_advance_to by one `step`, by which turbulence and wind advance. At a time
 * within a step of the body: SAMARA_INVALID_ARGUMENT. */
SAMARA_API samara_status samara_get_fluid_load(const samara_simulation* simulation, size_t body,
                                               samara_fluid_load* load, char* error, size_t error_size);

/* ---- Since SAMARA_API_VERSION 10 ------------------------------------------------------------------------
 */

/* The fluid's forces on a body by their causes; world axes, at the centre of mass; moment (three), then
 * force: 30 doubles without gaps. Their sum, with weight, pushes and contacts, moves the body's own mass. */
typedef struct samara_fluid_forces {
    double buoyancy[6]; /* N m, N: of the displaced fluid */
    double inertia[6];  /* of the fluid that the body accelerates and carries along: its added mass */
    double drag[6];     /* against the velocity relative to the fluid; no moment */
    double lift[6];     /* across it, and the whole moment of both */
    double noise[6];    /* the difference that the turbulence makes */
} samara_fluid_forces;

/* Copies the forces on the bodies first ... first + count - 1 at the end of the step that holds the
 * simulation's time; zeros before a body's start and once it is removed. `stride` as in samara_get_poses. */
SAMARA_API samara_status samara_get_fluid_forces(const samara_simulation* simulation, size_t first,
                                                 size_t count, samara_fluid_forces* forces, size_t stride,
                                                 char* error, size_t error_size);

/* The work of the simulation so far. Set `size` to sizeof(samara_report) before the call. */
typedef struct samara_report {
    size_t size;                    /* sizeof(samara_report): which members are there */
    uint64_t steps;                 /* of the grid, over all bodies */
    uint64_t substeps;              /* implicit steps: bodies that rotate fast take several in a step */
    int32_t most_substeps;          /* the most of any body in one step; 64 is the limit */
    double highest_reynolds_number; /* relative to the undisturbed flow: at every 32nd step, and now */
} samara_report;

SAMARA_API samara_status samara_get_report(const samara_simulation* simulation, samara_report* report,
                                           char* error, size_t error_size);

#ifdef __cplusplus
}
#endif

#endif

/* Flies the motions of the guard that go through the C interface, and writes the poses of all bodies of all
 * frames.
 *
 *   guarded_motions BODIES FOLDER     (BODIES: the ready-baked bodies; FOLDER gets NAME.poses, doubles
 * without gaps)
 */
#include <math.h>
#include <samara.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { most_bodies = 64 };

static char error[512];
static const char* bodies_folder;
static const char* output_folder;
static FILE* output;

static void check(samara_status status) {
    if (status == SAMARA_OK) return;
    fprintf(stderr, "guarded_motions: %s\n", error);
    exit(1);
}

static samara_simulation* simulation_of(const samara_settings* settings) {
    samara_simulation* simulation;
    check(samara_simulation_create(settings, &simulation, error, sizeof error));
    return simulation;
}

static samara_settings air(void) {
    samara_settings settings;
    check(samara_default_settings(&settings, sizeof settings, error, sizeof error));
    settings.fluid_density = 1.204;
    settings.fluid_viscosity = 1.82e-5;
    settings.seed = 5;
    return settings;
}

static samara_body_group copies(uint32_t count, double height) {
    samara_body_group group;
    check(samara_default_body_group(&group, sizeof group, error, sizeof error));
    group.count = count;
    group.position[2] = height;
    group.spread_angle = count > 1 ? 3.0 : 0.0;
    return group;
}

static size_t add(samara_simulation* simulation, const char* name, const samara_body_group* group) {
    char file[1024];
    samara_body* body;
    size_t first;
    snprintf(file, sizeof file, "%s/%s.body.h5", bodies_folder, name);
    check(samara_body_load(file, &body, error, sizeof error));
    check(samara_simulation_add(simulation, body, group, &first, error, sizeof error));
    samara_body_free(body);
    return first;
}

static void begin(const char* name) {
    char file[1024];
    snprintf(file, sizeof file, "%s/%s.poses", output_folder, name);
    output = fopen(file, "wb");
    if (output == NULL) {
        fprintf(stderr, "guarded_motions: %s cannot be written\n", file);
        exit(1);
    }
}

static void end(samara_simulation* simulation) {
    samara_simulation_free(simulation);
    if (fclose(output) != 0) {
        fprintf(stderr, "guarded_motions: the disk is full\n");
        exit(1);
    }
}

/* Flies to a time in frames of 1/24 s and writes each. */
static void fly(samara_simulation* simulation, double until) {
    samara_pose poses[most_bodies];
    const size_t count = samara_simulation_count(simulation);
    double time;
    while ((time = samara_simulation_time(simulation)) < until - 1e-9) {
        check(samara_advance_to(simulation, fmin(time + 1.0 / 24.0, until), error, sizeof error));
        check(samara_get_poses(simulation, 0, count, poses, 0, error, sizeof error));
        fwrite(poses, sizeof poses[0], count, output);
    }
}

/* Leaves of many sizes that start one after the other, with noise, onto the ground, on two threads. */
static void leaves(void) {
    samara_settings settings = air();
    samara_body_group group = copies(40, 0.8);
    samara_simulation* simulation;
    settings.has_ground = 1;
    settings.threads = 2;
    group.spread_position[0] = 0.4;
    group.spread_start = 0.5;
    group.smallest_size = 0.7;
    group.largest_size = 1.4;
    begin("c-leaves");
    simulation = simulation_of(&settings);
    add(simulation, "leaf", &group);
    fly(simulation, 3.0);
    end(simulation);
}

static void vortex(void* context, double time, size_t count, const double* places, double* velocities) {
    size_t i;
    for (i = 0; i < count; ++i) {
        velocities[3 * i] = -*(const double*)context * places[3 * i + 1];
        velocities[3 * i + 1] = *(const double*)context * places[3 * i];
        velocities[3 * i + 2] = 0.1 * time;
    }
}

/* A wind of the caller's beside a gust and the keys of a scene's wind, samaras by the loads of their surface.
 */
static void wind(void) {
    samara_settings settings = air();
    samara_body_group group = copies(6, 3.0);
    samara_simulation* simulation;
    double rate = 2.0;
    settings.gust_amplitude[1] = 0.3;
    settings.gust_period = 0.7;
    settings.wind = vortex;
    settings.wind_context = &rate;
    group.spread_position[1] = 0.3;
    group.loads = SAMARA_LOADS_SURFACE;
    group.patches = 2;
    begin("c-wind");
    simulation = simulation_of(&settings);
    check(samara_set_wind(simulation, "velocity = [0.4, 0, 0]\ngusts = { rms = 0.2, length = 1.0 }\n", error,
                          sizeof error));
    add(simulation, "samara", &group);
    fly(simulation, 1.5);
    end(simulation);
}

/* Cubes and discs in a heap in water, on a tray that moves by keys. */
static void heap(void) {
    static const double vertices[] = {-0.3, -0.3, 0.0, 0.3, -0.3, 0.0, 0.3, 0.3, 0.0, -0.3, 0.3, 0.0};
    static const int32_t triangles[] = {0, 1, 2, 0, 2, 3};
    static const samara_obstacle_key keys[] = {{0.0, {0.0, 0.0, 0.0}, {1.0, 0.0, 0.0, 0.0}},
                                               {1.0, {0.1, 0.0, 0.05}, {0.995, 0.0, 0.0998, 0.0}}};
    samara_settings settings;
    samara_body_group group = copies(12, 0.3);
    samara_obstacle tray;
    samara_simulation* simulation;
    check(samara_default_settings(&settings, sizeof settings, error, sizeof error));
    settings.has_ground = 1;
    settings.ground = -0.4;
    settings.bodies_collide = 1;
    check(samara_default_obstacle(&tray, sizeof tray, error, sizeof error));
    tray.vertices = vertices;
    tray.vertex_count = 4;
    tray.triangles = triangles;
    tray.triangle_count = 2;
    tray.keys = keys;
    tray.key_count = 2;
    begin("c-heap");
    simulation = simulation_of(&settings);
    check(samara_simulation_add_obstacle(simulation, &tray, NULL, error, sizeof error));
    group.spread_position[0] = group.spread_position[1] = 0.05;
    group.spread_position[2] = 0.1;
    add(simulation, "cube", &group);
    group.position[2] = 0.5;
    add(simulation, "disc", &group);
    check(samara_watch_contacts(simulation, 1, error, sizeof error));
    fly(simulation, 2.0);
    end(simulation);
}

/* Forces, impulses, poses set, bodies taken out, other ground, and the second half once more from a state. */
static void pushed(void) {
    static const double force[3] = {0.02, 0.0, 0.01}, impulse[3] = {0.0, 0.01, 0.0},
                        moment[3] = {0.0, 1e-4, 0.0};
    samara_settings settings;
    samara_body_group group = copies(8, 0.0);
    samara_simulation* simulation;
    samara_pose pose;
    size_t size;
    void* state;
    int turn;
    check(samara_default_settings(&settings, sizeof settings, error, sizeof error));
    group.turbulence = SAMARA_TURBULENCE_CONSTANT;
    group.turbulent_kinetic_energy = 1e-3;
    group.dissipation_rate = 2e-3;
    group.langevin = SAMARA_LANGEVIN_SEEN_FLUID;
    group.spread_position[0] = 1.0;
    begin("c-pushed");
    simulation = simulation_of(&settings);
    add(simulation, "ellipsoid", &group);
    check(samara_add_force(simulation, 0, force, NULL, error, sizeof error));
    check(samara_add_impulse(simulation, 1, impulse, force, error, sizeof error));
    check(samara_add_angular_impulse(simulation, 2, moment, error, sizeof error));
    check(samara_get_poses(simulation, 3, 1, &pose, 0, error, sizeof error));
    pose.velocity[0] = 0.5;
    pose.angular_velocity[2] = 20.0;
    check(samara_set_poses(simulation, 3, 1, &pose, 0, error, sizeof error));
    fly(simulation, 0.5);
    check(samara_remove(simulation, 4, 2, error, sizeof error));
    check(samara_add_moment(simulation, 6, moment, error, sizeof error));
    check(samara_set_ground(simulation, 1, -0.6, error, sizeof error));
    size = samara_state_size(simulation);
    state = malloc(size);
    check(samara_get_state(simulation, state, size, error, sizeof error));
    for (turn = 0; turn < 2; ++turn) {
        check(samara_set_state(simulation, state, size, error, sizeof error));
        fly(simulation, 1.5);
    }
    free(state);
    end(simulation);
}

/* A host that integrates a body itself, with what the fluid does to it in each step. */
static void host(void) {
    samara_settings settings = air();
    samara_body_group group = copies(1, 0.0);
    samara_simulation* simulation;
    samara_fluid_load load;
    samara_pose pose;
    int step, i;
    group.velocity[0] = 1.0;
    begin("c-host");
    simulation = simulation_of(&settings);
    add(simulation, "sheet", &group);
    for (step = 1; step <= 200; ++step) {
        check(samara_get_poses(simulation, 0, 1, &pose, 0, error, sizeof error));
        check(samara_get_fluid_load(simulation, 0, &load, error, sizeof error));
        for (i = 0; i < 3; ++i) {
            pose.angular_velocity[i] += settings.step * load.wrench[i] / (load.added_inertia[7 * i] + 1e-5);
            pose.velocity[i] += settings.step * load.wrench[3 + i] / (load.added_inertia[21 + 7 * i] + 1e-3);
            pose.position[i] += settings.step * pose.velocity[i];
        }
        check(samara_set_poses(simulation, 0, 1, &pose, 0, error, sizeof error));
        check(samara_advance_to(simulation, step * settings.step, error, sizeof error));
        fwrite(&pose, sizeof pose, 1, output);
    }
    end(simulation);
}

int main(int count, char** words) {
    if (count != 3) {
        fprintf(stderr, "Usage: guarded_motions BODIES FOLDER\n");
        return 1;
    }
    bodies_folder = words[1];
    output_folder = words[2];
    leaves();
    wind();
    heap();
    pushed();
    host();
    return 0;
}

/* Drops three bodies in water and prints where they are, 24 times a second.
 *
 *   samara bodies ellipsoid -o ellipsoid.body.h5
 *   cc -std=c99 fall.c -lsamara -o fall
 *   ./fall ellipsoid.body.h5
 *
 * Places are those of the shape's origin. Half-way the state is kept; at the end the second half is played again from there, and comes out the same.
 */
#include <samara.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { bodies = 3, frames = 24 };

static char error[256];

static void check(samara_status status) {
    if (status == SAMARA_OK) return;
    fprintf(stderr, "fall: %s\n", error);
    exit(1);
}

static samara_simulation* make_simulation(const samara_body* body) {
    samara_settings settings;
    samara_simulation* simulation;
    samara_body_group group;

    check(samara_default_settings(&settings, sizeof settings, error, sizeof error));
    settings.seed = 7;
    check(samara_simulation_create(&settings, &simulation, error, sizeof error));

    check(samara_default_body_group(&group, sizeof group, error, sizeof error));
    group.count = bodies;
    group.density = 1200.0;
    group.spread_position[0] = 0.1;
    group.spread_angle = 0.5;
    if (!samara_body_has_tables(body)) {
        group.loads = SAMARA_LOADS_COEFFICIENTS;
        group.lift_coefficient = 1.0;
    }
    check(samara_simulation_add(simulation, body, &group, NULL, error, sizeof error));
    return simulation;
}

/* Plays frames first ... last, and leaves the poses of the last one in `poses`. */
static void play(samara_simulation* simulation, int first, int last, samara_pose* poses, int print) {
    int frame, i;
    for (frame = first; frame <= last; ++frame) {
        check(samara_advance_to(simulation, frame / 24.0, error, sizeof error));
        check(samara_get_poses(simulation, 0, bodies, poses, 0, error, sizeof error));
        for (i = 0; print && i < bodies; ++i) {
            const double* p = poses[i].position;
            const double* q = poses[i].orientation;
            printf("%.4f s  body %d  at %8.4f %8.4f %8.4f m  turned %7.4f %7.4f %7.4f %7.4f\n",
                   samara_simulation_time(simulation), i, p[0], p[1], p[2], q[0], q[1], q[2], q[3]);
        }
    }
}

int main(int count, char** words) {
    samara_body* body;
    samara_simulation* simulation;
    samara_pose once[bodies], again[bodies];
    samara_report report;
    void* state;
    size_t size;

    if (count != 2) {
        fprintf(stderr, "Usage: fall NAME.body.h5\n");
        return 1;
    }
    if (samara_api_version() < SAMARA_API_VERSION) {
        fprintf(stderr, "fall: the samara library %s is older than samara.h\n", samara_version());
        return 1;
    }
    check(samara_body_load(words[1], &body, error, sizeof error));
    printf("%s: %.4g cm^3, %zu triangles\n", samara_body_name(body), 1e6 * samara_body_volume(body),
           samara_body_triangle_count(body));
    simulation = make_simulation(body);
    samara_body_free(body); /* the simulation has what it needs */

    play(simulation, 0, frames / 2, once, 1);
    size = samara_state_size(simulation);
    state = malloc(size);
    if (state == NULL) return 1;
    check(samara_get_state(simulation, state, size, error, sizeof error));
    play(simulation, frames / 2 + 1, frames, once, 1);

    check(samara_set_state(simulation, state, size, error, sizeof error));
    free(state);
    play(simulation, frames / 2 + 1, frames, again, 0);
    if (memcmp(once, again, sizeof once) != 0) {
        fprintf(stderr, "fall: the second half did not come out the same\n");
        return 1;
    }

    report.size = sizeof report;
    check(samara_get_report(simulation, &report, error, sizeof error));
    printf("%llu steps of %llu substeps, Reynolds numbers up to %.0f\n", (unsigned long long)report.steps,
           (unsigned long long)report.substeps, report.highest_reynolds_number);
    samara_simulation_free(simulation);
    return 0;
}

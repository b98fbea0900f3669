/* What falls in docs/examples/bullet_fall.cpp: bodies let go in water. */
#ifndef WATER_H
#define WATER_H

#include <math.h>
#include <samara.h>
#include <stdio.h>
#include <stdlib.h>

static char error[512];

static void check(samara_status status) {
    if (status == SAMARA_OK) return;
    fprintf(stderr, "%s\n", error);
    exit(1);
}

/* Water for one body or more of the same shape, each of its own density, in samara's hands so far. */
static samara_simulation* water(const samara_body* body, double step, int turbulent, const double* densities,
                                int count) {
    samara_settings settings;
    samara_simulation* simulation;
    samara_body_group group;
    char name[16];
    int i;
    check(samara_default_settings(&settings, sizeof settings, error, sizeof error));
    settings.step = step;
    check(samara_simulation_create(&settings, &simulation, error, sizeof error));
    for (i = 0; i < count; ++i) {
        check(samara_default_body_group(&group, sizeof group, error, sizeof error));
        snprintf(name, sizeof name, "link-%d", i);
        group.name = name;
        group.density = densities[i];
        if (!samara_body_has_tables(body)) group.loads = SAMARA_LOADS_COEFFICIENTS;
        if (!turbulent) group.turbulence = SAMARA_TURBULENCE_NONE;
        group.orientation[0] = 0.9;
        group.orientation[1] = 0.3;
        group.orientation[2] = 0.3;
        check(samara_simulation_add(simulation, body, &group, NULL, error, sizeof error));
    }
    return simulation;
}

/* How far a single body is from samara's own motion of it at a time, relative to the distance from the start.
 */
static double off_from_own_flight(const samara_body* body, double step, double density, double time,
                                  const double position[3]) {
    samara_simulation* own = water(body, step, 0, &density, 1);
    samara_pose flown;
    double off = 0.0, distance = 0.0;
    int i;
    check(samara_advance_to(own, time, error, sizeof error));
    check(samara_get_poses(own, 0, 1, &flown, 0, error, sizeof error));
    samara_simulation_free(own);
    for (i = 0; i < 3; ++i) {
        off += pow(position[i] - flown.position[i], 2);
        distance += pow(flown.position[i], 2);
    }
    return sqrt(off / distance);
}

#endif

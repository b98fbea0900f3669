/* Lets MuJoCo integrate bodies that fall in samara's water: a single one, beside samara's own flight of it,
 * and two on a hinge, one lighter than water.
 *
 *   cc -std=c99 mujoco_fall.c $(pkg-config --cflags --libs samara) -lmujoco -lm -o mujoco-fall
 *   ./mujoco-fall ellipsoid.body.h5
 *
 * MuJoCo 2.2. In each step samara gives the fluid's wrench, added inertia and damping of each body; the two
 * matrices go into MuJoCo's mass matrix, so that its joints and contacts feel the fluid's inertia too.
 */
#include <mujoco/mujoco.h>
#include <string.h>

#include "water.h"

enum { most_dofs = 16 };

/* Bodies in both: number i of samara is body i + 1 of MuJoCo, with the shape's origin and axes. */
typedef struct host {
    samara_simulation* fluid;
    mjModel* model;
    mjData* data;
    int links;
    int steps; /* taken so far */
} host;

/* ---- The coupling -------------------------------------------------------------------------------------- */

/* The Jacobian of a body's centre of mass (angular, then linear), its velocity, and its acceleration where
 * the joints' own is zero. Needs mj_comVel and mj_rnePostConstraint. */
static void motion_of(const host* h, int body, double jacobian[6][most_dofs], double velocity[6],
                      double acceleration[6]) {
    const int dofs = h->model->nv;
    mjtNum moving[3 * most_dofs], turning[3 * most_dofs];
    int row, i;
    mj_jacBodyCom(h->model, h->data, moving, turning, body);
    for (row = 0; row < 6; ++row) {
        velocity[row] = 0.0;
        for (i = 0; i < dofs; ++i) {
            jacobian[row][i] = row < 3 ? turning[row * dofs + i] : moving[(row - 3) * dofs + i];
            velocity[row] += jacobian[row][i] * h->data->qvel[i];
        }
    }
    mj_objectAcceleration(h->model, h->data, mjOBJ_BODY, body, acceleration, 0);
    for (i = 0; i < 3; ++i) acceleration[3 + i] += h->model->opt.gravity[i]; /* MuJoCo lets the world rise */
}

/* Tells samara where a body is, and adds what the fluid does to it: J^T (A + h D) J to the mass matrix, and
 * J^T (wrench - A J' q') to the forces. */
static void sample_fluid(host* h, int link, double matrix[most_dofs][most_dofs]) {
    const int dofs = h->model->nv, body = link + 1;
    const double step = h->model->opt.timestep;
    double jacobian[6][most_dofs], velocity[6], acceleration[6], force[6];
    samara_pose pose;
    samara_fluid_load load;
    int i, k, row, column;

    motion_of(h, body, jacobian, velocity, acceleration);
    memcpy(pose.position, h->data->xpos + 3 * body, sizeof pose.position);
    memcpy(pose.orientation, h->data->xquat + 4 * body, sizeof pose.orientation);
    memcpy(pose.angular_velocity, velocity, sizeof pose.angular_velocity);
    memcpy(pose.velocity, velocity + 3, sizeof pose.velocity);
    check(samara_set_poses(h->fluid, (size_t)link, 1, &pose, 0, error, sizeof error));
    check(samara_get_fluid_load(h->fluid, (size_t)link, &load, error, sizeof error));

    for (row = 0; row < 6; ++row) {
        force[row] = load.wrench[row];
        for (column = 0; column < 6; ++column) {
            const double added = load.added_inertia[6 * row + column];
            const double whole = added + step * load.damping[6 * row + column];
            force[row] -= added * acceleration[column];
            for (i = 0; i < dofs; ++i) {
                for (k = 0; k < dofs; ++k) matrix[i][k] += jacobian[row][i] * whole * jacobian[column][k];
            }
        }
        for (i = 0; i < dofs; ++i) h->data->qfrc_applied[i] += jacobian[row][i] * force[row];
    }
}

/* One step of MuJoCo, as mj_step has it, with the fluid's part of the mass matrix. MuJoCo keeps the entries
 * of each joint with itself and those above it; the fluid's are no others. */
static void step_host(host* h) {
    mjModel* m = h->model;
    mjData* d = h->data;
    double matrix[most_dofs][most_dofs] = {{0.0}};
    int i, k, entry;

    mj_kinematics(m, d);
    mj_comPos(m, d);
    mj_comVel(m, d);
    mj_crb(m, d);
    mju_zero(d->qacc, m->nv);
    mj_rnePostConstraint(m, d);
    mju_zero(d->qfrc_applied, m->nv);
    for (i = 0; i < h->links; ++i) sample_fluid(h, i, matrix);
    for (i = 0; i < m->nv; ++i) {
        entry = m->dof_Madr[i];
        for (k = i; k >= 0; k = m->dof_parentid[k]) d->qM[entry++] += 0.5 * (matrix[i][k] + matrix[k][i]);
    }
    mj_factorM(m, d);
    mj_collision(m, d);
    mj_makeConstraint(m, d);
    mj_transmission(m, d);
    mj_projectConstraint(m, d);
    mj_fwdVelocity(m, d);
    mj_fwdActuation(m, d);
    mj_fwdAcceleration(m, d);
    mj_fwdConstraint(m, d);
    mj_Euler(m, d);
    /* Turbulence and wind go on; where samara took the bodies meanwhile is of no account. */
    check(samara_advance_to(h->fluid, ++h->steps * m->opt.timestep, error, sizeof error));
}

/* ---- What falls ---------------------------------------------------------------------------------------- */

/* How one link is written in MuJoCo's XML: each the child of the one before, on a hinge between them. */
static int write_link(char* text, size_t size, const samara_simulation* fluid, int link, double gap) {
    samara_mass_properties own;
    const double* c = own.center_of_mass;
    const double* j = own.inertia;
    char joint[160] = "<freejoint/>";
    check(samara_get_mass_properties(fluid, (size_t)link, &own, error, sizeof error));
    if (link > 0) snprintf(joint, sizeof joint, "<joint axis='1 0 0' pos='0 0 %.9g'/>", -0.5 * gap);
    return snprintf(text, size,
                    "<body pos='0 0 %.9g'>%s<inertial pos='%.17g %.17g %.17g' mass='%.17g' "
                    "fullinertia='%.17g %.17g %.17g %.17g %.17g %.17g'/>",
                    link > 0 ? gap : 0.0, joint, c[0], c[1], c[2], own.mass, j[0], j[4], j[8], j[1], j[2],
                    j[5]);
}

static mjModel* model_of(const samara_simulation* fluid, double step, int links, double gap) {
    static const char file[] = "links.xml";
    char xml[4096], reason[512];
    size_t length;
    mjVFS* folder = malloc(sizeof *folder);
    mjModel* model;
    int i;
    length = (size_t)snprintf(xml, sizeof xml,
                              "<mujoco><option timestep='%.17g' gravity='0 0 -9.81'/><worldbody>", step);
    for (i = 0; i < links; ++i) {
        length += (size_t)write_link(xml + length, sizeof xml - length, fluid, i, gap);
    }
    for (i = 0; i < links; ++i) length += (size_t)snprintf(xml + length, sizeof xml - length, "</body>");
    length += (size_t)snprintf(xml + length, sizeof xml - length, "</worldbody></mujoco>");
    if (folder == NULL) exit(1);
    mj_defaultVFS(folder);
    mj_makeEmptyFileVFS(folder, file, (int)length);
    memcpy(folder->filedata[mj_findFileVFS(folder, file)], xml, length);
    model = mj_loadXML(file, folder, reason, sizeof reason);
    mj_deleteVFS(folder);
    free(folder);
    if (model != NULL) return model;
    fprintf(stderr, "mujoco-fall: %s\n", reason);
    exit(1);
}

static host make_host(const samara_body* body, double step, int turbulent, const double* densities, int links,
                      double gap) {
    host h;
    samara_pose start;
    h.fluid = water(body, step, turbulent, densities, links);
    h.links = links;
    h.steps = 0;
    h.model = model_of(h.fluid, step, links, gap);
    h.data = mj_makeData(h.model);
    check(samara_get_poses(h.fluid, 0, 1, &start, 0, error, sizeof error));
    memcpy(h.data->qpos, start.position, sizeof start.position);
    memcpy(h.data->qpos + 3, start.orientation, sizeof start.orientation);
    return h;
}

static void free_host(host* h) {
    mj_deleteData(h->data);
    mj_deleteModel(h->model);
    samara_simulation_free(h->fluid);
}

/* How far a single body that MuJoCo integrates is from samara's own flight after a second, over the way. */
static double difference(const samara_body* body, double step) {
    const double density = 1200.0;
    host h = make_host(body, step, 0, &density, 1, 0.0);
    const int steps = (int)(1.0 / step + 0.5);
    double off;
    int i;
    for (i = 0; i < steps; ++i) step_host(&h);
    off = off_from_own_flight(body, step, density, steps * step, h.data->qpos);
    free_host(&h);
    return off;
}

int main(int count, char** words) {
    const double steps[] = {0.004, 0.002, 0.001, 0.0005};
    const double densities[] = {1500.0, 900.0};
    samara_body* body;
    host pair;
    int i;

    if (count != 2) {
        fprintf(stderr, "Usage: mujoco-fall NAME.body.h5\n");
        return 1;
    }
    check(samara_body_load(words[1], &body, error, sizeof error));

    printf("A single body after 1 s, MuJoCo beside samara:\n");
    for (i = 0; i < 4; ++i)
        printf("  step %6.4f s  off by %7.4f %%\n", steps[i], 100.0 * difference(body, steps[i]));

    printf("Two on a hinge, 1500 and 900 kg/m^3, with turbulence:\n");
    pair = make_host(body, 0.002, 1, densities, 2, 0.1);
    for (i = 1; i <= 2500; ++i) {
        step_host(&pair);
        if (i % 500 != 0) continue;
        printf("  %3.1f s  heights %7.3f %7.3f m  hinge %7.1f degrees  speed %6.3f m/s\n", pair.data->time,
               pair.data->xpos[5], pair.data->xpos[8], pair.data->qpos[7] * 57.29578,
               mju_norm3(pair.data->qvel));
    }
    free_host(&pair);
    samara_body_free(body);
    return 0;
}

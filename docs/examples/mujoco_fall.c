/* Bodies that MuJoCo 2.2 integrates in samara's water: a program of MuJoCo alone. The fluid stands in the
 * model's XML, and libsamara-mujoco.so, which is linked, gives it to the bodies.
 *
 *   cc -std=c99 mujoco_fall.c $(pkg-config --libs samara) -Wl,--no-as-needed -lsamara-mujoco -lmujoco -o
 * mujoco-fall
 *   ./mujoco-fall mujoco_fall.xml        where ellipsoid.body.h5 is
 */
#include <mujoco/mujoco.h>
#include <stdio.h>

int main(int count, char** words) {
    char reason[512] = "usage: mujoco-fall MODEL.xml";
    mjModel* model = count == 2 ? mj_loadXML(words[1], NULL, reason, sizeof reason) : NULL;
    mjData* data;
    int second;
    if (model == NULL) {
        fprintf(stderr, "%s\n", reason);
        return 1;
    }
    data = mj_makeData(model);
    for (second = 1; second <= 5; ++second) {
        while (data->time < second - 0.5 * model->opt.timestep) mj_step(model, data);
        printf("%d s  heights %7.3f %7.3f m  hinge %7.1f degrees  speed %6.3f m/s\n", second, data->xpos[5],
               data->xpos[8], data->qpos[7] * 57.29578, mju_norm3(data->qvel));
    }
    mj_deleteData(data);
    mj_deleteModel(model);
    return 0;
}

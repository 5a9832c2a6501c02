/* What MuJoCo keeps in structs, for a caller that knows no layouts: mujoco_recorder.py. */
#include <mujoco/mujoco.h>

double* places(mjData* data) { return data->qpos; }
double* speeds(mjData* data) { return data->qvel; }

/* Rows of 12: bodies 1 and 2, place, normal from 1 to 2, distance, force on 2 in N; world frame. Returns how many. */
int points(const mjModel* model, mjData* data, double* row) {
  int rows = 0;
  for (int k = 0; k < data->ncon; ++k) {
    const mjContact* c = data->contact + k;
    mjtNum force[6];
    if (c->exclude || c->efc_address < 0) continue;
    mj_contactForce(model, data, k, force);
    row[0] = model->geom_bodyid[c->geom1];
    row[1] = model->geom_bodyid[c->geom2];
    row[8] = c->dist;
    for (int i = 0; i < 3; ++i) {
      row[2 + i] = c->pos[i];
      row[5 + i] = c->frame[i];
      row[9 + i] = force[0] * c->frame[i] + force[1] * c->frame[3 + i] + force[2] * c->frame[6 + i];
    }
    row += 12;
    ++rows;
  }
  return rows;
}

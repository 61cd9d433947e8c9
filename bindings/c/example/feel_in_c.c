/* A textured scene felt by a finger that strokes it: build with `cc feel_in_c.c -lasperity_feel`, run with the scene
 * that `asperity paint` or `asperity register` wrote, or without: a plate of 60 x 20 mm. */
#include <stdio.h>

#include "asperity_feel.h"

int main(int argc, char **argv) {
  static const double corners_m[] = {0, 0, 0, 0.06, 0, 0, 0.06, 0.02, 0, 0, 0.02, 0};
  static const unsigned triangles[] = {0, 1, 2, 0, 2, 3};
  asperity_scene *scene = NULL;
  asperity_feel *feel = NULL;
  asperity_motion motion;
  asperity_touch touch;
  double peak_N = 0.0;
  int step;
  asperity_status status =
      argc > 1 ? asperity_scene_read(argv[1], &scene) : asperity_scene_from_mesh(corners_m, 4, triangles, 2, &scene);
  if (status == ASPERITY_OK) status = asperity_feel_create(scene, NULL, &feel);
  if (status != ASPERITY_OK) {
    fprintf(stderr, "%s: %s\n", asperity_status_text(status), asperity_last_error());
    return 1;
  }
  asperity_motion_init(&motion, sizeof motion);
  asperity_touch_init(&touch, sizeof touch);
  motion.dt_s = 1e-3;
  motion.velocity_mps[0] = 0.05;
  for (step = -100; step < 1000; ++step) { /* from above onto the plate, then along it, 1 mm deep */
    motion.position_m[0] = 0.005 + (step > 0 ? 0.05e-3 * step : 0.0);
    motion.position_m[1] = 0.01;
    motion.position_m[2] = step < 0 ? -2e-5 * step - 1e-3 : -1e-3;
    asperity_feel_step(feel, &motion, &touch);
    if (touch.force_N[2] > peak_N) peak_N = touch.force_N[2];
  }
  printf("force at most %.2f N, at the end %.2f %.2f %.2f N\n", peak_N, touch.force_N[0], touch.force_N[1],
         touch.force_N[2]);
  asperity_feel_free(feel);
  asperity_scene_free(scene);
  return 0;
}

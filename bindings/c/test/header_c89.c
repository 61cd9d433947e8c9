/* asperity_feel.h by itself, twice, as the first thing of a program in C89: compiled with -std=c89 -pedantic-errors.
 * PLANTED is a comment of C99, by which the test of this test fails. */
#include <asperity_feel.h>

#ifdef PLANTED
static int planted;  // of C99
#endif

int main(void) {
  asperity_motion motion;
  asperity_touch touch;
  asperity_motion_init(&motion, sizeof motion);
  asperity_touch_init(&touch, sizeof touch);
  return asperity_feel_step(NULL, &motion, &touch) == ASPERITY_BAD_ARGUMENT ? 0 : 1;
}

/* asperity_feel.h: textured surfaces felt by a point or a ball, for programs in C and in languages that call C.
 *
 *   asperity_scene *scene;
 *   asperity_feel *feel;
 *   if (asperity_scene_read("cup.scene.json", &scene) != ASPERITY_OK ||
 *       asperity_feel_create(scene, NULL, &feel) != ASPERITY_OK)
 *     fputs(asperity_last_error(), stderr);
 *   ...
 *   asperity_feel_step(feel, &motion, &touch);     a thousand times a second: touch.force_N
 *
 * Lengths are metres, forces newtons, times seconds, in the scene's world frame (right-handed). C89.
 *
 * Threads. asperity_feel_step, _steps and _reset of one asperity_feel belong to one thread at a time; several
 * asperity_feel may be stepped at once, also of one scene. asperity_feel_update may be called from any other thread
 * meanwhile. A scene may be used by one thread at a time; what has been made of it keeps nothing of it.
 *
 * Real time. asperity_feel_step, _steps and _reset neither allocate, lock, throw, print nor wait. All else does.
 *
 * Compatibility. Every 1.x accepts programs compiled against an earlier 1.x. Structures begin with their size, which
 * the ..._init functions set; a later version only adds fields at their end.
 */
#ifndef ASPERITY_FEEL_H
#define ASPERITY_FEEL_H

#include <stddef.h>

#if defined(_WIN32)
#define ASPERITY_FEEL_API __declspec(dllimport)
#elif defined(__GNUC__)
#define ASPERITY_FEEL_API __attribute__((visibility("default")))
#else
#define ASPERITY_FEEL_API
#endif

#ifdef __cplusplus
extern "C" {
#endif

#define ASPERITY_FEEL_MAJOR 1
#define ASPERITY_FEEL_MINOR 2

/* What became of a call. On anything but ASPERITY_OK nothing was changed and no array was written; handles that were to
 * be written are NULL, counts are 0, and asperity_last_error() states why. */
typedef enum asperity_status {
  ASPERITY_OK = 0,
  ASPERITY_BAD_ARGUMENT = 1, /* NULL, an index or number out of range, an unknown name */
  ASPERITY_BAD_FILE = 2,     /* cannot be read, or does not hold what it should; or the scene cannot be rendered */
  ASPERITY_NO_MEMORY = 3,
  ASPERITY_INTERNAL = 4,               /* a fault of this library */
  ASPERITY_STATUS_LARGEST = 0x7fffffff /* none: later versions may have others */
} asperity_status;

/* The status in words; never NULL. */
ASPERITY_FEEL_API const char *asperity_status_text(asperity_status status);
/* Why the last call of this thread that did not end with ASPERITY_OK did not; UTF-8, at most 1023 bytes, valid until
 * the thread's next such call. Empty if there was none. */
ASPERITY_FEEL_API const char *asperity_last_error(void);
/* "1.2 (asperity 0.2.0)" */
ASPERITY_FEEL_API const char *asperity_feel_version(void);

/* --- Scenes ------------------------------------------------------------------------------------------------------ */

/* Objects with textures and materials. */
typedef struct asperity_scene asperity_scene;

/* A *.scene.json with all files that it names, or a mesh (OBJ, PLY, STL, OFF, glTF), in metres and without textures.
 * ASPERITY_BAD_FILE for a mesh that does not state its unit (glTF does) and would be larger than 5 m or smaller than
 * 1 mm: its unit is probably another, which the next function states. */
ASPERITY_FEEL_API asperity_status asperity_scene_read(const char *path, asperity_scene **scene);
/* The same with the length of the mesh's unit, m: 1e-9 to 1000, 0.001 for a mesh in millimetres, of any size. A
 * *.scene.json states its unit: another one is ASPERITY_BAD_ARGUMENT. Since 1.2. */
ASPERITY_FEEL_API asperity_status asperity_scene_read_with_unit(const char *path, double unit_m,
                                                                asperity_scene **scene);
/* One object of `vertex_count` points (x, y, z each) and `triangle_count` triangles (three indices each, from 0,
 * counter-clockwise seen from outside). Copied. Within 1e6 m of the origin, and at least 1e-9 m large. */
ASPERITY_FEEL_API asperity_status asperity_scene_from_mesh(const double *vertices_m, size_t vertex_count,
                                                           const unsigned *triangles, size_t triangle_count,
                                                           asperity_scene **scene);
/* Does nothing with NULL. */
ASPERITY_FEEL_API void asperity_scene_free(asperity_scene *scene);

ASPERITY_FEEL_API size_t asperity_scene_object_count(const asperity_scene *scene);
/* The file that an object's mesh was read from, "" for one of asperity_scene_from_mesh; NULL for an object that there
 * is not. Valid until the scene is changed. */
ASPERITY_FEEL_API const char *asperity_scene_object_name(const asperity_scene *scene, size_t object);
/* An object's mesh in its own frame, to show it: `*vertex_count` points (x, y, z each) and `*triangle_count` triangles
 * (three indices each), of which at most vertex_capacity and triangle_capacity are written. With an array NULL only its
 * count is set. Since 1.1. */
ASPERITY_FEEL_API asperity_status asperity_scene_mesh(const asperity_scene *scene, size_t object, double *vertices_m,
                                                      size_t vertex_capacity, size_t *vertex_count, unsigned *triangles,
                                                      size_t triangle_capacity, size_t *triangle_count);
/* An object's pose in the scene's world frame, as asperity_scene_set_pose sets it. Since 1.1. */
ASPERITY_FEEL_API asperity_status asperity_scene_pose(const asperity_scene *scene, size_t object, double position_m[3],
                                                      double rotation_wxyz[4]);
/* An object's pose: its origin, and its orientation as a quaternion w, x, y, z (normalised here). */
ASPERITY_FEEL_API asperity_status asperity_scene_set_pose(asperity_scene *scene, size_t object,
                                                          const double position_m[3], const double rotation_wxyz[4]);
/* Paints a *.texture.json along the shortest path over the surface through the points nearest to `points_m` (x, y, z
 * each, at least two, in the mesh's frame): onto the triangles within `half_width_m` of it, or for 0 onto those that it
 * touches and their neighbours. `index` from 0 names it: a texture of the same index of this object is replaced. The
 * texture's x is the distance along the path, 0 at the first point. In the profile that the texture was fitted to, x =
 * 0 is the beginning of the fitted window: at s = texture.start_m of the result.json of `asperity process`, at the
 * height extra.fit.first_sample of a *.texture.json of `asperity texture fit`. */
ASPERITY_FEEL_API asperity_status asperity_scene_paint(asperity_scene *scene, size_t object, const char *texture_path,
                                                       const double *points_m, size_t point_count, double half_width_m,
                                                       int index);
/* Puts another texture in the place of the one of that index of the first object; it keeps its own scale. */
ASPERITY_FEEL_API asperity_status asperity_scene_set_texture(asperity_scene *scene, int index,
                                                             const char *texture_path);
/* Where neither map nor texture knows better. */
ASPERITY_FEEL_API asperity_status asperity_scene_set_stiffness(asperity_scene *scene, double stiffness_N_per_m);
/* `sliding` the coefficient of sliding friction, `static_ratio` (from 1) that of sticking over it. */
ASPERITY_FEEL_API asperity_status asperity_scene_set_friction(asperity_scene *scene, double sliding,
                                                              double static_ratio);

/* --- Settings ---------------------------------------------------------------------------------------------------- */

/* How a scene is rendered: names and values are those of `asperity feel --set render.NAME=VALUE` without "render.",
 * "tip_radius_m", "friction", "texture.model" and so on; and "rate_Hz", at which steps will be made. */
typedef struct asperity_settings asperity_settings;

/* The defaults. */
ASPERITY_FEEL_API asperity_status asperity_settings_create(asperity_settings **settings);
ASPERITY_FEEL_API void asperity_settings_free(asperity_settings *settings);
ASPERITY_FEEL_API asperity_status asperity_settings_set(asperity_settings *settings, const char *name,
                                                        const char *value);
/* How many there are, and of each its name and what it means with its unit; NULL beyond them. Static. */
ASPERITY_FEEL_API size_t asperity_settings_count(void);
ASPERITY_FEEL_API const char *asperity_settings_name(size_t setting);
ASPERITY_FEEL_API const char *asperity_settings_help(size_t setting);

/* --- Feeling ----------------------------------------------------------------------------------------------------- */

/* One tip with its state from step to step. */
typedef struct asperity_feel asperity_feel;

/* `settings` may be NULL: the defaults. */
ASPERITY_FEEL_API asperity_status asperity_feel_create(const asperity_scene *scene, const asperity_settings *settings,
                                                       asperity_feel **feel);
ASPERITY_FEEL_API void asperity_feel_free(asperity_feel *feel);
/* The next step renders this. Materials and textures fade over "texture.cross_fade_s"; meshes, poses and the tip's
 * radius act at once, so that the force may jump where the tip is in contact. */
ASPERITY_FEEL_API asperity_status asperity_feel_update(asperity_feel *feel, const asperity_scene *scene,
                                                       const asperity_settings *settings);

/* The tip's motion, the input of a step. */
typedef struct asperity_motion {
  size_t size;            /* sizeof(asperity_motion) */
  double position_m[3];   /* of the tip's centre */
  double velocity_mps[3]; /* of the tip's centre */
  double dt_s;            /* since the step before */
} asperity_motion;

/* What a step gives. */
typedef struct asperity_touch {
  size_t size;       /* sizeof(asperity_touch) */
  double force_N[3]; /* on the hand: the sum of the next three */
  double contact_N[3];
  double texture_N[3];
  double friction_N[3];
  double proxy_m[3];         /* where the tip's centre would be on a rigid surface */
  double texture_height_m;   /* at the place that is touched; 0 where there is none */
  double vibration_N;        /* the force along the contact and the motion as one number, its static part too: it needs
                                a high-pass before a voice coil or a motor, as the functions below have */
  double point_m[3];         /* on the surface, of the strongest contact; 0 where nothing is touched */
  double normal[3];          /* unit, from the surface towards the tip; 0 where nothing is touched */
  double barycentric[3];     /* of the point in its triangle */
  unsigned object, triangle; /* of the point; ASPERITY_NONE where nothing is touched */
  int touching;              /* 1 or 0, as those that follow */
  int sticking;              /* friction holds the tip */
  int starts_inside;         /* no force until the tip has left the object */
} asperity_touch;

#define ASPERITY_NONE 0xFFFFFFFFu

/* Zero with the size set. `size` is sizeof of what the program was compiled with. */
ASPERITY_FEEL_API void asperity_motion_init(asperity_motion *motion, size_t size);
ASPERITY_FEEL_API void asperity_touch_init(asperity_touch *touch, size_t size);

/* One step of the loop. A motion that is not finite gives a force of zero. Real time: yes. Ends with
 * ASPERITY_BAD_ARGUMENT only for NULL and for a size that no version has; asperity_last_error() says nothing of it. */
ASPERITY_FEEL_API asperity_status asperity_feel_step(asperity_feel *feel, const asperity_motion *motion,
                                                     asperity_touch *touch);
/* `count` steps one after the other: motions[i] gives touches[i], all with the size of the first of each. */
ASPERITY_FEEL_API asperity_status asperity_feel_steps(asperity_feel *feel, const asperity_motion *motions,
                                                      asperity_touch *touches, size_t count);
/* Clears the state: the tip was lifted and set down elsewhere. Real time: yes. */
ASPERITY_FEEL_API void asperity_feel_reset(asperity_feel *feel);

/* --- Vibration --------------------------------------------------------------------------------------------------- */

/* The samples of a sound of forces (vibration_N of steps at `force_rate_Hz`, 100 to 4000): `*written` of them, at most
 * `capacity`, from -1 to 1, filtered for a voice coil, at `sample_rate_Hz` (8000 to 192000). `volume` is 0 to 1;
 * `full_scale_N` (0.001 to 1000) is the force that is 1 at volume 1. Of faster steps take the mean of each few.
 * With `samples` NULL only `*written` is set: how many there would be. Not real time. */
ASPERITY_FEEL_API asperity_status asperity_vibration_samples(const double *force_N, size_t count, double force_rate_Hz,
                                                             double sample_rate_Hz, double volume, double full_scale_N,
                                                             float *samples, size_t capacity, size_t *written);
/* From 0 to 1, how strongly a gamepad's motor turns for the last forces, count of them: the RMS of their deviation from
 * their straight line over `full_scale_N`, so that a force that rests or grows steadily gives 0. It has no memory: give
 * it at least 50 ms of forces, since of fewer it loses slow vibration, too. A running loop takes asperity_rumble
 * instead. Real time: yes. */
ASPERITY_FEEL_API double asperity_vibration_rumble(const double *force_N, size_t count, double full_scale_N);

/* The two motors of a gamepad: the force is high-passed at 20 Hz (second-order Butterworth: what rests or moves slowly
 * is no vibration) and split at 100 Hz for the heavy, slow motor and the light, fast one. Belongs to one thread at a
 * time. Since 1.2. */
typedef struct asperity_rumble asperity_rumble;

/* Of forces at `force_rate_Hz` (400 to 20000); `full_scale_N` (0.001 to 1000) is the amplitude that is 1. */
ASPERITY_FEEL_API asperity_status asperity_rumble_create(double force_rate_Hz, double full_scale_N,
                                                         asperity_rumble **rumble);
ASPERITY_FEEL_API void asperity_rumble_free(asperity_rumble *rumble);
/* One force (vibration_N of a step). One that is not finite is ignored; beyond 1000 N
 * either way it counts as that. Real time: yes. */
ASPERITY_FEEL_API void asperity_rumble_add(asperity_rumble *rumble, double force_N);
/* The levels of both motors since the last call, 0 to 1: sqrt(2) times the RMS of each band over `full_scale_N`; 0 if
 * no force was added. Call it 20 to 100 times a second. Real time: yes. */
ASPERITY_FEEL_API void asperity_rumble_take(asperity_rumble *rumble, double *slow, double *fast);
/* The tip was lifted or set down elsewhere: the next force is taken as if it had been there for ever. Real time: yes.
 */
ASPERITY_FEEL_API void asperity_rumble_reset(asperity_rumble *rumble);

#ifdef __cplusplus
}
#endif

#endif /* ASPERITY_FEEL_H */

#include "asperity/verdict/verdict_codes.h"

#include <algorithm>
#include <iterator>

#include "asperity/base/error.h"

namespace asperity {

namespace {

constexpr auto kInvalid = Severity::kInvalid;
constexpr auto kLimited = Severity::kLimited;
constexpr auto kNote = Severity::kNote;

// One list for all commands, so that a code means the same everywhere. Sorted by what is judged.
constexpr VerdictCode kCodes[] = {
    // A scan: what the recording and its calibration allow (judge_scan.h).
    {"uncalibrated", kInvalid, "calibrate the probe with `asperity calibrate` and record again"},
    {"wrong_unit", kInvalid, "check the unit of the accelerometer's calibration, and that the sensor works"},
    {"wrong_frame", kInvalid,
     "check the signs and axes of the accelerometer's calibration, of gravity and of the tracker's world"},
    {"latency_off", kInvalid, "calibrate the latency with `asperity calibrate latency`"},
    {"clocks_drift", kInvalid, "stamp both streams by one clock, or import with the setting mapping.clocks=separate"},
    {"scale_disagrees", kInvalid,
     "check the size of the printed markers, the camera's calibration, units, and the accelerometer's scale"},
    {"scale_doubtful", kLimited, "check the size of the printed markers and the accelerometer's scale"},
    {"motions_disagree", kInvalid,
     "check axes, signs and handedness of tracker and accelerometer, their clocks, and that each channel works"},
    {"rotations_disagree", kInvalid, "check the gyroscope's axes, signs and unit, and its calibration"},
    {"axes_unseen", kLimited, "check axes and handedness of the tracker's world, or move the probe more"},
    {"tracker_noise", kInvalid,
     "calibrate the tracker with `asperity calibrate tracker`, and check what moves its cameras"},
    {"poses_disagree", kInvalid, "check the calibration's frames and units, the latency and the clocks"},
    {"poses_outlying", kLimited, "check the tracker's calibration, and what shakes or hides the markers"},
    {"tracker_repeats", kInvalid, "check that the tracker's export has all of its poses"},
    {"clipped", kInvalid, "scan slower or with less force, or use an accelerometer with a wider range"},
    {"peaks_clipped", kLimited, "scan slower or with less force, or use an accelerometer with a wider range"},
    {"accel_filtered", kLimited,
     "switch off the sensor's low-pass and any averaging, or set them above the surface's vibrations; if there are "
     "none, "
     "calibrate the accelerometer again: its stated noise is too large"},
    {"rows_lost", kInvalid, "check the connection and the file"},
    {"changed_bytes", kLimited,
     "save the rows that are whole with `asperity recover`; if it was you who changed the file, remove checksums.txt"},
    {"little_overlap", kInvalid, "check that both streams have one clock, and record them together"},
    {"tracker_gap", kInvalid, "keep the markers in view, or use the method `fused`"},
    {"spikes", kInvalid, "check the probe's cable and power, or use the method `fused`"},
    {"object_unseen", kInvalid, "keep the markers on the object in view, or process with the setting reference=world"},
    {"object_hidden", kLimited, "keep the markers on the object in view"},
    {"object_moved", kNote, ""},
    // A scan: what was measured.
    {"no_profile", kInvalid, "scan one stroke along the surface in steady contact"},
    {"nothing_touched", kInvalid, "scan with the tip in contact with the surface"},
    {"not_moved", kInvalid, "move the tip along the surface while it touches"},
    {"little_coverage", kInvalid, "keep the tip in contact along the stroke"},
    {"below_noise", kInvalid, "scan slower, or use a probe with less noise"},
    {"length_disagrees", kInvalid, "check the calibration of the tip and of the latency, or use the method `fused`"},
    {"positions_uncertain", kInvalid,
     "scan a shorter stroke, press less, or let the force rise along the stroke, which shows how soft the object is"},
    {"positions_doubtful", kLimited,
     "scan a shorter stroke, press less, or let the force rise along the stroke, which shows how soft the object is"},
    {"normals_doubtful", kInvalid,
     "hold the probe within 45° of the normal, scan with a steady force, and check the calibration of the tip"},
    {"error_unknown", kInvalid, "use the method `fused`"},
    {"noisy_texture", kLimited, "scan slower, or use a probe with less noise"},
    {"vibration", kLimited, "switch off motors and fans nearby, and keep the sensor's cable away from mains cables"},
    {"may_be_hum", kLimited, "scan again at another speed: a pattern of the surface keeps its pitch"},
    {"force_clipped", kLimited, "press more lightly, or use a force sensor with a wider range"},
    {"stick_slip", kLimited, "press more lightly, or move faster"},
    {"contact_unknown", kLimited, "use a probe with a force sensor, or mark the contact as a segment"},
    {"no_roughness", kLimited, "scan a longer stroke"},
    {"no_texture", kLimited, "scan a longer stroke"},
    // A stroke without orientations (judge_stroke.h).
    {"vibration_is_noise", kInvalid, "record a stroke in contact, faster, or with a sensor of less noise"},
    {"contact_undetermined", kInvalid,
     "record positions or force too, or one stationary second before the stroke, or state the sensor's noise"},
    {"vibration_weak", kLimited, "stroke faster, or use a sensor of less noise"},
    {"force_zero_unseen", kLimited, "record a moment with the tip lifted off the surface"},
    {"lengths_undetermined", kLimited, "record positions too, or state the speed"},
    // Strokes over one line (merge_results.h).
    {"no_common_line", kInvalid, "scan along a guide, and merge strokes over one line alone"},
    {"passes_dependent", kInvalid, "merge strokes that were measured one by one"},
    {"stroke_invalid", kInvalid, "scan that stroke again, or leave it out"},
    {"passes_uncompared", kLimited, "merge strokes that share more of the line"},
    {"passes_left_out", kLimited, "check that they are of the same line, or leave them out"},
    {"passes_disagree", kLimited, "scan along a guide, so that the strokes pass over the same line"},
    // A registration.
    {"pose_ambiguous", kInvalid,
     "scan a path with a bend or several strokes in different directions and register them together, or give a guess "
     "and state how well it is known with refinement.guess_sigma_m and refinement.guess_sigma_deg"},
    {"pose_uncertain", kInvalid,
     "scan a path with bends in several directions, or several strokes, and register them together"},
    {"other_shape", kInvalid, "check that it is the right mesh, and its unit"},
    {"shape_unproven", kInvalid,
     "check that it is the right mesh, scan a longer path or several strokes with bends, and register them together"},
    {"shape_untested", kLimited, "check that it is the right mesh, or scan a longer path"},
    {"mirror_image_fits", kInvalid,
     "check that the mesh is not mirrored, scan a path with bends out of its plane, or several strokes, and register "
     "them "
     "together"},
    {"mesh_scale_differs", kInvalid, "check the unit of the mesh, that it is the right mesh, and the tracker's scale"},
    {"mesh_scale_doubtful", kLimited, "check the size of the mesh and of the printed markers"},
    {"mesh_scale_unknown", kNote, ""},
    {"rivals_unknown", kInvalid, "let poses elsewhere be compared (search.rivals)"},
    {"mesh_symmetric", kNote, ""},
    {"pose_misfit", kInvalid, "check that it is the right mesh, its unit, and the guess"},
    {"guess_contradicted", kInvalid,
     "check the guess, or state how well it is known with search.registration.guess_sigma_m and guess_sigma_deg, and "
     "the "
     "same of refinement"},
    {"guess_overruled", kLimited, "check the pose: the paths fit the mesh better there than near the guess"},
    {"mesh_misfit", kLimited,
     "check the mesh against the object, and state its error with search.registration.surface_error_m"},
    {"pose_not_converged", kInvalid, "give a guess nearer to the true pose"},
    {"off_mesh", kInvalid,
     "check that it is the right mesh, and the unit of the mesh, and leave out what was not on the object"},
    {"errors_assumed", kLimited, "add the positions' standard deviations in columns sigma_x_m,sigma_y_m,sigma_z_m"},
    {"pose_arbitrary", kInvalid, "give a guess of the pose, or scan in more directions"},
    {"no_path_on_mesh", kInvalid, "check the guess and the mesh's unit"},
    {"no_haptic_coordinates", kInvalid, "scan each connected part of the mesh by itself"},
    // An area of many strokes (judge_area.h).
    {"area_unregistered", kInvalid, "register the scans again, as their verdicts state"},
    {"strokes_disagree", kInvalid, "check the scans' verdicts and their poses on the mesh, and scan slower"},
    {"strokes_untied", kInvalid, "scan strokes that cross the others, or nearer to each other"},
    {"area_below_noise", kInvalid, "scan slower, or use a probe with less noise"},
    {"area_noise_unknown", kLimited, "use scans that state their noise, of the method `fused`"},
    {"strokes_differ", kLimited, "scan more strokes, or register them better"},
    {"area_sparse", kLimited, "scan strokes nearer to each other, or use the textures along them"},
    {"area_sigma_doubtful", kLimited, "scan more strokes that cross"},
    {"area_stretched", kLimited, "map a smaller or flatter part of the surface"},
    // A recording in progress.
    {"no_samples", kInvalid, "check the probe's address, cable and power"},
    {"never_touched", kInvalid, "touch the surface, or lower the force at which a touch begins"},
    {"nothing_stored", kInvalid, "begin a segment, or record without --auto"},
    {"samples_lost", kInvalid, "check the connection; a cable loses less than radio"},
    {"disk_too_slow", kInvalid, "record on another disk"},
    {"columns_missing", kInvalid, "begin to record after the probe has described itself"},
    {"no_poses", kInvalid, "check the camera, the markers' family and size, and the light"},
    {"markers_hidden", kInvalid, "keep the markers in view, lit and in focus"},
    {"source_failed", kInvalid, "check the connection and record again"},
    {"gravity_implausible", kInvalid, "use the calibration of this probe"},
    {"gravity_assumed", kLimited, "hold the probe still for two seconds at the beginning"},
    {"no_tracker", kLimited, "record with a tracker to measure positions"},
    {"no_calibration", kLimited, "give the probe's calibration to measure in SI units"},
    {"images_skipped", kLimited, "lower the camera's frame rate or resolution"},
    {"frames_not_kept", kLimited, "record on a faster disk, or without --frames"},
    {"probe_overruns", kLimited, "lower the probe's rate"},
    {"sensor_faults", kLimited, "check the wiring and supply of the probe's sensors"},
    {"source_interrupted", kLimited, "check the connection"},
    // A calibration.
    {"camera_not_converged", kInvalid, "take more images with the board tilted and in all parts of the image"},
    {"camera_misfit", kInvalid, "take sharper images of a flat board with the focus locked"},
    {"focal_length_uncertain", kLimited, "take more images with the board tilted by 20 to 45 degrees"},
    {"board_coverage", kLimited, "take images with the board in the corners of the image"},
    {"views_disagree", kNote, "check that the board does not bend and that the focus stays"},
    {"no_noise", kInvalid, "record the poses of a tracker that measures"},
    {"noise_not_gaussian", kLimited, "look at the figure; keep the light steady and the tags near and tilted"},
    {"body_moved", kLimited, "clamp the probe"},
    {"force_slope_unknown", kInvalid, "measure more forces over a wider range"},
    {"force_saturated", kInvalid, "leave those points out"},
    {"force_few_loads", kLimited, "add loads between them"},
    {"force_not_straight", kLimited, "use the sensor in the part of its range where it is straight"},
    {"force_outlier", kNote, "measure this point again, or leave it out"},
    {"counts_coarse", kNote, "use a converter with more bits"},
    {"gravity_missed", kInvalid, "hold the probe still, leaned on something"},
    {"accelerometer_uncertain", kLimited, "record more poses, in more directions"},
    {"poses_contradict", kLimited, "keep the probe still in each pose"},
    {"too_few_poses", kLimited, "add poses"},
    {"neighbours_alike", kLimited, "add poses, in no order of direction"},
    {"tip_slid", kInvalid, "fix the dimple and the marker and swing again"},
    {"tip_uncertain", kLimited, "swing wider and longer"},
    {"little_in_dimple", kLimited, "record the swing alone"},
    {"latency_uncertain", kLimited, "shake the probe longer, irregularly, two or three times a second"},
    {"imu_place_uncertain", kLimited, "rotate the probe by some 30 degrees about all its axes"},
    {"imu_rotation_uncertain", kLimited, "move the probe longer, and about all axes"},
    // Tags followed in images.
    {"body_hardly_found", kInvalid, "check the markers' family, ids and size, the light and the focus"},
    {"plane_ambiguous", kInvalid, "use tags in more than one plane, or nearer"},
    {"tags_misfit", kLimited, "check the camera's calibration and the markers' places"},
    {"camera_errors_assumed", kNote, "calibrate the camera with `asperity calibrate camera`"},
    // A rig, by strokes over a known grating (judge_rig.h).
    {"stroke_not_measured", kInvalid, "scan again, slowly and straight across the ridges, from land to land"},
    {"calibration_invalid", kInvalid, "repeat that calibration"},
    {"rig_rows_lost", kInvalid,
     "check the link, its cable or Wi-Fi, and the view of the tags: `asperity inspect` names the stream"},
    {"rig_poses_outlying", kInvalid, "check light, blur and distance of the tags, and fix the marker"},
    {"rig_tracker_noise", kInvalid,
     "fix the marker, and repeat `asperity calibrate tracker` at this distance and in this light"},
    {"pitch_scatters", kInvalid, "repeat `asperity calibrate tip`, and fix marker, tip and grating"},
    {"length_wanders", kInvalid, "repeat `asperity calibrate tip`, and fix marker, tip and grating"},
    {"depth_scatters", kInvalid,
     "press more and scan slower, so that the tip stays on the surface; fix the accelerometer, clean the valleys"},
    {"pitch_off", kInvalid, "check the size of the printed tags and the camera's calibration"},
    {"gravity_off", kInvalid, "repeat `asperity calibrate accel`: the accelerometer's scale or offset is wrong"},
    {"gravity_tilted", kInvalid,
     "check that the marker is not loose or turned on the probe and that the camera has not moved, or repeat "
     "`asperity calibrate accel`"},
    {"depth_off", kInvalid,
     "measure the depth of the print, and check the tip for wear, its contact, and that the accelerometer is rigidly "
     "joined to it"},
    {"shape_off", kInvalid, "check the print for roughness and dirt, the tip for wear, and that it stays in contact"},
    {"latency_scatters", kInvalid, "fix the marker, and relieve the host: it must stamp images and samples evenly"},
    {"few_strokes", kLimited, "scan more strokes"},
    {"gravity_unchecked", kLimited, "hold the probe still for two seconds before a stroke"},
    {"calibration_unstated", kNote, "calibrate with `asperity calibrate`"},
    // A run at a device, and a scan beside what is rendered of it (judge_rendering.h).
    {"device_fault", kInvalid, "check the device's cable, power and driver, and run again"},
    {"force_not_finite", kInvalid, "check the scene's numbers and the device's positions"},
    {"device_stale", kInvalid, "check the device's connection, and what else loads this computer"},
    {"position_implausible", kInvalid, "check the device's calibration and connection"},
    {"scan_not_rendered", kInvalid, "check that the scan is registered to this mesh"},
    {"rendering_poor", kInvalid, "fit the texture to this scan, with more of its path"},
    // A held-back stroke beside the rendered surface (judge_realism.h).
    {"realism_undetermined", kInvalid, "scan along a guide, slower, with a better probe"},
    {"stroke_not_on_texture", kInvalid, "check that the stroke is over the line that the texture is of"},
    {"unlike_real", kInvalid, "check heights, stiffness and friction of the scene"},
    {"far_from_real", kLimited, "check heights, stiffness and friction of the scene"},
    {"texture_without_places", kLimited, "compare a texture of the whole stroke, as register and merge make them"},
    {"own_stroke", kLimited, "hold a stroke back, and make the texture of the others"},
    {"stiffness_assumed", kLimited, "measure it, or state it with --stiffness"},
    {"ceiling_undetermined", kNote, "give another stroke over the same line with --with"},
    {"scene_not_touched", kLimited, "move the path to a surface"},
    {"log_incomplete", kLimited, "log to a faster disk"},
    {"force_limited", kNote, "press less, or lower the stiffness"},
    {"force_slowed", kNote, "move slower, or lower the stiffness"},
    {"started_inside", kNote, "begin outside of the objects"},
};

}  // namespace

std::span<const VerdictCode> verdict_codes() { return kCodes; }

Verdict make_verdict(std::string_view code, std::string message) {
  const auto* const found =
      std::find_if(std::begin(kCodes), std::end(kCodes), [&](const VerdictCode& entry) { return entry.code == code; });
  if (found == std::end(kCodes)) throw Error("verdict: no code '" + std::string(code) + "'");
  return {std::string(code), found->severity, std::move(message), std::string(found->remedy)};
}

}  // namespace asperity

#pragma once

#include "asperity/pipeline/measured_path.h"
#include "asperity/pipeline/path_texture.h"
#include "asperity/pipeline/placement.h"
#include "asperity/pipeline/process_config.h"
#include "asperity/pipeline/scan_on_mesh.h"
#include "asperity/registration/find_registration.h"
#include "asperity/registration/haptic_coordinates.h"
#include "asperity/registration/refine_registration.h"

namespace asperity {

// The settings of all stages from scans and a mesh to a textured mesh.
struct RegisterConfig {
  ProcessConfig process;
  MeasuredPathConfig points;
  PlacementConfig placement;
  SearchConfig search;  // its `registration` serves also where there is a guess
  RefineConfig refinement;
  ScanOnMeshConfig path;
  HapticCoordinatesConfig coordinates;
  FitFourier1dPathConfig texture;

  template <class V>
  void visit(V& v) {
    v.group("process", process);
    v.group("points", points);
    v.group("placement", placement);
    v.group("search", search);
    v.group("refinement", refinement);
    v.group("path", path);
    v.group("coordinates", coordinates);
    v.group("texture", texture);
  }
};

}  // namespace asperity

#pragma once

#include "asperity/session/study_scene.h"
#include "asperity/studio/block.h"
#include "asperity/study/study.h"
#include "feel/feel_setup.h"

namespace asperity::studio {

// Device and settings of a study, upon those of the start. Throws Error for a device that there is none of.
FeelSetup study_setup(const Study& study, const FeelConfig& start);

// What the browser draws of any trial of a study, and all that it receives: the tiles, without heights.
BlockWriter make_trial_block(const Study& study);

}  // namespace asperity::studio

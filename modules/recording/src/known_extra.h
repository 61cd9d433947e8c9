#pragma once

#include "asperity/json/json.h"
#include "asperity/recording/calibration.h"
#include "asperity/recording/recording.h"

namespace asperity {

// What this program knows of the `extra` of its files: out of a file's object into the fields of the structs, and from
// the fields into the object. What does not have the form that this program writes is a stranger's and stays.
void take_known_extra(Json& extra, RecordingInfo& info);
void take_known_extra(Json& extra, Calibration& calibration);
void add_known_extra(const RecordingInfo& info, Json& extra);
void add_known_extra(const Calibration& calibration, Json& extra);

}  // namespace asperity

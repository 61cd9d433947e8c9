#pragma once

#include <map>
#include <string>

#include "asperity/import/import_mapped.h"
#include "asperity/json/json.h"
#include "asperity/studio/project.h"

namespace asperity::studio {

// Which files of the project an import reads, and how: what `asperity import` is given.
struct ImportChoice {
  ImportFiles files;
  MappingConfig mapping;
};

// Of {"files":{"pose":NAME,"imu":NAME,"gyro":NAME,"force":NAME,"object":NAME},"settings":{"mapping.up":"z",…}}; a name
// that is "" or absent is none. Throws Error naming the member, and as Project::existing does.
ImportChoice import_choice(const Project& project, const Json& args);

// What the files' columns are read as and what the checks find, for a person to look at; nothing is written:
//   {"files":[{"role","file","preset","rows","rate_hz",
//              "columns":[{"number","label","unit"}],"cells":[[…],…],
//              "map":[{"meaning","number","unit","negative","why"}]}],
//    "checks":TEXT,"uncertainty":[TEXT],"fault":TEXT}
// "cells" are those of the first rows, as they are in the file. "fault" is why no recording can be made, "" if there
// is none; the columns and the cells are there all the same. Throws Error if a file cannot be read as a table.
Json import_plan(const ImportChoice& choice);

// The recording of them. Throws Error as read_imported_motion does, and Advice where a check failed.
Recording import_recording(const ImportChoice& choice);

}  // namespace asperity::studio

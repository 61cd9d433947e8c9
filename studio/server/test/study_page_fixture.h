#pragma once

#include <string>

#include <gmock/gmock.h>

#include "asperity/base/csv.h"
#include "asperity/testkit/temp_dir.h"
#include "study_rig.h"

namespace asperity::studio {

// A study in a folder of its own with the height maps that are compared.
class StudyPageTest : public testing::Test {
 protected:
  StudyPageTest() { write_height_maps(folder.path()); }
  std::string log(const std::string& name = "study_p01.study.csv") { return read_file(folder / name, 1 << 20U); }
  testkit::TempDir folder;
};

}  // namespace asperity::studio

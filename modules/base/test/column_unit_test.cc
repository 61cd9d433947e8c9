#include "asperity/base/column_unit.h"

#include <gtest/gtest.h>

namespace asperity {
namespace {

// The metres are those of the SI brochure and of the inch of 1959.
TEST(ColumnUnit, TheUnitIsInBracketsOrTheLastWordInAnyCase) {
  struct Case {
    const char* name;
    double metres;
  };
  for (const Case& one : {Case{"Height (nm)", 1e-9},   {"Height [nm]", 1e-9},       {"HEIGHT_NM", 1e-9},
                          {"height_nm", 1e-9},         {"\"z [\xc2\xb5m]\"", 1e-6}, {"z_\xce\xbcm", 1e-6},
                          {"Z (\xce\x9cM)", 1e-6},     {"Height mm", 1e-3},         {"Height (MM)", 1e-3},
                          {"Position/CM", 1e-2},       {"z (\xc3\x85)", 1e-10},     {"z [\xe2\x84\xab]", 1e-10},
                          {"z (angstrom)", 1e-10},     {"HEIGHT_M", 1.0},           {"Height (nm), filtered", 1e-9},
                          {"Height (raw) [um]", 1e-6}, {"z_mil", 2.54e-5},          {"z [in]", 0.0254},
                          {"Height, inch", 0.0254},    {"z (microns)", 1e-6}}) {
    const ColumnUnit found = column_unit(one.name);
    ASSERT_TRUE(found.unit_m) << one.name;
    EXPECT_DOUBLE_EQ(*found.unit_m, one.metres) << one.name;
    EXPECT_FALSE(found.is_other()) << one.name;
  }
  EXPECT_EQ(column_unit("Height (nm)").quantity, "Height");
  EXPECT_EQ(column_unit("mean_height_UM").quantity, "mean_height");
}

TEST(ColumnUnit, AUnitThatIsNotALengthIsNamed) {
  for (const char* name :
       {"z (V)", "z_V", "Height [mV]", "Height (Nm)", "z_Nm", "Signal [counts]", "Height (A)", "angle_deg"}) {
    EXPECT_TRUE(column_unit(name).is_other()) << name;
  }
  EXPECT_EQ(column_unit("z (V)").unit, "V");
}

TEST(ColumnUnit, ANameWithoutAUnitHasNone) {
  for (const char* name :
       {"", "height", "z", "Height ()", "profile_A", "profile_1", "surface left", "min", "Nm", "No."}) {
    const ColumnUnit found = column_unit(name);
    EXPECT_TRUE(found.unit.empty()) << name;
    EXPECT_FALSE(found.unit_m) << name;
  }
}

}  // namespace
}  // namespace asperity

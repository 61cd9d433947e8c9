// Files made byte by byte from the formats' descriptions, all of one relief.
#include "asperity/surface/parse_surface_file.h"

#include <zip.h>

#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>

#include "asperity/base/error.h"
#include "asperity/base/little_endian.h"
#include "asperity/base/nan.h"

namespace asperity {
namespace {

constexpr std::size_t kColumns = 3, kRows = 2;
constexpr double kStepX_m = 2e-6, kStepY_m = 5e-6;
// Whole nanometres, so that each format holds them; the last one was not measured.
const std::vector<int> kHeights_nm{0, 1500, -300, 20000, 7, 0};
constexpr std::size_t kMissing = 5;

void expect_relief(const SurfaceFile& file, double tolerance_m) {
  ASSERT_EQ(file.map.columns, kColumns);
  ASSERT_EQ(file.map.rows, kRows);
  EXPECT_NEAR(file.map.x_spacing_m, kStepX_m, 1e-12);
  EXPECT_NEAR(file.map.y_spacing_m, kStepY_m, 1e-12);
  for (std::size_t i = 0; i < kHeights_nm.size(); ++i) {
    if (i == kMissing) {
      EXPECT_TRUE(std::isnan(file.map.height_m[i])) << file.format;
    } else {
      EXPECT_NEAR(file.map.height_m[i], 1e-9 * kHeights_nm[i], tolerance_m) << file.format << ", point " << i;
    }
  }
}

std::string gsf(const std::string& z_unit = "m", double unit_m = 1.0) {
  std::string out =
      "Gwyddion Simple Field 1.0\nXRes = 3\nYRes = 2\nXReal = 6e-06\nYReal = 1e-05\nXYUnits = m\nZUnits = " + z_unit +
      "\nTitle = a = b\n";
  out.append(4 - out.size() % 4, '\0');
  for (std::size_t i = 0; i < kHeights_nm.size(); ++i)
    append_little_endian(out, i == kMissing ? std::numeric_limits<float>::quiet_NaN()
                                            : static_cast<float>(1e-9 * kHeights_nm[i] / unit_m));
  return out;
}

TEST(SurfaceFile, Gsf) {
  const auto file = parse_surface_file(gsf(), "a.gsf");
  ASSERT_TRUE(file);
  EXPECT_EQ(file->format, "GSF");
  expect_relief(*file, 1e-12);  // 24 bits of 20 µm
  expect_relief(*parse_surface_file(gsf("um", 1e-6), "a.gsf"), 1e-12);
}

std::string sdf_text(const std::string& version, const std::string& separator) {
  std::string out = version +
                    "\nManufacID   = test\nCreateDate  = 010120260000\nNumPoints   = 3\nNumProfiles = 2\n"
                    "Xscale      = 2e-6\nYscale      = 5e-6\nZscale      = 1e-9\nZresolution = 0\n"
                    "Compression = 0\nDataType    = 7\nCheckType   = 0\n*\n";
  for (std::size_t i = 0; i < kHeights_nm.size(); ++i)
    out += (i == kMissing ? std::string("BAD") : std::to_string(kHeights_nm[i])) + separator;
  return out + "\n*\n";
}

TEST(SurfaceFile, SdfText) {
  expect_relief(*parse_surface_file(sdf_text("aISO-1.0", "\n"), "a.sdf"), 1e-15);
  expect_relief(*parse_surface_file(sdf_text("aBCR-1.0", " \r\n"), "a.sdf"), 1e-15);
  // More heights than points: one of both is damaged. Free text behind the last '*' is not.
  std::string more = sdf_text("aISO-1.0", "\n");
  EXPECT_TRUE(parse_surface_file(more + "Operator\n*\n", "a.sdf"));
  more.insert(more.rfind("\n*"), "\n17");
  EXPECT_THAT([&] { parse_surface_file(more, "a.sdf"); },
              testing::ThrowsMessage<Error>(testing::HasSubstr("'17' behind the 6 heights")));
}

template <class Number>
std::string sdf_binary(int type, Number missing) {
  std::string out = "bISO-1.0" + std::string("maker     ") + "010120260000" + "010120260000";
  append_little_endian(out, static_cast<std::uint16_t>(kColumns));
  append_little_endian(out, static_cast<std::uint16_t>(kRows));
  for (const double scale : {kStepX_m, kStepY_m, 1e-9, -1.0}) append_little_endian(out, scale);
  out += '\0';
  out += static_cast<char>(type);
  out += '\0';
  for (std::size_t i = 0; i < kHeights_nm.size(); ++i)
    append_little_endian(out, i == kMissing ? missing : static_cast<Number>(kHeights_nm[i]));
  return out;
}

TEST(SurfaceFile, SdfBinary) {
  expect_relief(*parse_surface_file(sdf_binary<double>(7, std::numeric_limits<double>::max()), "a.sdf"), 1e-15);
  expect_relief(*parse_surface_file(sdf_binary<float>(3, std::numeric_limits<float>::quiet_NaN()), "a.sdf"), 1e-12);
  const auto whole = parse_surface_file(sdf_binary<std::int16_t>(5, 11), "a.sdf");
  EXPECT_NEAR(whole->map.height_m[3], 20e-6, 1e-15);
  EXPECT_NEAR(whole->map.height_m[5], 11e-9, 1e-15) << "whole numbers have no missing one";
}

template <class Number>
std::string sur(int special_points, const std::string& z_unit = "nm", float z_step = 1.0F) {
  std::string out = "DIGITAL SURF";
  const auto put = [&](auto number) { append_little_endian(out, number); };
  const auto put16 = [&](int number) { put(static_cast<std::int16_t>(number)); };
  const auto text = [&](std::string word, std::size_t size) {
    word.resize(size, ' ');
    out += word;
  };
  put16(0), put16(1), put16(1), put16(2);
  text("object", 30), text("operator", 30);
  put16(0), put16(0), put16(0), put16(special_points), put16(1);
  put(0.0F), put(std::int32_t{0});
  put16(8 * static_cast<int>(sizeof(Number)));
  put(std::int32_t{-300}), put(std::int32_t{20000}), put(std::int32_t{kColumns}), put(std::int32_t{kRows});
  put(std::int32_t{kColumns * kRows});
  put(2.0F), put(0.005F), put(z_step);
  for (int i = 0; i < 3; ++i) text("axis", 16);
  text("\xb5m", 16), text("mm", 16), text(z_unit, 16);
  for (int i = 0; i < 3; ++i) text("mm", 16);
  for (int i = 0; i < 3; ++i) put(1.0F);
  for (int i = 0; i < 3; ++i) put16(0);
  text("", 12);
  for (int i = 0; i < 7; ++i) put16(0);
  put(0.0F), text("", 10);
  put16(5), put16(0);  // a comment of 5 bytes
  text("", 128);
  for (int i = 0; i < 3; ++i) put(0.0F);
  text("", 34);
  EXPECT_EQ(out.size(), 512U);
  text("hello", 5);
  for (std::size_t i = 0; i < kHeights_nm.size(); ++i) put(static_cast<Number>(i == kMissing ? -302 : kHeights_nm[i]));
  return out;
}

TEST(SurfaceFile, Sur) {
  expect_relief(*parse_surface_file(sur<std::int16_t>(1), "a.sur"), 1e-15);
  expect_relief(*parse_surface_file(sur<std::int32_t>(1), "a.sur"), 1e-15);
  EXPECT_NEAR(parse_surface_file(sur<std::int32_t>(0), "a.sur")->map.height_m[5], -302e-9, 1e-15);
}

std::string zip(const std::vector<std::pair<std::string, std::string>>& members) {
  zip_error_t error;
  zip_source_t* source = zip_source_buffer_create(nullptr, 0, 0, &error);
  zip_source_keep(source);
  zip_t* archive = zip_open_from_source(source, ZIP_TRUNCATE, &error);
  for (const auto& [name, content] : members) {
    zip_file_add(archive, name.c_str(), zip_source_buffer(archive, content.data(), content.size(), 0),
                 ZIP_FL_OVERWRITE);
  }
  zip_close(archive);
  zip_source_open(source);
  zip_stat_t stat;
  zip_source_stat(source, &stat);
  std::string out(stat.size, '\0');
  zip_source_read(source, out.data(), out.size());
  zip_source_close(source);
  zip_source_free(source);
  return out;
}

std::string x3p_xml(const std::string& data_type, const std::string& z_axis, const std::string& data) {
  return R"(<?xml version="1.0"?><p:ISO5436_2 xmlns:p="http://www.opengps.eu/2008/ISO5436_2"><Record1>)"
         "<Revision>ISO5436 - 2000</Revision><FeatureType>SUR</FeatureType><Axes>"
         "<CX><AxisType>I</AxisType><DataType>L</DataType><Increment>2e-6</Increment><Offset>0</Offset></CX>"
         "<CY><AxisType>I</AxisType><DataType>L</DataType><Increment>5e-6</Increment><Offset>0</Offset></CY>"
         "<CZ><AxisType>A</AxisType><DataType>" +
         data_type + "</DataType>" + z_axis +
         "</CZ></Axes></Record1><Record3><MatrixDimension><SizeX>3</SizeX><SizeY>2</SizeY><SizeZ>1</SizeZ>"
         "</MatrixDimension>" +
         data + "</Record3></p:ISO5436_2>";
}

TEST(SurfaceFile, X3pBinary) {
  std::string data, whole, mask(1, static_cast<char>(0b011111));
  for (std::size_t i = 0; i < kHeights_nm.size(); ++i) {
    append_little_endian(data, i == kMissing ? kNan : 1e-9 * kHeights_nm[i]);
    append_little_endian(whole, static_cast<std::int16_t>(i == kMissing ? 77 : kHeights_nm[i]));
  }
  const std::string link = "<DataLink><PointDataLink>bindata/data.bin</PointDataLink>";
  expect_relief(*parse_surface_file(
                    zip({{"main.xml", x3p_xml("D", "", link + "</DataLink>")}, {"bindata/data.bin", data}}), "a.x3p"),
                1e-15);
  expect_relief(
      *parse_surface_file(
          zip({{"main.xml", x3p_xml("I", "<Increment>1e-9</Increment>",
                                    link + "<ValidPointsLink>bindata/valid.bin</ValidPointsLink></DataLink>")},
               {"bindata/data.bin", whole},
               {"bindata/valid.bin", mask}}),
          "a.x3p"),
      1e-15);
}

TEST(SurfaceFile, X3pText) {
  std::string list = "<DataList>";
  for (std::size_t i = 0; i < kHeights_nm.size(); ++i)
    list += i == kMissing ? "<Datum/>" : "<Datum>0;0;" + std::to_string(1e-9 * kHeights_nm[i]) + "</Datum>";
  // std::to_string has six digits: only whole micrometres are told apart.
  const auto file = parse_surface_file(zip({{"main.xml", x3p_xml("D", "", list + "</DataList>")}}), "a.x3p");
  EXPECT_NEAR(file->map.height_m[3], 20e-6, 1e-12);
  EXPECT_TRUE(std::isnan(file->map.height_m[kMissing]));
}

// Sums by Python's hashlib of the same bytes.
TEST(SurfaceFile, X3pChecksumsThatDoNotHoldAreProblems) {
  const std::string of_data = "8dd6bb7329a71449b0a1b292b5999164", of_mask = "d1457b72c3fb323a2671125aef3eab5d",
                    of_xml = "d3ec36de4909f139c815fc3fee22dba5";
  const std::string link =
      "<DataLink><PointDataLink>d</PointDataLink><MD5ChecksumPointData>8DD6BB7329A71449B0A1B292B5999164"
      "</MD5ChecksumPointData><ValidPointsLink>m</ValidPointsLink><MD5ChecksumValidPoints>" +
      of_mask + "</MD5ChecksumValidPoints></DataLink>";
  const std::string xml = x3p_xml("I", "<Increment>1e-9</Increment>", link), data(12, '\0'), mask = "\x3f";
  const auto problems_of = [](const std::vector<std::pair<std::string, std::string>>& members) {
    return parse_surface_file(zip(members), "a.x3p")->problems;
  };
  for (const std::string& sum : {of_xml + " *main.xml\n", of_xml + " *./main.xml\r\n", of_xml, std::string("none\n")})
    EXPECT_TRUE(problems_of({{"main.xml", xml}, {"d", data}, {"m", mask}, {"md5checksum.hex", sum}}).empty()) << sum;
  EXPECT_TRUE(problems_of({{"main.xml", xml}, {"d", data}, {"m", mask}}).empty());

  // A checksum file that cannot be read is doubtful; the heights are whole.
  const Problems too_large =
      problems_of({{"main.xml", xml}, {"d", data}, {"m", mask}, {"md5checksum.hex", std::string(70000, '0')}});
  ASSERT_EQ(too_large.size(), 1U);
  EXPECT_EQ(too_large[0].kind, "checksum");
  // Of a thousand sums one is compared: each would take the time of the whole file.
  std::string many;
  for (int i = 0; i < 1000; ++i) many += std::string(32, '0') + " *main.xml\n";
  EXPECT_EQ(problems_of({{"main.xml", xml}, {"d", data}, {"m", mask}, {"md5checksum.hex", many}}).size(), 1U);

  std::string changed = data;
  changed[3] = 1;
  const Problems of_all = problems_of(
      {{"main.xml", xml + "\n"}, {"d", changed}, {"m", "\x3e"}, {"md5checksum.hex", of_xml + " *main.xml\n"}});
  ASSERT_EQ(of_all.size(), 3U);
  using testing::AllOf;
  using testing::HasSubstr;
  EXPECT_EQ(of_all[0].kind, "checksum");
  EXPECT_THAT(of_all[0].message, AllOf(HasSubstr("a.x3p: main.xml has the MD5 sum f98090474ef218ebfd77980cd9a4c30c"),
                                       HasSubstr("md5checksum.hex states " + of_xml)));
  EXPECT_THAT(of_all[1].message, AllOf(HasSubstr("a.x3p: d has"), HasSubstr("states " + of_data)));
  EXPECT_THAT(of_all[2].message, AllOf(HasSubstr("a.x3p: m has"), HasSubstr("states " + of_mask)));
}

std::string fault(const std::string& bytes) {
  try {
    if (!parse_surface_file(bytes, "f")) return "none";
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(SurfaceFile, FaultsAreNamed) {
  using testing::HasSubstr;
  EXPECT_EQ(fault("1\n2\n3\n"), "none");
  EXPECT_EQ(fault(""), "none");
  EXPECT_THAT(fault(gsf("V")),
              HasSubstr("the unit of the heights (ZUnits) is 'V', which is not a known unit of length"));
  EXPECT_THAT(fault(gsf("")), HasSubstr("not a known unit of length"));
  EXPECT_THAT(fault(sdf_text("aISO-1.0", " x ")), HasSubstr("f:14: 'x' where height 2 of 6"));
  EXPECT_THAT(fault(sur<std::int16_t>(0, "V")), HasSubstr("'V'"));
  EXPECT_THAT(fault(zip({{"other", "x"}})), HasSubstr("main.xml is not in it"));
  EXPECT_THAT(fault(gsf("m", 1e-12)), HasSubstr("the height of point 2 of row 1 is"));
  EXPECT_THAT(fault("DSCOMPRESSED" + std::string(600, ' ')), HasSubstr("save it without compression"));
}

// A step that is not a number would make every height a missing one, and 0 a flat surface.
TEST(SurfaceFile, AStepOfHeightsThatIsNotOneIsRefused) {
  using testing::HasSubstr;
  for (const float step : {0.0F, std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()})
    EXPECT_THAT(fault(sur<std::int16_t>(0, "nm", step)), HasSubstr("f: the step of the heights is "));
  const std::string link = "<DataLink><PointDataLink>d</PointDataLink></DataLink>", data(12, '\0');
  for (const char* value : {"nan", "inf", "0", "1e999"}) {
    const std::string axis = std::string("<Increment>") + value + "</Increment>";
    EXPECT_THAT(fault(zip({{"main.xml", x3p_xml("I", axis, link)}, {"d", data}})), HasSubstr("f: Increment of axis CZ"))
        << value;
  }
  const std::string offset = "<Increment>1e-9</Increment><Offset>nan</Offset>";
  EXPECT_THAT(fault(zip({{"main.xml", x3p_xml("I", offset, link)}, {"d", data}})), HasSubstr("f: Offset of axis CZ"));
}

// A small file may name members that are huge: they are not unpacked.
TEST(SurfaceFile, AMemberIsNoLargerThanTheGridNeeds) {
  const std::string link = "<DataLink><PointDataLink>d</PointDataLink><ValidPointsLink>m</ValidPointsLink></DataLink>";
  const std::string xml = x3p_xml("I", "<Increment>1e-9</Increment>", link), huge(std::size_t{8} << 20U, '\0');
  EXPECT_EQ(fault(zip({{"main.xml", xml}, {"d", huge}, {"m", "x"}})), "f: d has 8388608 bytes, more than it may");
  EXPECT_EQ(fault(zip({{"main.xml", xml}, {"d", std::string(12, '\0')}, {"m", huge}})),
            "f: m has 8388608 bytes, more than it may");
}

// Whatever is cut off a file: one clear error, or none if nothing that is needed is missing.
TEST(SurfaceFile, CutAnywhere) {
  for (const std::string& whole :
       {gsf(), sdf_text("aISO-1.0", "\n"), sdf_binary<double>(7, 0.0), sur<std::int16_t>(1)}) {
    for (std::size_t size = 13; size < whole.size(); ++size) {
      const std::string told = fault(whole.substr(0, size));
      EXPECT_TRUE(told.empty() || told == "none" || told.starts_with("f:")) << told;
      EXPECT_TRUE(size + 8 >= whole.size() || !told.empty()) << size << " of " << whole.size();
    }
  }
}

}  // namespace
}  // namespace asperity

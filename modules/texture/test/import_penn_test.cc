#include "asperity/texture/import_penn.h"

#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "asperity/base/error.h"
#include "asperity/testkit/temp_dir.h"
#include "asperity/texture/evaluate_autoregressive.h"

namespace asperity {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::ThrowsMessage;

std::string values(const std::string& name, const std::string& numbers) {
  std::string out = "<" + name + ">";
  for (std::size_t from = 0; from < numbers.size();) {
    const auto to = std::min(numbers.find(' ', from), numbers.size());
    out += "\n    <value>" + numbers.substr(from, to - from) + "</value>";
    from = to + 1;
  }
  return out + "\n  </" + name + ">\n  ";
}

std::string model(const std::string& lsf, const std::string& var, const std::string& speed, const std::string& force,
                  const std::string& more = {}) {
  return "<model>\n  " + values("ARlsf", lsf) + more + "<var>" + var + "</var>\n  <speedMod>" + speed +
         "</speedMod>\n  <forceMod>" + force + "</forceMod>\n</model>\n";
}

// Made up; the structure is the toolkit's.
std::string file() {
  return "<?xml version=\"1.0\" encoding=\"utf-8\"?>\n<modelSet>\n<!-- <model> -->\n  "
         "<renderPicture>/a.jpg</renderPicture>\n"
         "  <mu>0.31</mu>\n  <numMod>4</numMod>\n  <numTri>2</numTri>\n  <maxSpeed>200</maxSpeed>\n  "
         "<maxForce>3</maxForce>\n  " +
         values("speedList", "20 200 20 200") + values("forceList", "0.5 0.5 3 3") + values("tri", "1 2 3") +
         values("tri", "2 4 3") + "<numARCoeff>2</numARCoeff>\n<numMACoeff>0</numMACoeff>\n" +
         model("0.4 1.1", "0.02", "20", "0.5") + model("0.6 1.3", "0.2", "200", "0.5") +
         model("0.5 1.2", "0.05", "20", "3") + model("0.7 1.9", "0.5", "200", "3") + "</modelSet>\n";
}

std::string with(const std::string& from, const std::string& to) {
  std::string text = file();
  const auto at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

void expect_error(const std::string& text, const std::string& place, const std::string& message) {
  EXPECT_THAT([&] { parse_penn(text, "x.xml"); }, ThrowsMessage<Error>(AllOf(HasSubstr(place), HasSubstr(message))))
      << text.substr(0, 200);
}

TEST(ImportPenn, ReadsTheToolkitsStructure) {
  const testkit::TempDir dir;
  const auto path = dir.path() / "Models_x.xml";
  std::ofstream(path) << file();
  const auto penn = import_penn(path);
  EXPECT_EQ(penn.friction, 0.31);
  EXPECT_THAT(penn.problems, IsEmpty());
  const auto& t = penn.texture;
  EXPECT_EQ(t.rate_Hz, 1000.0);
  EXPECT_EQ(t.mass_kg, 0.05);
  EXPECT_DOUBLE_EQ(t.max_speed_mps, 0.2);
  EXPECT_EQ(t.max_force_N, 3.0);
  ASSERT_EQ(t.models.size(), 4u);
  EXPECT_THAT(t.models[3].ar_lsf_rad, ElementsAre(0.7, 1.9));
  EXPECT_DOUBLE_EQ(t.models[1].speed_mps, 0.2);
  EXPECT_EQ(t.models[2].force_N, 3.0);
  EXPECT_EQ(t.models[0].variance, 0.02);
  EXPECT_THAT(t.triangles, ElementsAre(std::array{0, 1, 2}, std::array{1, 3, 2}));
  const auto filter = blended_filter(t, blend_models(t, 0.11, 0.5, 0));
  // Half way from model 1 to model 2 the output has half the sum of their variances.
  const double expected = 0.5 * (t.models[0].pole_variance_m2_per_s4 + t.models[1].pole_variance_m2_per_s4);
  EXPECT_NEAR(filter.sigma_mps2 * filter.sigma_mps2, expected, 1e-12 * expected);
}

TEST(ImportPenn, ReadsNumerators) {
  const std::string ma = values("MAlsf", "0.9 2.0 2.5") + "<gain>1.5</gain>";
  std::string text = with("<numMACoeff>0", "<numMACoeff>3");
  for (std::size_t at = 0; (at = text.find("</ARlsf>", at)) != std::string::npos; at += ma.size())
    text.insert(at + 8, ma);
  const auto penn = parse_penn(text, "x.xml");
  EXPECT_THAT(penn.texture.models[2].ma_lsf_rad, ElementsAre(0.9, 2.0, 2.5));
  EXPECT_EQ(penn.texture.models[2].gain, 1.5);
}

TEST(ImportPenn, ReadsListsAsTextAndMissingLists) {
  const std::string text =
      "<modelSet><maxSpeed>100</maxSpeed><maxForce>2</maxForce><model><ARlsf> 0.4, 1.1 </ARlsf><gain>1</gain>"
      "<var><value>0.5</value></var><speedMod>50</speedMod><forceMod>1</forceMod></model></modelSet>";
  const auto penn = parse_penn(text, "x.xml");
  EXPECT_THAT(penn.texture.models[0].ar_lsf_rad, ElementsAre(0.4, 1.1));
  EXPECT_FALSE(penn.friction.has_value());
}

TEST(ImportPenn, ReplacesATriangulationOfOtherModels) {
  const auto penn =
      parse_penn(with("<value>1</value>\n    <value>2</value>", "<value>0</value>\n    <value>2</value>"), "x");
  ASSERT_EQ(penn.problems.size(), 1u);
  EXPECT_EQ(penn.problems[0].kind, "triangles_replaced");
  EXPECT_EQ(penn.texture.triangles.size(), 2u);
}

TEST(ImportPenn, NamesFileLineAndElementOfWhatIsWrong) {
  expect_error("", "x.xml", "not XML");
  expect_error("<modelSet>\n<mu>", "x.xml:", "not XML");
  expect_error("<html/>", "x.xml:1", "no 'modelSet'");
  expect_error("<modelSet/>", "x.xml:1: 'modelSet'", "no 'maxSpeed'");
  expect_error(with("<mu>0.31", "<mu>0.31x"), "x.xml:5: 'mu'", "'0.31x', which is not a number");
  expect_error(with("<mu>0.31", "<mu>-1"), "x.xml:5: 'mu'", "-1, which is not within");
  expect_error(with("<mu>0.31</mu>", "<mu>1</mu><mu>1</mu>"), "x.xml:5: 'mu'", "twice");
  expect_error(with("<numMod>4", "<numMod>5"), "x.xml:6: 'numMod'", "5 where there are 4 models");
  expect_error(with("<numMod>4", "<numMod>4.5"), "'numMod'", "not a count");
  expect_error(with("<numTri>2", "<numTri>3"), "x.xml:7: 'numTri'", "3 where there are 2");
  expect_error(with("<value>200</value>", "<value>100</value>"), "'speedList'", "value 2 is 100");
  expect_error(with("<value>0.5</value>\n", ""), "'forceList'", "3 values where there are 4 models");
  expect_error(with("<value>1.1</value>", "<value>nan</value>"), "'ARlsf'", "not a number");
  expect_error(with("<value>1.1</value>", "<value>1e999</value>"), "'ARlsf'", "not a number");
  expect_error(with("<value>1.1</value>", "<value>0.3</value>"), "x.xml", "line spectral frequency 2 of model 1");
  expect_error(with("<value>1.1</value>", ""), "'numARCoeff'", "2 where the models have 1");
  expect_error(with("<value>1.3</value>", ""), "x.xml", "model 2 has 1 AR frequencies where the first has 2");
  expect_error(with("<var>0.02</var>", ""), "'model'", "no 'var'");
  expect_error(with("<numARCoeff>2", "<numARCoeff>3"), "'numARCoeff'", "3 where the models have 2");
}

TEST(ImportPenn, IsNotToBeHarmedByAHostileFile) {
  std::string deep;
  for (int i = 0; i < 100000; ++i) deep += "<a>";
  expect_error(deep, "x.xml:1", "nested deeper than 16");
  expect_error("<!DOCTYPE a [<!ENTITY b \"c\">]><modelSet/>", "x.xml:1", "document type");
  // What looks like the end of a tag inside a quoted value is none.
  std::string quoted;
  for (int i = 0; i < 20; ++i) quoted += "<a b=\"/>\">\n";
  expect_error(quoted, "x.xml:1", "nested deeper than 16");
  // Each search goes on where the last one ended: these would take minutes otherwise.
  const auto repeated = [](const std::string& what, int times) {
    std::string text;
    for (int i = 0; i < times; ++i) text += what;
    return text;
  };
  expect_error(repeated("</", 2'400'000) + repeated("<", 100), "x.xml:1", "'</' is not closed");
  expect_error(repeated("</a>", 1'200'000) + "<", "x.xml:1", "a tag is not closed");
  expect_error("<modelSet>" + repeated("<a b='>' />", 400'000) + "<!--", "x.xml:1", "'<!--' is not closed");
  expect_error(repeated("<a b='", 800'000), "x.xml:1", "a tag is not closed");
  expect_error("<modelSet><!-- ", "x.xml:1", "not closed");
  std::string many = "<modelSet><maxSpeed>1</maxSpeed><maxForce>1</maxForce><model><ARlsf>";
  for (int i = 0; i < 33; ++i) many += "<value>0.1</value>";
  expect_error(many + "</ARlsf></model></modelSet>", "'ARlsf'", "more than 32 numbers");
  expect_error(std::string((8 << 20) + 1, ' '), "x.xml", "bytes, more than");
}

}  // namespace
}  // namespace asperity

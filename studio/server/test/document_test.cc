#include "asperity/studio/document.h"

#include <gmock/gmock.h>

#include <fstream>

#include "asperity/base/error.h"
#include "asperity/base/output.h"
#include "asperity/json/parse_json.h"
#include "asperity/testkit/temp_dir.h"
#include "config_fields.h"
#include "server_limits.h"

namespace asperity::studio {
namespace {

void refuse_negative(const Json& section) {
  if (section.at("a").get<double>() < 0) throw Error("a is negative");
}

std::unique_ptr<Document> make_document(const std::filesystem::path& file) {
  auto out = std::make_unique<Document>(file);
  out->add_section("page", parse_json(R"({"a":1,"list":[1,2,3],"deep":{"x":0}})"), refuse_negative);
  out->load();
  return out;
}

class DocumentTest : public ::testing::Test {
 protected:
  testkit::TempDir folder_;
  std::filesystem::path file_ = folder_.path() / ".asperity-studio.json";
  std::unique_ptr<Document> document_ = make_document(file_);
  const Json first_ = document_->value();
};

TEST_F(DocumentTest, UndoAndRedoGoBackAndForth) {
  document_->edit("/page/a", 2, "two");
  document_->edit("/page/deep/y", "new", "a key");
  document_->edit("/page/deep/x", nullptr, "taken out");
  const Json last = document_->value();
  EXPECT_EQ(last, parse_json(R"({"page":{"a":2,"list":[1,2,3],"deep":{"y":"new"}}})"));
  EXPECT_EQ(document_->undo_label(), "taken out");
  while (document_->undo()) {
  }
  EXPECT_EQ(document_->value(), first_);
  while (document_->redo()) {
  }
  EXPECT_EQ(document_->value(), last);
}

TEST_F(DocumentTest, ListsGrowAndShrinkAndComeBack) {
  document_->edit("/page/list/-", 4, "one more");
  document_->edit("/page/list/0", nullptr, "one less");
  document_->edit("/page/list/1", 7, "another");
  EXPECT_EQ(document_->value()["page"]["list"], parse_json("[2,7,4]"));
  document_->undo();
  document_->undo();
  EXPECT_EQ(document_->value()["page"]["list"], parse_json("[1,2,3,4]"));
  document_->undo();
  EXPECT_EQ(document_->value(), first_);
}

TEST_F(DocumentTest, AGestureIsOneStep) {
  for (int i = 2; i < 9; ++i) document_->edit("/page/a", i, "slide", "g");
  document_->edit("/page/a", 9, "slide", "h");
  document_->undo();
  EXPECT_EQ(document_->value()["page"]["a"], 8);
  document_->undo();
  EXPECT_EQ(document_->value(), first_);
}

TEST_F(DocumentTest, WhatASectionRefusesChangesNothing) {
  EXPECT_THROW(document_->edit("/page/a", -1, "negative"), Error);
  EXPECT_THROW(document_->edit("/other/a", 1, "nowhere"), Error);
  EXPECT_THROW(document_->edit("/page/none/x", 1, "nowhere"), Error);
  EXPECT_THROW(document_->edit("/page/list/9", 1, "nowhere"), Error);
  EXPECT_THROW(document_->edit("/page/list/x", 1, "nowhere"), Error);
  EXPECT_THROW(document_->edit("", Json::object(), "all"), Error);
  EXPECT_THROW(document_->edit("page", 1, "no pointer"), Error);
  EXPECT_THROW(document_->edit("/page", nullptr, "gone"), Error);
  EXPECT_THROW(document_->edit("/page/a", std::string(5U << 20U, 'x'), "large"), Error);
  EXPECT_EQ(document_->value(), first_);
  EXPECT_FALSE(document_->undo());
}

TEST_F(DocumentTest, IsThereAgainWithItsSteps) {
  document_->edit("/page/a", 2, "two");
  document_->edit("/page/a", 3, "three");
  document_->undo();
  write_file(file_, *document_->take_unsaved());
  EXPECT_FALSE(document_->take_unsaved());
  const auto again = make_document(file_);
  EXPECT_TRUE(again->problems().empty());
  EXPECT_EQ(again->value(), document_->value());
  EXPECT_EQ(again->redo_label(), "three");
  again->redo();
  EXPECT_EQ(again->value()["page"]["a"], 3);
  again->undo();
  again->undo();
  EXPECT_EQ(again->value(), first_);
}

TEST_F(DocumentTest, ADamagedFileIsPutAside) {
  for (const std::string& content : {std::string("{\"format\":"), std::string(100'000, '['), std::string("7"),
                                     std::string(R"({"format":"asperity-studio","version":2})")}) {
    std::ofstream(file_) << content;
    const auto again = make_document(file_);
    EXPECT_EQ(again->value(), first_);
    EXPECT_EQ(again->problems().size(), 1U);
    EXPECT_TRUE(std::filesystem::exists(file_.string() + ".unreadable"));
    EXPECT_FALSE(std::filesystem::exists(file_));
  }
}

// In its place the next save would replace it.
TEST_F(DocumentTest, ADamagedFileThatCannotBePutAsideIsAnError) {
  std::ofstream(file_) << "7";
  std::filesystem::create_directories(file_.string() + ".unreadable");
  EXPECT_THROW(make_document(file_), Error);
  std::ifstream file(file_);
  EXPECT_EQ(file.get(), '7');
}

TEST_F(DocumentTest, LongPathsAndLabelsAreRefusedAtOnce) {
  EXPECT_THROW(document_->edit("/page" + std::string(100'000, '/'), 1, "slashes"), Error);
  std::string deep = "/page";
  for (int i = 0; i < 40; ++i) deep += "/x";
  EXPECT_THROW(document_->edit(deep, 1, "deep"), Error);
  EXPECT_THROW(document_->edit("/page/a", 2, std::string(10'000, 'x')), Error);
  EXPECT_EQ(document_->value(), first_);
}

TEST_F(DocumentTest, BoundsASectionAndItsSteps) {
  EXPECT_THROW(document_->edit("/page/deep/x", std::string(kLargestSectionBytes, 'x'), "large"), Error);
  EXPECT_EQ(document_->value(), first_);
  document_->edit("/page/deep/x", std::string(kLargestSectionBytes / 2, 'x'), "half");
  EXPECT_THROW(document_->edit("/page/deep/y", std::string(kLargestSectionBytes / 2, 'y'), "the other half"), Error);
  for (std::size_t i = 0; i < kMostUndoSteps + 50; ++i) document_->edit("/page/a", i, "step");
  std::size_t undone = 0;
  while (document_->undo()) ++undone;
  EXPECT_EQ(undone, kMostUndoSteps);
}

TEST_F(DocumentTest, ManyLargeEditsStayWithinWhatIsReadAgain) {
  for (int i = 0; i < 60; ++i) document_->edit("/page/deep/" + std::to_string(i), std::string(50'000, 'x'), "large");
  for (int i = 0; i < 60; ++i)
    document_->edit("/page/deep", Json{{"x", std::string(1'000'000, 'y') + std::to_string(i)}}, "larger");
  const std::string content = *document_->take_unsaved();
  EXPECT_LT(content.size(), 32U << 20U);
  write_file(file_, content);
  const auto again = make_document(file_);
  EXPECT_TRUE(again->problems().empty());
  EXPECT_EQ(again->value(), document_->value());
  EXPECT_TRUE(again->undo());
}

TEST_F(DocumentTest, AnUndoStepThatThePageRefusesIsDropped) {
  std::ofstream(file_) << R"({"format":"asperity-studio","version":1,"document":{"page":{"a":1}},)"
                       << R"("undo":[{"path":"/page/a","before":-7,"after":1,"label":"bad"}],)"
                       << R"("redo":[{"path":"/page/none/x","before":0,"after":1,"label":"nowhere"}]})";
  const auto again = make_document(file_);
  EXPECT_THROW(again->undo(), Error);
  EXPECT_THROW(again->redo(), Error);
  EXPECT_EQ(again->value()["page"]["a"], 1);
  EXPECT_FALSE(again->undo());
  EXPECT_FALSE(again->redo());
}

struct RenamedConfig {
  double cutoff_Hz = 1.0;
  double order = 2.0;

  template <class V>
  void visit(V& v) {
    v.field("cutoff_Hz", cutoff_Hz, "low-pass");
    v.former("cutoff_hz");
    v.field("order", order, "of it");
  }
};

// A project of an older version: its settings have the names that they have now, for the forms and for what is written.
TEST_F(DocumentTest, SettingsOfAnOlderVersionGetTheirPresentNames) {
  const auto open = [this] {
    auto out = std::make_unique<Document>(file_);
    out->add_section(
        "page", parse_json(R"({"config":{}})"), [](const Json&) {},
        [](Json& section) {
          RenamedConfig config;
          use_present_names(section, "config", list_fields("", config));
        });
    out->load();
    return out;
  };
  const auto reopen_with = [&](const char* config) {
    std::filesystem::remove(file_);
    const auto older = open();
    older->edit("/page/config", parse_json(config), "as it was");
    write_file(file_, *older->take_unsaved());
    return open()->section("page").at("config");
  };
  EXPECT_EQ(reopen_with(R"({"order":"3","cutoff_hz":"5"})"), parse_json(R"({"order":"3","cutoff_Hz":"5"})"));
  EXPECT_EQ(reopen_with(R"({"cutoff_Hz":"6","cutoff_hz":"5"})"), parse_json(R"({"cutoff_Hz":"6"})"));
  EXPECT_EQ(reopen_with(R"([1])"), parse_json("[1]"));
}

TEST_F(DocumentTest, ASectionThatItsPageRefusesBeginsAnew) {
  std::ofstream(file_)
      << R"({"format":"asperity-studio","version":1,"document":{"page":{"a":-5}},"undo":[],"redo":[]})";
  const auto again = make_document(file_);
  EXPECT_EQ(again->value(), first_);
  EXPECT_EQ(again->problems().size(), 1U);
}

}  // namespace
}  // namespace asperity::studio

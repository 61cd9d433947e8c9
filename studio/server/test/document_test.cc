#include "asperity/studio/document.h"

#include <gmock/gmock.h>

#include <unistd.h>
#include <fstream>
#include <string>
#include <vector>

#include "asperity/base/csv.h"
#include "asperity/base/error.h"
#include "asperity/base/output.h"
#include "asperity/json/parse_json.h"
#include "asperity/testkit/temp_dir.h"
#include "config_fields.h"
#include "server_limits.h"

namespace asperity::studio {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::ThrowsMessage;

// A document whose section refuse_negative refuses.
constexpr const char* kNegative =
    R"({"format":"asperity-studio","version":1,"document":{"page":{"a":-5}},"undo":[],"redo":[]})";

std::string text_of(const std::filesystem::path& file) { return read_file(file, 1 << 20); }

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
  std::filesystem::path beside(const std::string& ending) const { return file_.string() + ending; }

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

TEST_F(DocumentTest, DamagedFilesArePutAsideEachUnderANameOfItsOwn) {
  const std::vector<std::string> damaged{"{\"format\":", std::string(100'000, '['), "7",
                                         R"({"format":"asperity-studio","version":2})",
                                         R"({"format":"asperity-studio","version":1,"document":7})"};
  for (std::size_t i = 0; i < damaged.size(); ++i) {
    std::ofstream(file_) << damaged[i];
    const auto again = make_document(file_);
    EXPECT_EQ(again->value(), first_);
    const std::string ending = i == 0 ? ".unreadable" : ".unreadable_" + std::to_string(i + 1);
    const std::string name = beside(ending).filename().string();
    EXPECT_THAT(again->problems(), ElementsAre(HasSubstr("was renamed to " + name + ": ")));
    EXPECT_FALSE(std::filesystem::exists(file_));
    EXPECT_EQ(text_of(beside(ending)), damaged[i]);
  }
  EXPECT_EQ(text_of(beside(".unreadable")), damaged[0]);
}

// The next save has neither that section nor the steps. A second start of the same file adds no second copy.
TEST_F(DocumentTest, OfAFileWithASectionThatIsNotTakenOneCopyIsKept) {
  std::ofstream(file_) << kNegative;
  const std::string copy = beside(".before").filename().string();
  for (int start = 0; start < 3; ++start) {
    const auto again = make_document(file_);
    EXPECT_EQ(again->value(), first_);
    EXPECT_THAT(again->problems(), ElementsAre(HasSubstr("'page' starts with its defaults: a is negative"),
                                               HasSubstr("is kept as " + copy)));
    EXPECT_EQ(text_of(file_), kNegative);
  }
  EXPECT_EQ(text_of(beside(".before")), kNegative);
  EXPECT_FALSE(std::filesystem::exists(beside(".before_2")));
}

TEST_F(DocumentTest, AnotherContentIsCopiedBesideTheFirst) {
  std::ofstream(file_) << kNegative;
  make_document(file_);
  std::ofstream(file_) << kNegative << '\n';
  make_document(file_);
  std::ofstream(file_) << kNegative;
  make_document(file_);
  EXPECT_EQ(text_of(beside(".before")), kNegative);
  EXPECT_EQ(text_of(beside(".before_2")), std::string(kNegative) + "\n");
  EXPECT_FALSE(std::filesystem::exists(beside(".before_3")));
}

TEST_F(DocumentTest, OfAFileWithStepsThatCannotBeReadACopyIsKept) {
  const std::string content =
      R"({"format":"asperity-studio","version":1,"document":{"page":{"a":5}},"undo":[{"path":7}],"redo":[]})";
  std::ofstream(file_) << content;
  const auto again = make_document(file_);
  EXPECT_EQ(again->value()["page"]["a"], 5);
  EXPECT_THAT(again->problems(), ElementsAre(HasSubstr("earlier steps cannot be undone any more: "),
                                             HasSubstr("is kept as " + beside(".before").filename().string())));
  EXPECT_EQ(text_of(beside(".before")), content);
}

// Of a newer version, for example.
TEST_F(DocumentTest, SectionsThatNoPageHasAreKept) {
  const Json newer = parse_json(R"({"b":[1,{"c":"d"}],"e":null})");
  std::ofstream(file_) << R"({"format":"asperity-studio","version":1,"document":{"newer":)" << newer.dump()
                       << R"(,"page":{"a":5}},"undo":[],"redo":[]})";
  for (int a = 6; a < 8; ++a) {
    const auto again = make_document(file_);
    EXPECT_THAT(again->problems(), testing::IsEmpty());
    EXPECT_FALSE(again->value().contains("newer"));
    EXPECT_THROW(again->edit("/newer/b", 2, "not of this version"), Error);
    again->edit("/page/a", a, "a change");
    write_file(file_, *again->take_unsaved());
    const Json saved = parse_json(text_of(file_)).at("document");
    EXPECT_EQ(saved.at("newer"), newer);
    EXPECT_EQ(saved.at("page").at("a"), a);
  }
}

// A loop, which fails as EIO or EACCES would, a link to a disk that is not there, and what is not a file.
TEST_F(DocumentTest, AFileThatCannotBeReadIsRefusedAndUntouched) {
  const auto refusal = [](const std::string& why) {
    return ThrowsMessage<Error>(AllOf(HasSubstr(why), HasSubstr("the studio does not start")));
  };
  std::filesystem::create_symlink(file_.filename(), file_);
  EXPECT_THAT([this] { make_document(file_); },
              refusal(file_.string() + ": cannot be looked up: Too many levels of symbolic links"));
  EXPECT_TRUE(std::filesystem::is_symlink(file_));
  std::filesystem::remove(file_);
  std::filesystem::create_symlink("none", file_);
  EXPECT_THAT([this] { make_document(file_); }, refusal(file_.string() + ": is a link to a file that does not exist"));
  EXPECT_TRUE(std::filesystem::is_symlink(file_));
  std::filesystem::remove(file_);
  std::filesystem::create_directory(file_);
  EXPECT_THAT([this] { make_document(file_); }, refusal(file_.string() + ": not a regular file"));
  EXPECT_TRUE(std::filesystem::is_directory(file_));
  EXPECT_FALSE(std::filesystem::exists(beside(".unreadable")));
}

// The disk gives no permission; root needs none.
TEST_F(DocumentTest, AFileWithoutPermissionIsRefusedAndUntouched) {
  if (::geteuid() == 0) GTEST_SKIP() << "root reads every file";
  std::ofstream(file_) << kNegative;
  std::filesystem::permissions(file_, std::filesystem::perms::none);
  EXPECT_THAT([this] { make_document(file_); },
              ThrowsMessage<Error>(HasSubstr(file_.string() + ": cannot be opened: Permission denied")));
  std::filesystem::permissions(file_, std::filesystem::perms::owner_all);
  EXPECT_EQ(text_of(file_), kNegative);
}

// Its name leaves no room for another ending: the first look-up fails, and its reason is stated.
TEST_F(DocumentTest, AFileThatCannotBeKeptIsRefusedAndUntouched) {
  const std::filesystem::path file = folder_ / std::string(250, 'n');
  for (const char* content : {"7", kNegative}) {
    std::ofstream(file) << content;
    EXPECT_THAT([&] { make_document(file); },
                ThrowsMessage<Error>(AllOf(HasSubstr(file.string() + ": cannot be "),
                                           HasSubstr("cannot be looked up: File name too long"),
                                           HasSubstr("the studio does not start"))));
    EXPECT_EQ(text_of(file), content);
  }
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

// A project of an older version: its settings have the names that they have now, for the forms and for all that is
// written.
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

}  // namespace
}  // namespace asperity::studio

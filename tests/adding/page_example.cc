// A page of the studio, as docs/architecture.md tells to add one: the server's part. The browser's is
// studio/web/test/adding/NotesPage.tsx.
#include <gmock/gmock.h>
#include <memory>
#include <sstream>
#include <string>

#include "asperity/base/error.h"
#include "asperity/studio/page.h"
#include "page_rig.h"

namespace asperity::studio {
namespace {

// studio/server/src/notes/notes_page.cc ------------------------------------------------------------------------------

class NotesPage : public Page {
 public:
  explicit NotesPage(Shared& shared) : shared_(shared) {}

  void bind(Document& document, Calls& calls) override {
    document.add_section("notes", {{"text", ""}}, [](const Json& section) {
      if (!section.is_object() || !section.contains("text") || !section.at("text").is_string()) {
        throw Error("notes: 'text' is not a text");
      }
    });
    calls.add("notes.count", [this](const Request& request) { request.answer(Json({{"words", count()}})); });
  }

 private:
  int count() const {
    std::istringstream text(shared_.document.section("notes").at("text").get<std::string>());
    int words = 0;
    for (std::string word; text >> word;) ++words;
    return words;
  }

  Shared& shared_;
};

// Its line in make_pages(), studio/server/src/pages.cc: pages.push_back(make_notes_page(shared));
std::unique_ptr<Page> make_notes_page(Shared& shared) { return std::make_unique<NotesPage>(shared); }

// --------------------------------------------------------------------------------------------------------------------

TEST(AddingAPage, ItHasItsSectionOfTheDocumentAndItsCalls) {
  PageRig<> rig;
  rig.open(make_notes_page(rig.shared));
  EXPECT_EQ(rig.call("notes.count").result, Json({{"words", 0}}));

  rig.document.edit("/notes/text", "wood, sanded", "write a note");
  EXPECT_EQ(rig.call("notes.count").result, Json({{"words", 2}}));
  EXPECT_EQ(rig.document.undo_label(), "write a note");
  EXPECT_TRUE(rig.document.undo());
  EXPECT_EQ(rig.call("notes.count").result, Json({{"words", 0}}));

  EXPECT_THROW(rig.document.edit("/notes/text", 3, "write a number"), Error);
  EXPECT_THAT(rig.call("notes.lose").error, testing::HasSubstr("notes.lose"));
}

TEST(AddingAPage, ItsSectionIsInTheProjectsFile) {
  PageRig<> rig;
  rig.open(make_notes_page(rig.shared));
  rig.document.edit("/notes/text", "wood", "write a note");
  const auto file = rig.document.take_unsaved();
  ASSERT_TRUE(file);
  EXPECT_THAT(*file, testing::HasSubstr(R"("notes")"));
}

}  // namespace
}  // namespace asperity::studio

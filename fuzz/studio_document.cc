// A project's file as the studio's pages take it: refused with an Error, or each section is one that its page accepts,
// undo and redo lead there and back, and what would be saved is read again as the same.
#include <filesystem>
#include <memory>
#include <vector>

#include "asperity/base/error.h"
#include "asperity/studio/page.h"
#include "fuzz_input.h"
#include "pages.h"

namespace {

using namespace asperity::studio;
using asperity::Json;

class NobodyListens final : public Hub {
 public:
  void publish(std::string_view, std::string, Delivery) override {}
  bool has_subscribers(std::string_view) const override { return false; }
  void broadcast(std::string_view, const Json&) override {}
  void notify(ClientId, std::string_view, const Json&) override {}
  void answer(ClientId, std::uint64_t, const Json&) override {}
  void answer_block(ClientId, std::uint64_t, BlockWriter) override {}
  void refuse(ClientId, std::uint64_t, std::string_view, std::string_view) override {}
};

// The sections of all pages, as at the first start in an empty folder.
const Document& fresh_document() {
  struct Pages {
    NobodyListens hub;
    Project project{std::filesystem::temp_directory_path()};
    Document document{"project.json"};
    ForceLease lease;
    Calls calls;
    Jobs jobs{hub, [](std::function<void()>) {}};
    Shared shared{hub, project, document, jobs, lease, false, [](std::function<void()>) {}};
    std::vector<std::unique_ptr<Page>> pages = make_pages(shared, std::nullopt, {});  // no list of recent projects
    Pages() {
      for (const auto& page : pages) page->bind(document, calls);
    }
  };
  static Pages* const pages = new Pages;  // for ever: its pages end with the process
  return pages->document;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Document document = fresh_document();
  try {
    document.read(asperity::fuzz_text(data, size));
  } catch (const std::exception&) {
    return 0;
  }
  const auto go = [&document](bool back) {
    int steps = 0;
    try {
      for (; steps < 1000 && (back ? document.undo() : document.redo()); ++steps) {
      }
    } catch (const std::exception&) {  // its page does not take what would come of it: the step is dropped
    }
    return steps;
  };
  asperity::must(go(true) <= 200);
  go(false);
  if (const auto saved = document.take_unsaved()) {
    Document again = fresh_document();
    again.read(*saved);
    asperity::must(again.value() == document.value());
  }
  return 0;
}

// Edits a project's file as the studio does, one save after another, each forced through before the next:
//   save_document FILE COUNT
#include <cstdio>
#include <cstdlib>
#include <string>

#include "asperity/studio/document.h"
#include "file_saver.h"

int main(int argc, char** argv) {
  using namespace asperity::studio;
  if (argc != 3) return 2;
  int failures = 0;
  for (int k = 1; k <= std::atoi(argv[2]); ++k) {
    Document document(argv[1]);
    document.add_section("page", asperity::Json::object(), [](const asperity::Json&) {});
    document.load();
    document.edit("/page/number", k, "count");
    FileSaver saver(document.file(), [&failures](const std::string& why) {
      std::fprintf(stderr, "%s\n", why.c_str());
      ++failures;
    });
    saver.save(document.take_unsaved().value());
  }
  return failures;
}

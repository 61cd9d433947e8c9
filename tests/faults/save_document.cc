// Edits a project's file and saves it as the studio does: save_document FILE NUMBER
#include <cstdio>
#include <cstdlib>
#include <string>

#include "asperity/studio/document.h"
#include "file_saver.h"

int main(int argc, char** argv) {
  using namespace asperity::studio;
  if (argc != 3) return 2;
  Document document(argv[1]);
  document.add_section("page", asperity::Json::object(), [](const asperity::Json&) {});
  document.load();
  document.edit("/page/number", std::atoi(argv[2]), "count");
  int failures = 0;
  {
    FileSaver saver(document.file(), [&failures](const std::string& why) {
      std::fprintf(stderr, "%s\n", why.c_str());
      ++failures;
    });
    saver.save(document.take_unsaved().value());
  }
  return failures;
}

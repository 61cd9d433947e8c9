// Edits a project's file and saves it as the studio does: save_document FILE NUMBER. A file that cannot be read is put
// aside, as the studio does; then nothing is saved.
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <string>

#include "asperity/studio/document.h"
#include "file_saver.h"

namespace asperity::studio {
namespace {

int save_number(const char* file, int number) {
  Document document(file);
  document.add_section("page", Json::object(), [](const Json&) {});
  document.load();
  for (const std::string& problem : document.problems()) std::fprintf(stderr, "%s\n", problem.c_str());
  if (!document.problems().empty()) return 1;
  document.edit("/page/number", number, "count");
  // A try that failed is told, but what counts is whether all is on the disk at the end.
  FileSaver saver(document.file(), [](const std::string& why) { std::fprintf(stderr, "%s\n", why.c_str()); });
  saver.save(document.take_unsaved().value());
  return saver.finish().empty() ? 0 : 1;
}

}  // namespace
}  // namespace asperity::studio

int main(int argc, char** argv) {
  if (argc != 3) return 2;
  try {
    return asperity::studio::save_number(argv[1], std::atoi(argv[2]));
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}

#include "asperity/base/load_library.h"

#include <gmock/gmock.h>
#include <filesystem>

#include "asperity/base/error.h"

namespace asperity {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

TEST(LoadLibrary, TheFirstThatHasTheSymbols) {
  double (*cosine)(double) = nullptr;
  void (*none)() = nullptr;
  load_library("mathematics", {"/nowhere/libm.so", "libm.so.6"},
               {library_symbol("cos", cosine), library_symbol("no_such_function", none, false)});
  ASSERT_NE(cosine, nullptr);
  EXPECT_EQ(cosine(0.0), 1.0);
  EXPECT_EQ(none, nullptr);
}

TEST(LoadLibrary, AllThatWasSearchedForIsNamed) {
  void (*none)() = nullptr;
  EXPECT_THAT(
      [&] {
        load_library("gamepads", {"/nowhere/libx.so", "libm.so.6"}, {library_symbol("no_such_function", none)});
      },
      ThrowsMessage<Error>(AllOf(HasSubstr("gamepads was not found"), HasSubstr("/nowhere/libx.so: "),
                                 HasSubstr("libm.so.6: it has no function 'no_such_function'"))));
}

TEST(OwnLibrary, LiesWithTheProgram) {
  const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe");
  EXPECT_THAT(own_library_paths("libx.so"),
              testing::ElementsAre((program.parent_path().parent_path() / "lib/asperity/libx.so").string(),
                                   (program.parent_path() / "libx.so").string()));
  set_own_library_folder("/opt/x");
  EXPECT_THAT(own_library_paths("libx.so"), testing::ElementsAre("/opt/x/libx.so"));
  set_own_library_folder({});
}

}  // namespace
}  // namespace asperity

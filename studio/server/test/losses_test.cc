#include "losses.h"

#include <gmock/gmock.h>

#include <new>

#include "asperity/base/error.h"

namespace asperity::studio {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

TEST(Losses, NameWhatWasThrownAndWhatWasAdded) {
  Losses losses;
  bool is_done = false;
  losses.attempt("this is stored", [&] { is_done = true; });
  EXPECT_TRUE(is_done);
  EXPECT_THAT(losses.take(), IsEmpty());
  losses.attempt("the last changes could not be saved", [] { throw Error("state.json: cannot be written"); });
  losses.attempt("the last changes could not be saved", [] { throw std::bad_alloc(); });
  losses.attempt("the last changes could not be saved", [] { throw 7; });
  losses.add("the log feel.csv is lost");
  EXPECT_THAT(losses.take(),
              ElementsAre("the last changes could not be saved: state.json: cannot be written",
                          "the last changes could not be saved: std::bad_alloc",
                          "the last changes could not be saved: unknown error", "the log feel.csv is lost"));
  EXPECT_THAT(losses.take(), IsEmpty());
}

}  // namespace
}  // namespace asperity::studio

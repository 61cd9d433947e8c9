#pragma once

#include <exception>
#include <filesystem>
#include <new>
#include <stdexcept>
#include <string>
#include <string_view>

#include <asperity_feel.h>
#include "asperity/base/config.h"
#include "asperity/base/error.h"

namespace asperity::c_library {

// What the caller has given cannot be: his fault, not a file's.
class BadArgument : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// What asperity_last_error() gives from now on, on this thread; cut to fit.
void set_last_error(std::string_view text) noexcept;

// Runs `work`; what it throws becomes a status and the last error.
template <class Work>
asperity_status guarded(const Work& work) noexcept {
  try {
    work();
    return ASPERITY_OK;
  } catch (const BadArgument& fault) {
    set_last_error(fault.what());
    return ASPERITY_BAD_ARGUMENT;
  } catch (const Error& fault) {
    set_last_error(fault.what());
    return ASPERITY_BAD_FILE;
  } catch (const std::filesystem::filesystem_error& fault) {
    set_last_error(fault.path1().string() + ": " + fault.code().message());
    return ASPERITY_BAD_FILE;
  } catch (const std::length_error&) {
    set_last_error("a count is larger than any memory");
    return ASPERITY_BAD_ARGUMENT;
  } catch (const std::bad_alloc&) {
    set_last_error("there is not enough memory");
    return ASPERITY_NO_MEMORY;
  } catch (const std::exception& fault) {
    set_last_error(fault.what());
    return ASPERITY_INTERNAL;
  } catch (...) {
    set_last_error("an unknown fault");
    return ASPERITY_INTERNAL;
  }
}

// Throws BadArgument for a number that is not in the range.
double within(double value, const Range& range, const char* name);

// Throws BadArgument for NULL.
template <class T>
T& there(T* pointer, const char* name) {
  if (pointer == nullptr) throw BadArgument(std::string(name) + " is NULL");
  return *pointer;
}

}  // namespace asperity::c_library

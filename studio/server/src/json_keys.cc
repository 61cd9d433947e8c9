#include "json_keys.h"

#include <algorithm>
#include <string>

#include "asperity/base/error.h"
#include "asperity/base/text.h"

namespace asperity::studio {

void refuse_unknown(const Json& object, std::initializer_list<std::string_view> known, std::string_view page) {
  for (const auto& [key, value] : object.items()) {
    if (std::find(known.begin(), known.end(), key) == known.end()) {
      throw Error(std::string(page) + ": there is no '" + printable(key) + "'");
    }
  }
}

}  // namespace asperity::studio

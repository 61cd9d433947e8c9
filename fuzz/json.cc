// Any text: this reader and nlohmann's agree about what is JSON and what it says, apart from what this one refuses
// besides (a key twice, what is beyond the limits); what was read is written, read and written again to the same bytes;
// and the work stays in proportion to the size.
#include <cmath>
#include <string>

#include <nlohmann/json.hpp>

#include "asperity/base/error.h"
#include "asperity/json/parse_json.h"
#include "fuzz_input.h"

using namespace asperity;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using Oracle = nlohmann::ordered_json;
  const std::string_view text = fuzz_text(data, size);
  JsonLimits limits;
  limits.depth = 64;
  limits.values = 100'000;
  JsonWork work;
  try {
    const Json value = parse_json(text, "x.json", limits, {}, &work);
    const std::string written = value.dump();
    must(parse_json(written, "again", limits) == value && parse_json(value.dump(2), "again", limits).dump() == written);
    must(Oracle::parse(text).dump() == written);
    const auto values = static_cast<double>(work.values);
    must(work.bytes <= 3 * size + 100 && work.values <= size);
    must(static_cast<double>(work.comparisons) <= values * (4.0 * std::log2(values + 2.0) + 20.0));
  } catch (const Error& error) {
    const std::string_view what = error.what();
    must(what.starts_with("x.json:"));
    const auto beyond = [&](std::string_view limit) { return what.find(limit) != std::string_view::npos; };
    if (beyond("appears twice") || beyond("nested more than") || beyond("more than 100000 values")) return 0;
    must(Oracle::parse(text, nullptr, false).is_discarded());
  }
  return 0;
}

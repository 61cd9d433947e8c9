#pragma once

#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include "asperity/json/parse_json.h"
#include "asperity/studio/block.h"

namespace asperity::studio {

// A block as a browser would read it.
class ReadBlock {
 public:
  explicit ReadBlock(std::string frame) : frame_(std::move(frame)) {
    std::uint32_t bytes = 0;
    std::memcpy(&bytes, frame_.data() + 4, sizeof bytes);
    head = parse_json(frame_.substr(8, bytes));
  }

  // The numbers of an array; empty if there is none of the name. The type is accepted.
  template <class T>
  std::vector<T> array(const std::string& name) const {
    for (const Json& each : head.at("arrays")) {
      if (each.at("name") != name) continue;
      std::size_t count = 1;
      for (const Json& size : each.at("shape")) count *= size.get<std::size_t>();
      std::vector<T> out(count);
      const std::size_t offset = each.at("offset").get<std::size_t>();
      if (count > 0) std::memcpy(out.data(), frame_.data() + offset, count * sizeof(T));
      return out;
    }
    return {};
  }

  Json head;

 private:
  std::string frame_;
};

}  // namespace asperity::studio

#pragma once

#include <cstdint>
#include <cstring>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

#include "asperity/json/parse_json.h"
#include "asperity/studio/block.h"

namespace asperity::studio {

// A frame taken apart as the protocol describes it, all numbers as doubles.
struct ReadBlock {
  Json head;
  std::map<std::string, std::vector<double>> arrays;
  std::map<std::string, std::vector<std::size_t>> shapes;
};

template <class Number>
std::vector<double> numbers_at(const std::string& frame, std::size_t offset, std::size_t count) {
  std::vector<double> out;
  for (std::size_t i = 0; i < count; ++i) {
    Number number{};
    const std::string bytes = frame.substr(offset + i * sizeof(Number), sizeof(Number));
    if (bytes.size() != sizeof(Number)) throw std::runtime_error("cut off");
    std::memcpy(&number, bytes.data(), sizeof(Number));
    out.push_back(static_cast<double>(number));
  }
  return out;
}

inline ReadBlock read_block(const std::string& frame) {
  if (frame.substr(0, 4) != "ASB1") throw std::runtime_error("no block");
  std::uint32_t length = 0;
  std::memcpy(&length, frame.data() + 4, sizeof length);
  ReadBlock out;
  out.head = parse_json(frame.substr(8, length));
  for (const Json& array : out.head.at("arrays")) {
    const std::string name = array.at("name").text(), type = array.at("type").text();
    out.shapes[name] = array.at("shape").get<std::vector<std::size_t>>();
    std::size_t count = 1;
    for (const std::size_t size : out.shapes[name]) count *= size;
    const std::size_t offset = array.at("offset").get<std::size_t>();
    if (type == "f64") out.arrays[name] = numbers_at<double>(frame, offset, count);
    if (type == "f32") out.arrays[name] = numbers_at<float>(frame, offset, count);
    if (type == "u32") out.arrays[name] = numbers_at<std::uint32_t>(frame, offset, count);
    if (type == "i32") out.arrays[name] = numbers_at<std::int32_t>(frame, offset, count);
    if (type == "u8") out.arrays[name] = numbers_at<std::uint8_t>(frame, offset, count);
  }
  return out;
}

}  // namespace asperity::studio

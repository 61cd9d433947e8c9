#include "asperity/vision/predefined_dictionary.h"

namespace asperity {

namespace {

constexpr std::array<PredefinedDictionary, 21> kPredefined{{
    {"DICT_4X4_50", 0, 50},
    {"DICT_4X4_100", 1, 100},
    {"DICT_4X4_250", 2, 250},
    {"DICT_4X4_1000", 3, 1000},
    {"DICT_5X5_50", 4, 50},
    {"DICT_5X5_100", 5, 100},
    {"DICT_5X5_250", 6, 250},
    {"DICT_5X5_1000", 7, 1000},
    {"DICT_6X6_50", 8, 50},
    {"DICT_6X6_100", 9, 100},
    {"DICT_6X6_250", 10, 250},
    {"DICT_6X6_1000", 11, 1000},
    {"DICT_7X7_50", 12, 50},
    {"DICT_7X7_100", 13, 100},
    {"DICT_7X7_250", 14, 250},
    {"DICT_7X7_1000", 15, 1000},
    {"DICT_ARUCO_ORIGINAL", 16, 1024},
    {"DICT_APRILTAG_16h5", 17, 30},
    {"DICT_APRILTAG_25h9", 18, 35},
    {"DICT_APRILTAG_36h10", 19, 2320},
    {"DICT_APRILTAG_36h11", 20, 587},
}};

}  // namespace

std::optional<PredefinedDictionary> find_predefined_dictionary(std::string_view name) {
  for (const PredefinedDictionary& dictionary : kPredefined) {
    if (dictionary.name == name) return dictionary;
  }
  return std::nullopt;
}

std::string predefined_dictionary_names() {
  std::string out;
  for (const PredefinedDictionary& dictionary : kPredefined) {
    if (!out.empty()) out += ", ";
    out += dictionary.name;
  }
  return out;
}

}  // namespace asperity

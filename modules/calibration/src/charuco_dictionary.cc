#include "charuco_dictionary.h"

#include <opencv2/aruco.hpp>

namespace asperity {

namespace {

struct Entry {
  std::string_view name;
  CharucoDictionary dictionary;
};

constexpr Entry kEntries[] = {
    {"DICT_4X4_50", {cv::aruco::DICT_4X4_50, 50}},
    {"DICT_4X4_100", {cv::aruco::DICT_4X4_100, 100}},
    {"DICT_4X4_250", {cv::aruco::DICT_4X4_250, 250}},
    {"DICT_4X4_1000", {cv::aruco::DICT_4X4_1000, 1000}},
    {"DICT_5X5_50", {cv::aruco::DICT_5X5_50, 50}},
    {"DICT_5X5_100", {cv::aruco::DICT_5X5_100, 100}},
    {"DICT_5X5_250", {cv::aruco::DICT_5X5_250, 250}},
    {"DICT_5X5_1000", {cv::aruco::DICT_5X5_1000, 1000}},
    {"DICT_6X6_50", {cv::aruco::DICT_6X6_50, 50}},
    {"DICT_6X6_100", {cv::aruco::DICT_6X6_100, 100}},
    {"DICT_6X6_250", {cv::aruco::DICT_6X6_250, 250}},
    {"DICT_6X6_1000", {cv::aruco::DICT_6X6_1000, 1000}},
    {"DICT_7X7_50", {cv::aruco::DICT_7X7_50, 50}},
    {"DICT_7X7_100", {cv::aruco::DICT_7X7_100, 100}},
    {"DICT_7X7_250", {cv::aruco::DICT_7X7_250, 250}},
    {"DICT_7X7_1000", {cv::aruco::DICT_7X7_1000, 1000}},
    {"DICT_ARUCO_ORIGINAL", {cv::aruco::DICT_ARUCO_ORIGINAL, 1024}},
    {"DICT_APRILTAG_16h5", {cv::aruco::DICT_APRILTAG_16h5, 30}},
    {"DICT_APRILTAG_25h9", {cv::aruco::DICT_APRILTAG_25h9, 35}},
    {"DICT_APRILTAG_36h10", {cv::aruco::DICT_APRILTAG_36h10, 2320}},
    {"DICT_APRILTAG_36h11", {cv::aruco::DICT_APRILTAG_36h11, 587}},
};

}  // namespace

std::optional<CharucoDictionary> find_charuco_dictionary(std::string_view name) {
  for (const Entry& entry : kEntries) {
    if (entry.name == name) return entry.dictionary;
  }
  return std::nullopt;
}

}  // namespace asperity

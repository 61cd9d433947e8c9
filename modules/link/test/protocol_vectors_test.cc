// The vectors of docs/probe-protocol.md. Their bytes were made by a program of its own, with another language's CRC.
#include <gmock/gmock.h>
#include <sstream>
#include <string>

#include "asperity/base/error.h"
#include "asperity/link/open_protocol.h"

namespace asperity {
namespace {

using Bytes = std::vector<std::uint8_t>;

Bytes from_hex(const std::string& text) {
  std::istringstream in(text);
  Bytes out;
  for (unsigned value = 0; in >> std::hex >> value;) out.push_back(static_cast<std::uint8_t>(value));
  return out;
}

const Bytes kGyro = from_hex(
    "06 01 01 04 02 01 01 01 02 07 01 01 02 1c 01 01 04 40 42 0f 01 01 01 01 04 90 d0 03 02 01 06 fe ff 01 08 03 04 fc "
    "ff 05 01 01 01 02 01 02 ff 04 80 ff 7f 01 08 24 fa ff ff 40 e2 01 05 65 b4 f0 bf 00");
const Bytes kPlain = from_hex(
    "03 01 01 02 01 01 01 01 02 08 01 01 02 1e 01 01 04 34 44 0f 01 01 01 01 01 01 01 01 02 0a 02 14 02 1e 05 1d 94 c2 "
    "18 00");
const Bytes kForce3 = from_hex(
    "06 01 01 09 02 01 01 01 01 01 01 01 01 01 01 01 01 05 f2 05 2a 01 01 01 04 90 d0 03 02 01 02 02 02 03 02 04 02 05 "
    "02 06 02 64 01 01 06 ff ff ff ff 02 01 01 09 20 6c fb ff c2 1c 62 dd 00");
const Bytes kDescription = from_hex(
    "31 01 02 7b 22 6d 6f 64 65 6c 22 3a 22 6f 70 65 6e 22 2c 22 6e 61 6d 65 22 3a 22 70 22 2c 22 72 61 74 65 5f 68 7a "
    "22 3a 34 30 30 30 7d 83 23 07 ca 00");
const Bytes kRequest = from_hex("07 01 81 08 90 7d c2 00");

OpenSamples gyro_samples() {
  OpenSamples out;
  out.has_gyro = true;
  out.sequence = 7;
  out.imu_index = 28;
  out.time_us = 1'000'000;
  out.imu_period_ns = 250'000;
  out.row_count = 2;
  out.rows[0] = {{1, -2, 2049}, {3, -4, 5}};
  out.rows[1] = {{0, 256, -256}, {-32768, 32767, 0}};
  out.force_count = 1;
  out.forces[0] = {-1500, {123456, 0, 0}};
  return out;
}

OpenSamples plain_samples() {
  OpenSamples out;
  out.sequence = 8;
  out.imu_index = 30;
  out.time_us = 1'000'500;
  out.row_count = 1;
  out.rows[0].accel = {10, 20, 30};
  return out;
}

OpenSamples force3_samples() {
  OpenSamples out;
  out.start = true;
  out.has_force3 = true;
  out.time_us = 5'000'000'000;
  out.imu_period_ns = 250'000;
  out.row_count = 2;
  out.rows[0].accel = {1, 2, 3};
  out.rows[1].accel = {4, 5, 6};
  out.force_count = 1;
  out.forces[0] = {100, {-1, 2, -300'000}};
  return out;
}

void expect_vector(const OpenSamples& samples, const Bytes& frame) {
  Bytes written;
  append_open_samples(samples, written);
  EXPECT_EQ(written, frame);

  OpenPayload room;
  const auto payload = open_block_payload(std::span(frame).first(frame.size() - 1), room);
  ASSERT_TRUE(payload.has_value());
  OpenSamples read;
  ASSERT_TRUE(parse_open_samples(*payload, read));
  EXPECT_EQ(read.start, samples.start);
  EXPECT_EQ(read.sequence, samples.sequence);
  EXPECT_EQ(read.imu_index, samples.imu_index);
  EXPECT_EQ(read.time_us, samples.time_us);
  EXPECT_EQ(read.imu_period_ns, samples.imu_period_ns);
  ASSERT_EQ(read.row_count, samples.row_count);
  ASSERT_EQ(read.force_count, samples.force_count);
  for (std::size_t i = 0; i < samples.row_count; ++i) {
    EXPECT_EQ(read.rows[i].accel, samples.rows[i].accel);
    EXPECT_EQ(read.rows[i].gyro, samples.rows[i].gyro);
  }
  for (std::size_t i = 0; i < samples.force_count; ++i) {
    EXPECT_EQ(read.forces[i].offset_us, samples.forces[i].offset_us);
    EXPECT_EQ(read.forces[i].counts, samples.forces[i].counts);
  }
}

TEST(ProtocolVectors, SamplesWithGyroscope) { expect_vector(gyro_samples(), kGyro); }
TEST(ProtocolVectors, SamplesWithout) { expect_vector(plain_samples(), kPlain); }
TEST(ProtocolVectors, ThreeAxisForce) { expect_vector(force3_samples(), kForce3); }

TEST(ProtocolVectors, Description) {
  const std::string json = R"({"model":"open","name":"p","rate_hz":4000})";
  Bytes written;
  append_open_description(json, written);
  EXPECT_EQ(written, kDescription);
  const auto description = parse_open_description(json);
  ASSERT_TRUE(description.has_value());
  EXPECT_EQ(description->name, "p");
  EXPECT_EQ(description->rate_Hz, 4000.0);
  EXPECT_FALSE(description->has_gyro);
}

TEST(ProtocolVectors, Request) {
  Bytes written;
  append_open_request(written);
  EXPECT_EQ(written, kRequest);
}

TEST(OpenProtocol, DescriptionIsReadAsItWasWritten) {
  ProbeDescription description;
  description.model = "open";
  description.name = "a \"name\"\n\x01 \\ ü";
  description.firmware = "1.0.0";
  description.rate_Hz = 4000.0;
  description.adc_min = -32768.0;
  description.adc_max = 32767.0;
  description.accel_counts_per_mps2 = 208.848;
  description.has_gyro = true;
  description.gyro_counts_per_radps = 939.65;
  description.force_axes = 3;
  description.force_rate_Hz = 330.0;
  description.force_newton_per_count = 1.2e-6;
  const auto read = parse_open_description(format_open_description(description));
  ASSERT_TRUE(read.has_value());
  EXPECT_EQ(read->name, description.name);
  EXPECT_EQ(read->force_axes, 3);
  EXPECT_EQ(read->force_newton_per_count, 1.2e-6);
  EXPECT_EQ(format_open_description(*read), format_open_description(description));
}

TEST(OpenProtocol, WhatCannotBeSentIsRefused) {
  Bytes out;
  OpenSamples samples;
  samples.row_count = 65;
  samples.imu_period_ns = 1;
  EXPECT_THROW(append_open_samples(samples, out), Error);
  samples.row_count = 2;
  samples.imu_period_ns = 0;
  EXPECT_THROW(append_open_samples(samples, out), Error);
  EXPECT_THROW(append_open_frame(Bytes(1), out), Error);
  EXPECT_THROW(append_open_frame(Bytes(1201), out), Error);
  EXPECT_THROW(append_open_description(std::string(1025, ' '), out), Error);
  ProbeDescription description;
  description.name = std::string(65, 'a');
  EXPECT_THROW(format_open_description(description), Error);
  description = {};
  description.rate_Hz = 1e6;
  EXPECT_THROW(format_open_description(description), Error);
  description = {};
  description.force_axes = 2;
  EXPECT_THROW(format_open_description(description), Error);
  EXPECT_TRUE(out.empty());
}

// The largest frame that the counts allow fits the largest payload.
TEST(OpenProtocol, FullFrame) {
  OpenSamples samples = force3_samples();
  samples.has_gyro = true;
  samples.row_count = kOpenMaxRows;
  samples.force_count = kOpenMaxForces;
  for (auto& row : samples.rows) row = {{-1, 0, 1}, {2, 3, 4}};
  for (auto& force : samples.forces) force = {-1, {1, 0, -1}};
  Bytes frame;
  append_open_samples(samples, frame);
  expect_vector(samples, frame);
}

}  // namespace
}  // namespace asperity

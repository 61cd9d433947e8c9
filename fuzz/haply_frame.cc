// A frame or a version of an Inverse Service is refused with an Error, or gives numbers within the limits and a device
// id that a command can name.
#include "asperity/base/error.h"
#include "fuzz_input.h"
#include "haply_protocol.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view input = asperity::fuzz_text(data, size);
  try {
    asperity::parse_service_version(input);
  } catch (const asperity::Error&) {  // most inputs are frames
  }
  asperity::HaplyState state;
  try {
    state = asperity::parse_haply_frame(input, "");
  } catch (const asperity::Error&) {
    return 0;
  }
  asperity::must(state.p_m.cwiseAbs().maxCoeff() <= 10.0 && state.v_mps.cwiseAbs().maxCoeff() <= 100.0);
  // What names the device there names it here, unchanged by JSON's quoting.
  std::string command;
  asperity::write_haply_command(command, state.device_id, state.p_m, asperity::HaplyForceKey::kVector, true);
  asperity::must(command.find("\"" + state.device_id + "\"") != std::string::npos);
  const std::string answer = R"({"inverse3":[{"device_id":")" + state.device_id +
                             R"(","state":{"cursor_position":{"x":1,"y":2,"z":3},)" +
                             R"("cursor_velocity":{"x":0,"y":0,"z":0}}}]})";
  asperity::must(asperity::parse_haply_frame(answer, state.device_id).p_m.x() == 1.0);
  return 0;
}

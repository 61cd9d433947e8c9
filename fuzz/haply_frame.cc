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
  try {
    const asperity::HaplyState state = asperity::parse_haply_frame(input, "");
    asperity::must(state.p_m.cwiseAbs().maxCoeff() <= 10.0 && state.v_mps.cwiseAbs().maxCoeff() <= 100.0);
    // A command is a frame's skeleton: what names the device there names it here.
    std::string command;
    asperity::write_haply_command(command, state.device_id, state.p_m, asperity::HaplyForceKey::kVector, true);
    const std::string answer =
        R"({"inverse3":[{"device_id":")" + state.device_id +
        R"(","state":{"cursor_position":{"x":1,"y":2,"z":3},"cursor_velocity":{"x":0,"y":0,"z":0}}}]})";
    asperity::must(asperity::parse_haply_frame(answer, state.device_id).p_m.x() == 1.0);
    asperity::must(command.find(state.device_id) != std::string::npos);
  } catch (const asperity::Error&) {
    return 0;
  }
  return 0;
}

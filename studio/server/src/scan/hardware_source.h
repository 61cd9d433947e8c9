#pragma once

#include <memory>
#include <string>

#include "asperity/session/record_input.h"
#include "scan/scan_source.h"

namespace asperity::studio {

// What `asperity record` reads from. `input` has paths, `world` is camera or z_up. Reads the calibration. Throws Error
// naming the file or the address.
std::unique_ptr<ScanSource> make_hardware_source(const RecordInput& input, const std::string& world);

}  // namespace asperity::studio

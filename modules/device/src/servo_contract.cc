#include "asperity/device/device_frame.h"
#include "asperity/device/haptic_device.h"
#include "asperity/device/servo_loop.h"

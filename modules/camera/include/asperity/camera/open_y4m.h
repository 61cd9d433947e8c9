#pragma once

#include <memory>
#include <string>

#include "asperity/camera/camera_source.h"

namespace asperity {

// A YUV4MPEG2 stream (image/y4m.h) from a file, a FIFO, a character device or "-", standard input: the way for
// any camera that another program can read, and for the virtual bench.
//
// A frame's t_ns is its Xt_ns; without one the time at which its last byte had come, or in a file its index over the
// header's rate. Times have to rise, and either all frames have an Xt_ns or none. Memory: two images.
//
// Opening a FIFO does not wait for its writer. Throws Error if `path` cannot be opened or, for a file, is no such
// stream; read() throws Error for a stream that is not what it should be, naming the frame, and LinkLost at the end
// or when the writer has gone, also inside a frame.
std::unique_ptr<CameraSource> open_y4m(const std::string& path);

}  // namespace asperity

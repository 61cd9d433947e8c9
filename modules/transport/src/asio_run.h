#pragma once

#include <chrono>

// Beast and Asio of Boost 1.74 use std::exchange without its header.
#include <utility>

#include <boost/asio/io_context.hpp>

namespace asperity {

// Runs `context` until `done`, which a handler of it sets, or `timeout` is over; then `cancel()` must make the handler
// run, so that nothing of the operation is left when this returns.
template <class Cancel>
void run_within(boost::asio::io_context& context, const bool& done, std::chrono::milliseconds timeout,
                const Cancel& cancel) {
  context.restart();
  context.poll();
  if (!done) context.restart();
  if (!done) context.run_for(timeout);
  if (done) return;
  cancel();
  context.restart();
  context.run();
}

}  // namespace asperity

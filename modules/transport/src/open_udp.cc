// Asio's fences are for contexts of several threads; ours have one, and the thread sanitizer knows no fences.
#define BOOST_ASIO_DISABLE_FENCED_BLOCK
#include "asperity/transport/open_udp.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <deque>
#include <iterator>
#include <optional>
#include <vector>

// Asio of Boost 1.74 uses std::exchange without its header.
#include <utility>

#include <boost/asio/io_context.hpp>

#include <fmt/format.h>
#include <boost/asio/buffer.hpp>
#include <boost/asio/ip/udp.hpp>

#include "asperity/base/host_clock.h"
#include "asperity/base/text.h"

namespace asperity {

namespace asio = boost::asio;
using asio::ip::udp;

namespace {

// Runs `context` until `done`, which a handler of it sets, or `timeout` is over; then `cancel()` must make the handler
// run, so that nothing of the operation is left when this returns.
template <class Cancel>
void run_within(asio::io_context& context, const bool& done, std::chrono::milliseconds timeout, const Cancel& cancel) {
  context.restart();
  context.poll();
  if (!done) context.restart();
  if (!done) context.run_for(timeout);
  if (done) return;
  cancel();
  context.restart();
  context.run();
}

constexpr std::size_t kLargestDatagram_bytes = 65536;
constexpr int kReceiveBuffer_bytes = 1 << 20;
constexpr std::size_t kMostCandidates = 8;
constexpr std::ptrdiff_t kCandidate_bytes = 4096;

std::string endpoint_text(const std::string& address, unsigned port) {
  const bool is_v6 = address.find(':') != std::string::npos;
  return fmt::format(fmt::runtime(is_v6 ? "udp:[{}]:{}" : "udp:{}:{}"), printable(address, 200), port);
}

class UdpSource : public ByteSource {
 public:
  explicit UdpSource(const UdpConfig& config) : config_(config), socket_(context_) {
    name_ = endpoint_text(config.address, config.port);
    boost::system::error_code error;
    const auto address = asio::ip::make_address(config.address, error);
    if (error) throw Error(name_ + ": not an IP address of this host; 0.0.0.0 hears all");
    const udp::endpoint endpoint(address, config.port);
    socket_.open(endpoint.protocol(), error);
    if (!error) socket_.bind(endpoint, error);
    if (error == asio::error::address_in_use) throw Error(name_ + ": is in use by another program; take another port");
    if (error == asio::error::access_denied) throw Error(name_ + ": not permitted; take a port above 1023");
    if (error) throw Error(name_ + ": cannot be bound: " + error.message());
    // Room for what comes while this process is not running; a smaller one works too.
    socket_.set_option(asio::socket_base::receive_buffer_size(kReceiveBuffer_bytes), error);
    name_ = endpoint_text(config.address, socket_.local_endpoint().port());
  }

  Arrival read(std::span<std::uint8_t> into, std::chrono::milliseconds timeout) override {
    if (into.empty()) return {};
    const auto until = std::chrono::steady_clock::now() + timeout;
    while (begin_ == end_) {
      const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(until - std::chrono::steady_clock::now());
      if (!receive(std::max(left, std::chrono::milliseconds(0)))) return {};
      // Strangers who send without end must not keep the caller here.
      if (begin_ == end_ && std::chrono::steady_clock::now() >= until) return {};
    }
    Arrival arrival{std::min(into.size(), end_ - begin_), arrival_ns_};
    std::memcpy(into.data(), datagram_.data() + begin_, arrival.count);
    begin_ += arrival.count;
    return arrival;
  }

  bool write(std::span<const std::uint8_t> bytes) override {
    if (!sender_) return false;
    boost::system::error_code error;
    socket_.non_blocking(true, error);
    socket_.send_to(asio::buffer(bytes.data(), bytes.size()), *sender_, 0, error);
    return !error;
  }

  std::string name() const override { return name_; }

 private:
  // False if nothing came in time; a datagram that is not for us leaves nothing to read.
  bool receive(std::chrono::milliseconds timeout) {
    bool done = false;
    std::size_t count = 0;
    udp::endpoint from;
    boost::system::error_code error;
    socket_.async_receive_from(asio::buffer(datagram_), from,
                               [&](const boost::system::error_code& result, std::size_t received) {
                                 count = received;
                                 error = result;
                                 done = true;
                               });
    run_within(context_, done, timeout, [this] {
      boost::system::error_code ignored;
      socket_.cancel(ignored);
    });
    if (error == asio::error::operation_aborted) return false;
    // An earlier answer of ours found nobody listening: no matter of the probe's.
    if (error == asio::error::connection_refused) return true;
    if (error) throw Error(name_ + ": " + error.message());
    const std::int64_t now_ns = host_now_ns();
    if (!is_probe(from, now_ns) || !has_shown(from, count)) return true;
    sender_ = from;
    arrival_ns_ = now_ns;
    begin_ = 0;
    end_ = count;
    return true;
  }

  bool is_probe(const udp::endpoint& from, std::int64_t now_ns) const {
    if (config_.any_sender || !sender_ || from == *sender_) return true;
    return from.address() == sender_->address() && 1e-9 * static_cast<double>(now_ns - arrival_ns_) > config_.silence_s;
  }

  // A sender that was heard before has. Of others the newest bytes of the newest few are kept: a frame of a protocol
  // may take several datagrams.
  bool has_shown(const udp::endpoint& from, std::size_t count) {
    if (!config_.shows_sender || (sender_ && from == *sender_)) return true;
    auto candidate = std::find_if(candidates_.begin(), candidates_.end(),
                                  [&](const Candidate& known) { return known.endpoint == from; });
    if (candidate == candidates_.end()) {
      if (candidates_.size() >= kMostCandidates) candidates_.pop_front();
      candidate = candidates_.insert(candidates_.end(), Candidate{from, {}});
    }
    std::vector<std::uint8_t>& bytes = candidate->bytes;
    bytes.insert(bytes.end(), datagram_.begin(), datagram_.begin() + static_cast<std::ptrdiff_t>(count));
    const bool shown = config_.shows_sender(bytes);
    if (shown) {
      candidates_.clear();
    } else if (std::ssize(bytes) > kCandidate_bytes) {
      bytes.erase(bytes.begin(), bytes.end() - kCandidate_bytes);
    }
    return shown;
  }

  struct Candidate {
    udp::endpoint endpoint;
    std::vector<std::uint8_t> bytes;
  };

  UdpConfig config_;
  std::string name_;
  std::deque<Candidate> candidates_;  // who have not shown that they are the probe
  asio::io_context context_{1};
  udp::socket socket_;
  std::optional<udp::endpoint> sender_;
  std::array<std::uint8_t, kLargestDatagram_bytes> datagram_{};
  std::size_t begin_ = 0;
  std::size_t end_ = 0;
  std::int64_t arrival_ns_ = 0;
};

}  // namespace

std::unique_ptr<ByteSource> open_udp(const UdpConfig& config) { return std::make_unique<UdpSource>(config); }

}  // namespace asperity

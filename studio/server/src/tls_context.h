#pragma once

#include <ctime>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

struct ssl_ctx_st;

namespace asperity::studio {

struct FreeTlsContext {
  void operator()(ssl_ctx_st* context) const noexcept;
};

struct TlsContext {
  std::unique_ptr<ssl_ctx_st, FreeTlsContext> context;
  std::vector<std::string> warnings;  // of a certificate that browsers will not take: expired, of another name
};

// A server's certificate, with those of its authorities behind it, and its key, both PEM; TLS 1.2 at least. `host` is
// where it will listen and `now` the time to judge by. Throws Error naming the file: unreadable, not PEM, a key that
// other users can read, that needs a password, or that does not belong to the certificate.
TlsContext load_tls(const std::filesystem::path& certificate, const std::filesystem::path& key, const std::string& host,
                    std::time_t now);

}  // namespace asperity::studio

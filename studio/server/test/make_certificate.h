#pragma once

#include <filesystem>
#include <string>

namespace asperity::studio {

struct CertificateMaker {
  std::string names = "DNS:localhost,IP:127.0.0.1";
  long from_s = -60, until_s = 3600;  // relative to now
  int rsa_bits = 0;                   // 0: P-256
};

// A self-signed certificate and its key in PEM, the key for its owner alone.
void make_certificate(const std::filesystem::path& certificate, const std::filesystem::path& key,
                      const CertificateMaker& maker = {});

// Writes a key again, with a password.
void lock_key(const std::filesystem::path& key, const std::string& password);

}  // namespace asperity::studio

#include "tls_context.h"

#include <arpa/inet.h>
#include <fcntl.h>
#include <openssl/err.h>
#include <openssl/pem.h>
#include <openssl/ssl.h>
#include <openssl/x509v3.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "asperity/base/error.h"
#include "asperity/base/text.h"
#include "server_limits.h"

namespace asperity::studio {

namespace {

namespace fs = std::filesystem;

template <auto kFree>
struct Free {
  template <class T>
  void operator()(T* object) const noexcept {
    kFree(object);
  }
};
using Bio = std::unique_ptr<BIO, Free<BIO_free_all>>;
using Certificate = std::unique_ptr<X509, Free<X509_free>>;
using PrivateKey = std::unique_ptr<EVP_PKEY, Free<EVP_PKEY_free>>;

[[noreturn]] void refuse_file(const fs::path& file, const std::string& why) {
  throw Error(printable(file.string(), 200) + ": " + why);
}

// The message of OpenSSL's last error, which is cleared.
std::string last_reason() {
  const unsigned long code = ERR_peek_last_error();
  const char* reason = ERR_reason_error_string(code);
  ERR_clear_error();
  return reason == nullptr ? "unknown" : reason;
}

class PemFile {
 public:
  explicit PemFile(const fs::path& path) : path_(path), file_(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK)) {
    if (file_ < 0) refuse_file(path, std::string("cannot be read: ") + std::strerror(errno));
  }
  ~PemFile() { ::close(file_); }
  PemFile(const PemFile&) = delete;
  PemFile& operator=(const PemFile&) = delete;

  struct stat status() const {
    struct stat out {};
    if (fstat(file_, &out) != 0 || !S_ISREG(out.st_mode)) refuse_file(path_, "is not a file");
    return out;
  }

  std::string read() const {
    status();
    std::string out(kMostPemBytes + 1, '\0');
    std::size_t size = 0;
    while (size < out.size()) {
      const ssize_t got = ::read(file_, out.data() + size, out.size() - size);
      if (got < 0) refuse_file(path_, std::string("cannot be read: ") + std::strerror(errno));
      if (got == 0) break;
      size += static_cast<std::size_t>(got);
    }
    if (size > kMostPemBytes)
      refuse_file(path_, "is longer than 256 KiB, too long for a PEM file of a certificate or key");
    out.resize(size);
    return out;
  }

 private:
  const fs::path& path_;
  int file_;
};

// As of PostgreSQL's key: the owner's alone, or root's with a group that may read.
void check_is_private(const fs::path& path, const struct stat& status) {
  const unsigned open_to = status.st_mode & 077U;
  if (open_to == 0) return;
  if (status.st_uid == 0 && open_to == 040U && ::geteuid() != 0) return;
  refuse_file(path, "other users can read or change this key; chmod 600 it");
}

// The password of a key is not asked for. Sets `*asked`.
int no_password(char*, int, int, void* asked) {
  *static_cast<bool*>(asked) = true;
  return -1;
}

Bio bio_of(const std::string& text) { return Bio(BIO_new_mem_buf(text.data(), static_cast<int>(text.size()))); }

Certificate use_certificates(SSL_CTX* context, const fs::path& path) {
  const std::string text = PemFile(path).read();
  const Bio bio = bio_of(text);
  Certificate leaf(PEM_read_bio_X509(bio.get(), nullptr, nullptr, nullptr));
  if (!leaf) refuse_file(path, "no certificate in PEM form (-----BEGIN CERTIFICATE-----): " + last_reason());
  if (SSL_CTX_use_certificate(context, leaf.get()) != 1)
    refuse_file(path, "this certificate is not usable: " + last_reason());
  for (int more = 1;; ++more) {
    Certificate next(PEM_read_bio_X509(bio.get(), nullptr, nullptr, nullptr));
    if (!next) {
      if (ERR_GET_REASON(ERR_peek_last_error()) == PEM_R_NO_START_LINE) break;
      refuse_file(path, "certificate " + std::to_string(more + 1) + " in it is damaged: " + last_reason());
    }
    if (more >= kMostCertificates)
      refuse_file(path, "more than 10 certificates; it needs only its own and those of its authorities");
    if (SSL_CTX_add1_chain_cert(context, next.get()) != 1) refuse_file(path, "not usable: " + last_reason());
  }
  ERR_clear_error();
  return leaf;
}

void use_key(SSL_CTX* context, const fs::path& path, const fs::path& certificate) {
  const PemFile file(path);
  check_is_private(path, file.status());
  std::string text = file.read();
  bool asked = false;
  const Bio bio = bio_of(text);
  const PrivateKey key(PEM_read_bio_PrivateKey(bio.get(), nullptr, no_password, &asked));
  OPENSSL_cleanse(text.data(), text.size());
  if (!key) {
    const std::string why = last_reason();
    refuse_file(path, asked ? "this key has a password; remove it: openssl pkey -in … -out …"
                            : "no private key in PEM form (-----BEGIN PRIVATE KEY-----): " + why);
  }
  if (SSL_CTX_use_PrivateKey(context, key.get()) != 1 || SSL_CTX_check_private_key(context) != 1) {
    refuse_file(path,
                "does not belong to the certificate " + printable(certificate.string(), 200) + ": " + last_reason());
  }
}

bool is_ip_number(const std::string& host) {
  in6_addr bytes{};
  return inet_pton(AF_INET, host.c_str(), &bytes) == 1 || inet_pton(AF_INET6, host.c_str(), &bytes) == 1;
}

bool covers(X509* certificate, const std::string& host) {
  if (host == "0.0.0.0" || host == "::") return true;  // which of the machine's names will be used is not known
  if (is_ip_number(host)) return X509_check_ip_asc(certificate, host.c_str(), 0) == 1;
  return X509_check_host(certificate, host.c_str(), host.size(), 0, nullptr) == 1;
}

std::vector<std::string> warnings_of(X509* certificate, const fs::path& path, const std::string& host,
                                     std::time_t now) {
  const std::string name = printable(path.string(), 200);
  std::vector<std::string> out;
  if (X509_cmp_time(X509_get0_notAfter(certificate), &now) < 0) {
    out.push_back(name + ": this certificate has expired; browsers will warn");
  } else if (X509_cmp_time(X509_get0_notBefore(certificate), &now) > 0) {
    out.push_back(name + ": this certificate is not valid yet; check this machine's clock");
  }
  if (!covers(certificate, host)) {
    out.push_back(name + ": this certificate is not for '" + printable(host) + "'; browsers will warn");
  }
  return out;
}

}  // namespace

void FreeTlsContext::operator()(ssl_ctx_st* context) const noexcept { SSL_CTX_free(context); }

TlsContext load_tls(const fs::path& certificate, const fs::path& key, const std::string& host, std::time_t now) {
  ERR_clear_error();
  TlsContext out;
  out.context.reset(SSL_CTX_new(TLS_server_method()));
  SSL_CTX* context = out.context.get();
  if (context == nullptr) throw Error("TLS cannot be set up: " + last_reason());
  SSL_CTX_set_min_proto_version(context, TLS1_2_VERSION);
  // A client must not have keys made again and again, nor the server keep any.
  SSL_CTX_set_options(
      context, SSL_OP_NO_RENEGOTIATION | SSL_OP_NO_COMPRESSION | SSL_OP_NO_TICKET | SSL_OP_CIPHER_SERVER_PREFERENCE);
  SSL_CTX_set_num_tickets(context, 0);
  SSL_CTX_set_session_cache_mode(context, SSL_SESS_CACHE_OFF);
  // Of TLS 1.2 only what keeps past traffic secret when the key becomes known.
  if (SSL_CTX_set_cipher_list(context, "ECDHE+AESGCM:ECDHE+CHACHA20") != 1) {
    throw Error("TLS cannot be set up: " + last_reason());
  }
  const Certificate leaf = use_certificates(context, certificate);
  use_key(context, key, certificate);
  out.warnings = warnings_of(leaf.get(), certificate, host, now);
  return out;
}

}  // namespace asperity::studio

#include "make_certificate.h"

#include <openssl/evp.h>
#include <openssl/pem.h>
#include <openssl/rsa.h>
#include <openssl/x509v3.h>
#include <sys/stat.h>

#include <cstdio>
#include <memory>
#include <stdexcept>

namespace asperity::studio {

namespace {

void check(bool done) {
  if (!done) throw std::runtime_error("no certificate could be made");
}

std::unique_ptr<FILE, int (*)(FILE*)> open_to_write(const std::filesystem::path& path) {
  std::unique_ptr<FILE, int (*)(FILE*)> out(std::fopen(path.c_str(), "w"), std::fclose);
  check(out != nullptr);
  check(chmod(path.c_str(), 0600) == 0);
  return out;
}

}  // namespace

void make_certificate(const std::filesystem::path& certificate, const std::filesystem::path& key,
                      const CertificateMaker& maker) {
  const std::unique_ptr<EVP_PKEY, void (*)(EVP_PKEY*)> pair(
      maker.rsa_bits > 0 ? EVP_RSA_gen(static_cast<unsigned>(maker.rsa_bits)) : EVP_EC_gen("P-256"), EVP_PKEY_free);
  const std::unique_ptr<X509, void (*)(X509*)> made(X509_new(), X509_free);
  check(pair && made);
  X509_set_version(made.get(), X509_VERSION_3);
  ASN1_INTEGER_set(X509_get_serialNumber(made.get()), 1);
  X509_gmtime_adj(X509_getm_notBefore(made.get()), maker.from_s);
  X509_gmtime_adj(X509_getm_notAfter(made.get()), maker.until_s);
  X509_set_pubkey(made.get(), pair.get());
  X509_NAME* name = X509_get_subject_name(made.get());
  const unsigned char common[] = "bench";
  X509_NAME_add_entry_by_txt(name, "CN", MBSTRING_ASC, common, -1, -1, 0);
  X509_set_issuer_name(made.get(), name);
  X509_EXTENSION* names = X509V3_EXT_conf_nid(nullptr, nullptr, NID_subject_alt_name, maker.names.c_str());
  check(names != nullptr);
  X509_add_ext(made.get(), names, -1);
  X509_EXTENSION_free(names);
  check(X509_sign(made.get(), pair.get(), EVP_sha256()) > 0);
  check(PEM_write_X509(open_to_write(certificate).get(), made.get()) == 1);
  check(PEM_write_PrivateKey(open_to_write(key).get(), pair.get(), nullptr, nullptr, 0, nullptr, nullptr) == 1);
}

void lock_key(const std::filesystem::path& key, const std::string& password) {
  const std::unique_ptr<FILE, int (*)(FILE*)> in(std::fopen(key.c_str(), "r"), std::fclose);
  check(in != nullptr);
  const std::unique_ptr<EVP_PKEY, void (*)(EVP_PKEY*)> pair(PEM_read_PrivateKey(in.get(), nullptr, nullptr, nullptr),
                                                            EVP_PKEY_free);
  check(pair != nullptr);
  check(PEM_write_PrivateKey(open_to_write(key).get(), pair.get(), EVP_aes_128_cbc(),
                             reinterpret_cast<const unsigned char*>(password.data()), static_cast<int>(password.size()),
                             nullptr, nullptr) == 1);
}

}  // namespace asperity::studio

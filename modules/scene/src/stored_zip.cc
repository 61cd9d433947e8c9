#include "stored_zip.h"

#include <zip.h>

#include <cstdint>
#include <memory>

#include "asperity/base/error.h"

namespace asperity {
namespace {

constexpr std::uint16_t kFirstDay = 1 << 5 | 1;  // 1980-01-01

struct SourceDeleter {
  void operator()(zip_source_t* source) const { zip_source_free(source); }
};
struct ArchiveDeleter {
  void operator()(zip_t* archive) const { zip_discard(archive); }
};
using Source = std::unique_ptr<zip_source_t, SourceDeleter>;
using Archive = std::unique_ptr<zip_t, ArchiveDeleter>;

[[noreturn]] void fail(zip_error_t* error) { throw Error(std::string("zip: ") + zip_error_strerror(error)); }

void add_member(zip_t* archive, const ZipMember& member) {
  Source content(zip_source_buffer(archive, member.content.data(), member.content.size(), 0));
  if (!content) fail(zip_get_error(archive));
  const zip_int64_t index = zip_file_add(archive, member.name.c_str(), content.get(), ZIP_FL_ENC_UTF_8);
  if (index < 0) fail(zip_get_error(archive));
  content.release();  // the archive's from here on
  const auto at = static_cast<zip_uint64_t>(index);
  if (zip_set_file_compression(archive, at, ZIP_CM_STORE, 0) != 0 ||
      zip_file_set_dostime(archive, at, 0, kFirstDay, 0) != 0 ||
      zip_file_set_external_attributes(archive, at, 0, ZIP_OPSYS_DOS, 0) != 0)
    fail(zip_get_error(archive));
}

std::string read_all(zip_source_t* source) {
  zip_stat_t stat;
  if (zip_source_stat(source, &stat) != 0 || zip_source_open(source) != 0) fail(zip_source_error(source));
  std::string out(stat.size, '\0');
  const zip_int64_t count = zip_source_read(source, out.data(), out.size());
  zip_source_close(source);
  if (count != static_cast<zip_int64_t>(out.size())) fail(zip_source_error(source));
  return out;
}

}  // namespace

std::string format_stored_zip(const std::vector<ZipMember>& members) {
  std::uint64_t size = 0;
  for (const ZipMember& member : members) size += member.content.size();
  if (size > 0xFFFF0000u) throw Error("zip: more than 4 GiB");
  zip_error_t error;
  zip_error_init(&error);
  const Source bytes(zip_source_buffer_create(nullptr, 0, 0, &error));
  if (!bytes) fail(&error);
  Archive archive(zip_open_from_source(bytes.get(), ZIP_TRUNCATE, &error));
  if (!archive) fail(&error);
  zip_source_keep(bytes.get());  // the archive has taken one reference, we keep another
  for (const ZipMember& member : members) add_member(archive.get(), member);
  if (zip_close(archive.get()) != 0) fail(zip_get_error(archive.get()));
  archive.release();
  return read_all(bytes.get());
}

}  // namespace asperity

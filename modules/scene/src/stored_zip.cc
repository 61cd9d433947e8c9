#include "stored_zip.h"

#include <cstdint>

#include "asperity/base/crc32.h"
#include "asperity/base/error.h"
#include "asperity/base/little_endian.h"

namespace asperity {
namespace {

// What a member's header and its entry in the directory have in common.
void append_description(std::string& out, const ZipMember& member) {
  constexpr std::uint16_t kVersion = 20;
  constexpr std::uint16_t kFirstDay = 1 << 5 | 1;  // 1980-01-01
  append_little_endian<std::uint16_t>(out, kVersion);
  append_little_endian<std::uint16_t>(out, 0);  // flags
  append_little_endian<std::uint16_t>(out, 0);  // stored
  append_little_endian<std::uint16_t>(out, 0);  // midnight
  append_little_endian<std::uint16_t>(out, kFirstDay);
  append_little_endian<std::uint32_t>(out, crc32(member.content));
  append_little_endian(out, static_cast<std::uint32_t>(member.content.size()));
  append_little_endian(out, static_cast<std::uint32_t>(member.content.size()));
  append_little_endian(out, static_cast<std::uint16_t>(member.name.size()));
  append_little_endian<std::uint16_t>(out, 0);  // extra fields
}

}  // namespace

std::string format_stored_zip(const std::vector<ZipMember>& members) {
  std::string out;
  std::string directory;
  for (const ZipMember& member : members) {
    if (out.size() + member.content.size() > 0xFFFF0000u) throw Error("zip: more than 4 GiB");
    const std::size_t offset = out.size();
    out += "PK\x03\x04";
    append_description(out, member);
    out += member.name + member.content;
    directory += "PK\x01\x02";
    append_little_endian<std::uint16_t>(directory, 20);  // made by
    append_description(directory, member);
    append_little_endian<std::uint16_t>(directory, 0);  // comment
    append_little_endian<std::uint16_t>(directory, 0);  // disk
    append_little_endian<std::uint16_t>(directory, 0);  // attributes
    append_little_endian<std::uint32_t>(directory, 0);
    append_little_endian(directory, static_cast<std::uint32_t>(offset));
    directory += member.name;
  }
  const std::size_t offset = out.size();
  out += directory + "PK\x05\x06";
  append_little_endian<std::uint32_t>(out, 0);  // disks
  append_little_endian(out, static_cast<std::uint16_t>(members.size()));
  append_little_endian(out, static_cast<std::uint16_t>(members.size()));
  append_little_endian(out, static_cast<std::uint32_t>(directory.size()));
  append_little_endian(out, static_cast<std::uint32_t>(offset));
  append_little_endian<std::uint16_t>(out, 0);
  return out;
}

}  // namespace asperity

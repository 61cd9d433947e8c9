#include "json_members.h"

#include <algorithm>
#include <limits>

#include "asperity/base/error.h"

namespace asperity {

namespace {

constexpr std::size_t kSmall = 16;

}  // namespace

JsonMembers::JsonMembers(const JsonMembers& other) : list(other.list) {
  if (other.index == nullptr) return;
  index = std::make_unique<Index>(Less{this});
  for (const std::uint32_t place : *other.index) index->emplace_hint(index->end(), place);
}

std::size_t JsonMembers::find(std::string_view key) const {
  if (index == nullptr) {
    for (std::size_t i = 0; i < list.size(); ++i) {
      if (comparisons != nullptr) ++*comparisons;
      if (list[i].key == key) return i;
    }
    return kNone;
  }
  const auto found = index->find(key);
  return found == index->end() ? kNone : *found;
}

Json& JsonMembers::append(std::string key) {
  if (list.size() >= std::numeric_limits<std::uint32_t>::max()) throw Error("an object has too many members");
  list.push_back({std::move(key), Json()});
  if (index != nullptr) {
    index->insert(static_cast<std::uint32_t>(list.size() - 1));
  } else {
    index_all();
  }
  return list.back().value;
}

void JsonMembers::erase(std::size_t place) {
  list.erase(list.begin() + static_cast<std::ptrdiff_t>(place));
  index_all();
}

void JsonMembers::sort() {
  std::sort(list.begin(), list.end(), [](const JsonMember& a, const JsonMember& b) { return a.key < b.key; });
  index_all();
}

void JsonMembers::index_all() {
  index.reset();
  if (list.size() <= kSmall) return;
  index = std::make_unique<Index>(Less{this});
  for (std::size_t i = 0; i < list.size(); ++i) index->insert(static_cast<std::uint32_t>(i));
}

}  // namespace asperity

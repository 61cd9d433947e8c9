#pragma once

#include <cstdint>
#include <memory>
#include <set>
#include <string_view>
#include <vector>

#include "asperity/json/json.h"

namespace asperity {

// The members of an object in their order. The few of a small one are looked through; of a large one a tree of places
// is kept, so that no choice of keys makes the search slow, as it would with hashing.
struct JsonMembers {
  struct Less {
    using is_transparent = void;
    const JsonMembers* of;

    std::string_view key(std::uint32_t i) const { return of->list[i].key; }
    std::string_view key(std::string_view text) const { return text; }
    template <class A, class B>
    bool operator()(const A& a, const B& b) const {
      if (of->comparisons != nullptr) ++*of->comparisons;
      const std::string_view x = key(a), y = key(b);
      return x.size() != y.size() ? x.size() < y.size() : x < y;
    }
  };

  using Index = std::set<std::uint32_t, Less>;

  JsonMembers() = default;
  JsonMembers(const JsonMembers& other);
  JsonMembers& operator=(const JsonMembers&) = delete;

  static constexpr std::size_t kNone = static_cast<std::size_t>(-1);
  std::size_t find(std::string_view key) const;  // its place, or kNone
  // Appends a member whose key is not there yet.
  Json& append(std::string key);
  void erase(std::size_t place);
  void sort();

  std::vector<JsonMember> list;
  std::unique_ptr<Index> index;          // none while the object is small
  std::uint64_t* comparisons = nullptr;  // counted while an object is read, for tests

 private:
  void index_all();
};

}  // namespace asperity

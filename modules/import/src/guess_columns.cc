#include "asperity/import/guess_columns.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <optional>
#include <string_view>
#include <vector>

#include "column_words.h"

namespace asperity {

namespace {

bool holds_word(std::string_view text, std::string_view word) {
  std::string lower;
  for (const char c : text) lower += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return lower.find(word) != std::string::npos;
}

// What bare x, y, z are in a file of this role and name.
char bare_kind(FileRole role, const std::string& file) {
  switch (role) {
    case FileRole::kPose:
      return 'p';
    case FileRole::kImu:
      return holds_word(file, "gyr") ? 'g' : 'a';
    case FileRole::kGyro:
      return 'g';
    case FileRole::kForce:
      break;
  }
  return 'f';
}

std::string kinds_of(FileRole role) {
  switch (role) {
    case FileRole::kPose:
      return "pqr";
    case FileRole::kImu:
      return "ag";
    case FileRole::kGyro:
      return "g";
    case FileRole::kForce:
      break;
  }
  return "f";
}

struct Candidate {
  ColumnWords words;
  std::size_t column = 0;
  bool is_bare = false;  // its kind is the role's
};

// Adds one column for each axis: of those with the first one's group. `fewest` of them at least.
void add_axes(const DelimitedTable& table, const std::vector<Candidate>& candidates, char kind, std::string_view axes,
              std::string_view meaning_letter, std::size_t fewest, ColumnMap& map) {
  const Candidate* first = nullptr;
  ColumnMap out;
  for (const char axis : axes) {
    for (const Candidate& candidate : candidates) {
      if (candidate.words.kind != kind || candidate.words.axis != axis) continue;
      if (first != nullptr && table.columns[candidate.column].group != table.columns[first->column].group) continue;
      if (first == nullptr) first = &candidate;
      out.push_back({std::string(meaning_letter) + axis, candidate.column, {}, false, "its name", {}});
      break;
    }
  }
  if (out.size() >= fewest) map.insert(map.end(), out.begin(), out.end());
}

std::vector<Candidate> candidates_of(const DelimitedTable& table, const std::string& body, const ColumnMap& map,
                                     const GuessContext& context) {
  std::vector<Candidate> out;
  for (std::size_t i = 0; i < table.columns.size(); ++i) {
    const auto is_it = [&](const MappedColumn& column) { return column.column == i; };
    const bool is_used = std::any_of(map.begin(), map.end(), is_it) ||
                         std::find(context.taken.begin(), context.taken.end(), i) != context.taken.end();
    const auto words = is_used ? std::nullopt : words_of_column(table.columns[i]);
    if (!words) continue;
    if (!body.empty() && table.columns[i].label().find(body) == std::string::npos) continue;
    out.push_back({*words, i});
  }
  return out;
}

// "Tx" next to "Fx" is a torque where there are other positions.
void leave_out_torques(const DelimitedTable& table, std::vector<Candidate>& candidates) {
  const auto is_torque = [&](const Candidate& candidate) {
    const std::string last = split_name_words(table.columns[candidate.column].name).back();
    return candidate.words.kind == 'p' && last.size() == 2 && last.front() == 't';
  };
  const auto any = [&](const auto& is_it) { return std::any_of(candidates.begin(), candidates.end(), is_it); };
  const bool has_forces = any([](const Candidate& c) { return c.words.kind == 'f' && c.words.axis != 0; });
  const bool has_positions =
      any([&](const Candidate& c) { return (c.words.kind == 'p' && !is_torque(c)) || c.words.kind == 0; });
  if (has_forces && has_positions) std::erase_if(candidates, is_torque);
}

// Axes without a word are what their unit says, else the role's, where no column says that itself.
void name_bare_axes(const DelimitedTable& table, char bare, bool is_given, std::vector<Candidate>& candidates) {
  const std::vector<Candidate> said = candidates;
  for (Candidate& candidate : candidates) {
    if (candidate.words.kind != 0) continue;
    const char by_unit = kind_of_unit(table.columns[candidate.column]);
    if (by_unit == 0 && !is_given) continue;
    const char kind = by_unit != 0 ? by_unit : bare;
    if (std::any_of(said.begin(), said.end(), [&](const Candidate& c) { return c.words.kind == kind; })) continue;
    candidate.words.kind = kind;
    candidate.is_bare = by_unit == 0;
  }
}

// Positions may have fewer axes, and accelerations whose columns name themselves.
std::size_t fewest_axes(const std::vector<Candidate>& candidates, char kind, const GuessContext& context) {
  const bool is_bare = std::any_of(candidates.begin(), candidates.end(),
                                   [&](const Candidate& c) { return c.words.kind == kind && c.is_bare; });
  const bool may_be_fewer = kind == 'p' || (kind == 'a' && !is_bare);
  return context.all_axes || !may_be_fewer ? 3 : 1;
}

// The force alone, or along z.
void add_one_force(const std::vector<Candidate>& candidates, ColumnMap& map) {
  for (const char axis : {'\0', 'z'}) {
    for (const Candidate& candidate : candidates) {
      if (candidate.words.kind != 'f' || candidate.words.axis != axis) continue;
      map.push_back({"f", candidate.column, {}, false, "its name", {}});
      return;
    }
  }
}

// In small letters, with blanks between its words and without its unit.
std::string name_of_time(const std::string& name) {
  std::vector<std::string> words = split_name_words(name);
  while (words.size() > 1 && find_import_unit(words.back(), Quantity::kTime)) words.pop_back();
  std::string out;
  for (const std::string& word : words) out += (out.empty() ? "" : " ") + word;
  return out;
}

void guess_time_columns(const DelimitedTable& table, ColumnMap& map) {
  constexpr std::array<std::string_view, 11> kNames{"timestamp",       "time",    "t",    "zeit", "time stamp", "stamp",
                                                    "seconds elapsed", "elapsed", "secs", "sec",  "seconds"};
  for (const std::string_view name : kNames) {
    for (std::size_t i = 0; i < table.columns.size(); ++i) {
      if (name_of_time(table.columns[i].name) != name) continue;
      map.push_back({"t", i, {}, false, "its name", {}});
      for (std::size_t k = i + 1; name == "sec" && k < table.columns.size(); ++k) {
        const std::string& fine = table.columns[k].name;
        if (fine == "nanosec" || fine == "nsec") map.push_back({"t2", k, "ns", false, "its name", "its name"});
      }
      return;
    }
  }
}

}  // namespace

void guess_columns(const DelimitedTable& table, FileRole role, const std::string& file, const std::string& body,
                   ColumnMap& map, const GuessContext& context) {
  if (!table.has_header()) return;
  if (!has_group(map, ColumnGroup::kTime)) guess_time_columns(table, map);
  std::vector<Candidate> candidates = candidates_of(table, body, map, context);
  leave_out_torques(table, candidates);
  name_bare_axes(table, bare_kind(role, file), context.is_given, candidates);
  std::erase_if(candidates, [&](const Candidate& c) { return has_other_unit(table.columns[c.column], c.words.kind); });
  const auto has_w = [&](char kind) {
    return std::any_of(candidates.begin(), candidates.end(),
                       [&](const Candidate& c) { return c.words.kind == kind && c.words.axis == 'w'; });
  };
  for (const char kind : kinds_of(role)) {
    const std::string letter(1, kind);
    if (kind == 'q' || kind == 'r') {
      if (has_group(map, ColumnGroup::kRotation)) continue;
      if (has_w(kind)) {
        add_axes(table, candidates, kind, "wxyz", "q", 4, map);
      } else if (kind == 'r') {
        add_axes(table, candidates, kind, "xyz", "r", 3, map);
      }
    } else if (!has_group(map, group_of(kind == 'f' ? "f" : letter + "x"))) {
      add_axes(table, candidates, kind, "xyz", letter, fewest_axes(candidates, kind, context), map);
      if (kind == 'f' && !has_group(map, ColumnGroup::kForce)) add_one_force(candidates, map);
    }
  }
}

}  // namespace asperity

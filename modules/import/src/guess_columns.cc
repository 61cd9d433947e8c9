#include "asperity/import/guess_columns.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <initializer_list>

namespace asperity {

namespace {

using Tokens = std::vector<std::string>;

// "accX" → acc, x; "p_RS_R_x" → p, rs, r, x; "Rot[0]" → rot, 0.
Tokens tokens_of(std::string_view text) {
  Tokens out;
  std::string token;
  const auto end_token = [&] {
    if (!token.empty()) out.push_back(std::move(token));
    token.clear();
  };
  bool was_lower = false;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (std::isalnum(byte) == 0 && byte < 0x80) {
      end_token();
      was_lower = false;
      continue;
    }
    if (was_lower && std::isupper(byte) != 0) end_token();
    was_lower = std::islower(byte) != 0;
    token += static_cast<char>(std::tolower(byte));
  }
  end_token();
  return out;
}

bool is_one_of(const std::string& word, std::initializer_list<std::string_view> words) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

// The letter that meanings of this kind begin with, by a word; 0: none.
char kind_of_word(const std::string& word) {
  if (is_one_of(word, {"q", "quat", "quaternion", "orientation"})) return 'q';
  if (is_one_of(word, {"r", "rotation", "rot"})) return 'r';
  if (is_one_of(word, {"p", "pos", "position", "t", "trans", "translation", "location"})) return 'p';
  if (is_one_of(word, {"a", "acc", "accel", "acceleration", "accelerometer", "totalacceleration", "beschleunigung"})) {
    return 'a';
  }
  if (is_one_of(word, {"g", "gyr", "gyro", "gyroscope", "w", "omega", "angular", "rate", "drehrate"})) return 'g';
  if (is_one_of(word, {"f", "force", "kraft"})) return 'f';
  return 0;
}

// Velocities, biases, covariances and the like are none of ours.
bool is_other_quantity(const Tokens& tokens) {
  bool angular = false, other = false;
  for (const std::string& token : tokens) {
    angular = angular || token == "angular";
    other =
        other || is_one_of(token, {"v", "vel", "velocity", "b", "bias", "cov", "covariance", "std", "sigma", "error",
                                   "mag", "magnetic", "magnetometer", "absolute", "moment", "torque", "gravity"});
  }
  return other && !angular;
}

struct Guessed {
  char kind = 0;  // p, q, r, a, g, f; 0: bare
  char axis = 0;  // x, y, z, w; 0: f alone
};

bool is_axis(char c) { return c == 'x' || c == 'y' || c == 'z' || c == 'w'; }

std::optional<Guessed> guessed_of(const DelimitedColumn& column) {
  Tokens tokens = tokens_of(column.name);
  const Tokens above = tokens_of(column.group);
  if (tokens.empty() || is_other_quantity(tokens) || is_other_quantity(above)) return std::nullopt;
  // A unit at the end of the name ("px_mm", "gx_deg_s") is not part of it.
  while (tokens.size() > 1 && !is_axis(tokens.back().back()) && (is_unit(tokens.back()) || tokens.back() == "s")) {
    tokens.pop_back();
  }
  std::string last = tokens.back();
  if (is_one_of(last, {"roll", "pitch", "yaw"}))
    return Guessed{'r', last == "roll" ? 'x' : last == "pitch" ? 'y' : 'z'};
  if (is_one_of(last, {"qi", "qj", "qk", "qr"})) return Guessed{'q', last[1] == 'r' ? 'w' : "xyz"[last[1] - 'i']};
  if (is_one_of(last, {"q0", "q1", "q2", "q3"})) return Guessed{'q', "wxyz"[last[1] - '0']};
  if (is_one_of(last, {"force", "kraft", "f"}) && tokens.size() == 1) return Guessed{'f', 0};
  if (last.empty() || !is_axis(last.back())) return std::nullopt;
  Guessed out{0, last.back()};
  last.pop_back();
  if (!last.empty()) {
    out.kind = kind_of_word(last);
    return out.kind == 0 ? std::nullopt : std::optional(out);
  }
  tokens.pop_back();
  for (const std::string& word : tokens) {
    if (out.kind == 0 || is_one_of(word, {"rate", "angular"})) {  // "rotation rate", "angular velocity"
      const char kind = kind_of_word(word);
      out.kind = kind != 0 ? kind : out.kind;
    }
  }
  // Of the rows above the lowest says most: "Rigid Body, probe, Rotation".
  for (auto word = above.rbegin(); word != above.rend() && out.kind == 0; ++word) out.kind = kind_of_word(*word);
  return out;
}

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

// The header states a unit that columns of this kind cannot have.
bool has_other_unit(const DelimitedColumn& column, char kind) {
  if (kind == 0 || column.unit.empty() || !is_unit(column.unit)) return false;
  const Quantity quantity = quantity_of(kind == 'f' ? "f" : std::string(1, kind) + "x");
  return quantity != Quantity::kNumber && !find_import_unit(column.unit, quantity);
}

struct Candidate {
  Guessed guessed;
  std::size_t column = 0;
};

// Adds one column for each axis: of those with the first one's group.
void add_axes(const DelimitedTable& table, const std::vector<Candidate>& candidates, char kind, std::string_view axes,
              std::string_view meaning_letter, ColumnMap& map) {
  const Candidate* first = nullptr;
  ColumnMap out;
  for (const char axis : axes) {
    for (const Candidate& candidate : candidates) {
      if (candidate.guessed.kind != kind || candidate.guessed.axis != axis) continue;
      if (first != nullptr && table.columns[candidate.column].group != table.columns[first->column].group) continue;
      if (first == nullptr) first = &candidate;
      out.push_back({std::string(meaning_letter) + axis, candidate.column, {}, false, "its name", {}});
      break;
    }
  }
  if (out.size() == axes.size()) map.insert(map.end(), out.begin(), out.end());
}

void guess_time_columns(const DelimitedTable& table, ColumnMap& map) {
  constexpr std::array<std::string_view, 11> kNames{"timestamp",       "time",    "t",    "zeit", "time stamp", "stamp",
                                                    "seconds elapsed", "elapsed", "secs", "sec",  "seconds"};
  for (const std::string_view name : kNames) {
    for (std::size_t i = 0; i < table.columns.size(); ++i) {
      Tokens tokens = tokens_of(table.columns[i].name);
      while (tokens.size() > 1 && find_import_unit(tokens.back(), Quantity::kTime)) tokens.pop_back();
      std::string joined;
      for (const std::string& token : tokens) joined += (joined.empty() ? "" : " ") + token;
      if (joined != name) continue;
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
                   ColumnMap& map) {
  if (!table.has_header()) return;
  if (!has_group(map, ColumnGroup::kTime)) guess_time_columns(table, map);
  std::vector<Candidate> candidates;
  for (std::size_t i = 0; i < table.columns.size(); ++i) {
    auto guessed = guessed_of(table.columns[i]);
    if (!guessed) continue;
    if (!body.empty() && table.columns[i].label().find(body) == std::string::npos) continue;
    candidates.push_back({*guessed, i});
  }
  // Bare axes are the role's where no column says so itself.
  const char bare = bare_kind(role, file);
  const bool is_said =
      std::any_of(candidates.begin(), candidates.end(), [&](const Candidate& c) { return c.guessed.kind == bare; });
  for (Candidate& candidate : candidates) {
    if (candidate.guessed.kind == 0 && !is_said) candidate.guessed.kind = bare;
  }
  std::erase_if(candidates,
                [&](const Candidate& c) { return has_other_unit(table.columns[c.column], c.guessed.kind); });
  const auto has_w = [&](char kind) {
    return std::any_of(candidates.begin(), candidates.end(),
                       [&](const Candidate& c) { return c.guessed.kind == kind && c.guessed.axis == 'w'; });
  };
  for (const char kind : kinds_of(role)) {
    const std::string letter(1, kind);
    if (kind == 'q' || kind == 'r') {
      if (has_group(map, ColumnGroup::kRotation)) continue;
      if (has_w(kind)) {
        add_axes(table, candidates, kind, "wxyz", "q", map);
      } else if (kind == 'r') {
        add_axes(table, candidates, kind, "xyz", "r", map);
      }
    } else if (!has_group(map, group_of(kind == 'f' ? "f" : letter + "x"))) {
      add_axes(table, candidates, kind, "xyz", letter, map);
      if (kind == 'f' && !has_group(map, ColumnGroup::kForce)) {
        for (const Candidate& candidate : candidates) {
          if (candidate.guessed.kind != 'f' || (candidate.guessed.axis != 0 && candidate.guessed.axis != 'z')) continue;
          map.push_back({"f", candidate.column, {}, false, "its name", {}});
          break;
        }
      }
    }
  }
}

}  // namespace asperity

#include "asperity/studio/document.h"

#include <algorithm>
#include <new>
#include <system_error>
#include <utility>

#include "asperity/base/csv.h"
#include "asperity/base/error.h"
#include "asperity/base/text.h"
#include "asperity/json/parse_json.h"
#include "asperity/studio/calls.h"
#include "json_pointer.h"
#include "put_aside.h"
#include "server_limits.h"

namespace asperity::studio {

namespace {

constexpr std::uint64_t kLargestFile = std::uint64_t{64} << 20U;
// A message and a path are 32 deep at most; a file has two levels about a section.
constexpr std::size_t kDeepestValue = 80;

JsonPointer pointer_of(std::string_view path) {
  const auto parts = static_cast<std::size_t>(std::count(path.begin(), path.end(), '/'));
  if (path.size() > kLongestPath || parts > kMostPathParts)
    throw Error("'" + printable(path) + "' is too long for a path");
  return parse_json_pointer(path);
}

std::string section_name(std::string_view path) {
  const JsonPointer pointer = pointer_of(path);
  if (pointer.empty()) throw Error("the document can be changed only section by section");
  return pointer.front();
}

// What is at a path; null for nothing.
Json value_at(const Json& tree, const JsonPointer& pointer) {
  const Json* value = find_at(tree, pointer);
  return value == nullptr ? Json() : *value;
}

// The value at a path set, or with null taken out. Throws Error if it leads nowhere.
void put_value(Json& tree, const JsonPointer& pointer, const Json& value, std::string_view path) {
  const Json* parent = find_at(tree, JsonSteps(pointer).first(pointer.size() - 1));
  if (parent == nullptr || !parent->is_object() || !set_at(tree, pointer, value)) {
    throw Error("'" + printable(path) + "' is not a position in the document");
  }
}

// An edit inside a list is one of the whole list: taking out and putting in are then each other's opposite.
void widen_to_list(const Json& tree, std::string& path, Json& after) {
  const JsonPointer pointer = pointer_of(path);
  const JsonSteps steps(pointer);
  for (std::size_t upper = steps.size() - 1; upper > 0; --upper) {
    const Json* list = find_at(tree, steps.first(upper));
    if (list == nullptr || !list->is_array()) continue;
    const JsonSteps inner = steps.subspan(upper);
    Json changed = *list;
    const bool nothing_to_take = after.is_null() && find_at(changed, inner) == nullptr;
    if (nothing_to_take || !set_at(changed, inner, after)) {
      throw Error("'" + printable(path) + "' is not a position in the document");
    }
    after = std::move(changed);
    path = format_json_pointer(steps.first(upper));
    widen_to_list(tree, path, after);
    return;
  }
}

Json json_of(const Edit& edit) {
  Json out;
  out["path"] = edit.path;
  out["before"] = edit.before;
  out["after"] = edit.after;
  out["label"] = edit.label;
  return out;
}

std::size_t size_of(const Edit& edit) { return edit.before.dump_repaired().size() + edit.after.dump_repaired().size(); }

std::vector<Edit> edits_of(const Json& list) {
  std::vector<Edit> out;
  for (const Json& each : list) {
    out.push_back({each.at("path").get<std::string>(), each.at("before"), each.at("after"),
                   each.at("label").get<std::string>(), ""});
  }
  return out;
}

// Seen from the state that it led to.
Edit reversed(Edit edit) {
  std::swap(edit.before, edit.after);
  return edit;
}

JsonLimits file_limits() {
  JsonLimits out;
  out.depth = kDeepestValue;
  return out;
}

}  // namespace

Document::Document(std::filesystem::path file) : file_(std::move(file)) {}

void Document::add_section(const std::string& name, Json first, Validator validator, Updater updater) {
  if (first_.contains(name)) throw Error("the document's section '" + name + "' is given twice");
  value_[name] = first;
  first_[name] = std::move(first);
  validators_[name] = std::move(validator);
  updaters_[name] = std::move(updater);
}

namespace {

// What cannot be read, or kept under another name, would be replaced by the first edit's save.
[[noreturn]] void refuse_to_start(const std::string& why) {
  throw Error(why + "; the studio does not start, because its next save would replace this file");
}

// Nothing without a file.
std::optional<std::string> content_of(const std::filesystem::path& file) {
  std::error_code error;
  const std::filesystem::file_type type = std::filesystem::symlink_status(file, error).type();
  if (type == std::filesystem::file_type::not_found) return std::nullopt;
  const bool is_link = type == std::filesystem::file_type::symlink;
  if (is_link && std::filesystem::status(file, error).type() == std::filesystem::file_type::not_found) {
    refuse_to_start(file.string() + ": is a link to a file that does not exist");
  }
  try {
    return read_file(file, kLargestFile);
  } catch (const Error& fault) {
    refuse_to_start(fault.what());
  }
}

}  // namespace

void Document::load() {
  const std::optional<std::string> content = content_of(file_);
  if (!content) return;
  const std::string name = printable(file_.filename().string());
  try {
    if (read(*content)) return;
  } catch (const std::bad_alloc&) {
    throw;  // nothing is wrong with the file
  } catch (const std::exception& fault) {
    for (const auto& [section, first] : first_) value_[section] = first;
    unknown_ = Json::object();
    undo_.clear();
    redo_.clear();
    try {
      const std::string aside = printable(put_aside(file_).filename().string());
      problems_.push_back(name + " could not be read and was renamed to " + aside + ": " +
                          printable(fault.what(), 300));
    } catch (const Error& error) {
      refuse_to_start(file_.string() + ": cannot be read: " + printable(fault.what(), 300) + ", and " + error.what());
    }
    return;
  }
  // What its page did not take, and the steps, are in a copy: the next save has them no more.
  try {
    const std::string copy = printable(keep_copy(file_, *content).filename().string());
    problems_.push_back("the former " + name + " is kept as " + copy);
  } catch (const Error& error) {
    refuse_to_start(file_.string() + ": cannot be used as a whole (" + problems_.back() +
                    "), and no copy can be made: " + error.what());
  }
}

bool Document::read(std::string_view text) {
  const Json file = parse_json(text, file_.filename().string(), file_limits());
  if (file.at("format") != "asperity-studio" || file.at("version") != 1) throw Error("has another version");
  bool is_whole = true;
  for (const auto& [name, found] : file.at("document").items()) {
    if (!first_.contains(name)) {
      unknown_[name] = found;
      continue;
    }
    try {
      Json section = found;
      if (updaters_.at(name)) updaters_.at(name)(section);
      validators_.at(name)(section);
      value_[name] = std::move(section);
    } catch (const std::exception& fault) {
      is_whole = false;
      problems_.push_back("the page '" + name + "' starts with its defaults: " + printable(fault.what(), 300));
    }
  }
  return is_whole && read_steps(file);
}

const Json& Document::section(std::string_view name) const { return value_.at(std::string(name)); }

bool Document::read_steps(const Json& file) {
  try {
    for (Edit& edit : edits_of(file.at("redo"))) redo_.push_back({edit, size_of(edit)});
    for (Edit& edit : edits_of(file.at("undo"))) remember(std::move(edit));
    return true;
  } catch (const std::exception& fault) {
    undo_.clear();
    redo_.clear();
    problems_.push_back(std::string("earlier steps cannot be undone any more: ") + printable(fault.what(), 300));
    return false;
  }
}

Json Document::changed_section(const Edit& edit) const {
  const std::string name = section_name(edit.path);
  if (!first_.contains(name)) throw Error("the document has no section '" + printable(name) + "'");
  Json holder = Json::object();
  holder[name] = value_.at(name);
  if (edit.path == "/" + name) {
    if (edit.after.is_null()) throw Error("a section of the document cannot be removed");
    holder[name] = edit.after;
  } else {
    put_value(holder, pointer_of(edit.path), edit.after, edit.path);
  }
  if (holder[name].dump_repaired().size() > kLargestSectionBytes) {
    throw Advice("the page '" + name + "' would contain too much", "Remove something from it before you add more.");
  }
  validators_.at(name)(holder[name]);
  return std::move(holder[name]);
}

void Document::remember(Edit edit) {
  const std::size_t bytes = size_of(edit);
  undo_.push_back({std::move(edit), bytes});
  std::size_t total = 0;
  std::size_t kept = 0;
  while (kept < undo_.size() && kept < kMostUndoSteps) {
    total += undo_[undo_.size() - 1 - kept].bytes;
    if (total > kMostUndoBytes && kept > 0) break;
    ++kept;
  }
  undo_.erase(undo_.begin(), undo_.end() - static_cast<std::ptrdiff_t>(kept));
}

void Document::edit(std::string_view path, Json after, std::string_view label, std::string_view gesture) {
  if (label.size() > kLongestLabel || gesture.size() > kLongestLabel) throw Error("an edit's label is too long");
  if (!first_.contains(section_name(path))) {
    throw Error("the document has no section '" + printable(section_name(path)) + "'");
  }
  std::string place(path);
  widen_to_list(value_, place, after);
  Edit edit{place, value_at(value_, pointer_of(place)), std::move(after), std::string(label), std::string(gesture)};
  Json changed = changed_section(edit);
  if (edit.before == edit.after) return;
  value_[section_name(place)] = std::move(changed);
  redo_.clear();
  const bool goes_on =
      !undo_.empty() && !gesture.empty() && undo_.back().edit.gesture == gesture && undo_.back().edit.path == place;
  if (goes_on) {
    undo_.back().edit.after = edit.after;
    undo_.back().bytes = size_of(undo_.back().edit);
  } else {
    remember(edit);
  }
  tell(edit);
}

void Document::tell(const Edit& edit) {
  ++version_;
  unsaved_ = true;
  for (const Listener& listener : listeners_) listener(edit);
}

bool Document::go(std::vector<Step>& from, std::vector<Step>& to, bool back) {
  if (from.empty()) return false;
  Step step = std::move(from.back());
  from.pop_back();
  step.edit.gesture.clear();
  const Edit edit = back ? reversed(step.edit) : step.edit;
  value_[section_name(edit.path)] = changed_section(edit);
  to.push_back(std::move(step));
  if (!undo_.empty()) undo_.back().edit.gesture.clear();
  tell(edit);
  return true;
}

bool Document::undo() { return go(undo_, redo_, true); }
bool Document::redo() { return go(redo_, undo_, false); }

std::optional<Edit> Document::next_undo() const {
  return undo_.empty() ? std::nullopt : std::optional(reversed(undo_.back().edit));
}
std::optional<Edit> Document::next_redo() const {
  return redo_.empty() ? std::nullopt : std::optional(redo_.back().edit);
}

std::string Document::undo_label() const { return undo_.empty() ? "" : undo_.back().edit.label; }
std::string Document::redo_label() const { return redo_.empty() ? "" : redo_.back().edit.label; }

std::optional<std::string> Document::take_unsaved() {
  if (!unsaved_) return std::nullopt;
  Json file;
  file["format"] = "asperity-studio";
  file["version"] = 1;
  file["document"] = value_;
  file["document"].update(unknown_);
  file["undo"] = Json::array();
  file["redo"] = Json::array();
  for (const Step& step : undo_) file["undo"].push_back(json_of(step.edit));
  for (const Step& step : redo_) file["redo"].push_back(json_of(step.edit));
  std::string content = file.dump_repaired() + "\n";
  unsaved_ = false;  // not before all that can fail
  return content;
}

}  // namespace asperity::studio

#include "asperity/studio/document.h"

#include <algorithm>

#include "asperity/base/csv.h"
#include "asperity/base/error.h"
#include "asperity/base/output.h"
#include "asperity/base/text.h"

namespace asperity::studio {

namespace {

constexpr std::size_t kMostSteps = 200;
constexpr std::size_t kLargestSection = 4U << 20U;
constexpr std::uint64_t kLargestFile = std::uint64_t{64} << 20U;
constexpr int kDeepest = 64;

std::string dump(const Json& value) { return value.dump(-1, ' ', false, Json::error_handler_t::replace); }

Json::json_pointer pointer_of(std::string_view path) {
  try {
    return Json::json_pointer(std::string(path));
  } catch (const Json::exception&) {
    throw Error("'" + printable(path) + "' is no place in the document");
  }
}

std::string section_name(std::string_view path) {
  const Json::json_pointer pointer = pointer_of(path);
  if (pointer.empty()) throw Error("the document is changed section by section, not as a whole");
  Json::json_pointer rest = pointer;
  std::string first;
  while (!rest.empty()) {
    first = rest.back();
    rest.pop_back();
  }
  return first;
}

// What stands at a path; null for nothing.
Json value_at(const Json& tree, const Json::json_pointer& pointer) {
  return tree.contains(pointer) ? tree.at(pointer) : Json();
}

// The value at a path set, or with null taken out. Throws Error if it leads nowhere.
void put(Json& tree, const Json::json_pointer& pointer, const Json& value, std::string_view path) {
  const Json::json_pointer parent = pointer.parent_pointer();
  if (!tree.contains(parent) || !tree.at(parent).is_object()) {
    throw Error("'" + printable(path) + "' is no place in the document");
  }
  if (value.is_null()) {
    tree.at(parent).erase(pointer.back());
  } else {
    tree.at(parent)[pointer.back()] = value;
  }
}

// An edit inside a list is one of the whole list: taking out and putting in are then each other's opposite.
void widen_to_list(const Json& tree, std::string& path, Json& after) {
  const Json::json_pointer pointer = pointer_of(path);
  for (Json::json_pointer upper = pointer.parent_pointer(); !upper.empty(); upper = upper.parent_pointer()) {
    if (!tree.contains(upper) || !tree.at(upper).is_array()) continue;
    Json list = tree.at(upper);
    Json patch = Json::array();
    const Json::json_pointer inner(pointer.to_string().substr(upper.to_string().size()));
    const bool there = list.contains(inner);
    if (after.is_null() && !there) throw Error("'" + printable(path) + "' is no place in the document");
    Json step;
    step["op"] = after.is_null() ? "remove" : there ? "replace" : "add";
    step["path"] = inner.to_string();
    if (!after.is_null()) step["value"] = after;
    patch.push_back(std::move(step));
    try {
      after = list.patch(patch);
    } catch (const Json::exception&) {
      throw Error("'" + printable(path) + "' is no place in the document");
    }
    path = upper.to_string();
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

std::vector<Edit> edits_of(const Json& list) {
  std::vector<Edit> out;
  for (const Json& each : list) {
    out.push_back({each.at("path").get<std::string>(), each.at("before"), each.at("after"),
                   each.at("label").get<std::string>(), ""});
  }
  return out;
}

Json parse_bounded(const std::string& text) {
  return Json::parse(text, [](int depth, Json::parse_event_t, Json&) {
    if (depth > kDeepest) throw Error("is nested too deeply");
    return true;
  });
}

}  // namespace

Document::Document(std::filesystem::path file) : file_(std::move(file)) {}

void Document::add_section(const std::string& name, Json first, Validator validator) {
  if (first_.contains(name)) throw Error("the document's section '" + name + "' is there twice");
  value_[name] = first;
  first_[name] = std::move(first);
  validators_[name] = std::move(validator);
}

void Document::load() {
  std::error_code error;
  if (!std::filesystem::exists(file_, error)) return;
  try {
    const Json file = parse_bounded(read_file(file_, kLargestFile));
    if (file.at("format") != "asperity-studio" || file.at("version") != 1) throw Error("is of another version");
    bool whole = true;
    for (const auto& [name, first] : first_) {
      const auto found = file.at("document").find(name);
      if (found == file.at("document").end()) continue;
      try {
        validators_.at(name)(*found);
        value_[name] = *found;
      } catch (const std::exception& fault) {
        whole = false;
        problems_.push_back("the page '" + name + "' begins anew: " + printable(fault.what(), 300));
      }
    }
    if (whole) {
      undo_ = edits_of(file.at("undo"));
      redo_ = edits_of(file.at("redo"));
    }
  } catch (const std::exception& fault) {
    for (const auto& [name, first] : first_) value_[name] = first;
    undo_.clear();
    redo_.clear();
    std::filesystem::path aside = file_;
    aside += ".unreadable";
    std::filesystem::rename(file_, aside, error);
    problems_.push_back(printable(file_.filename().string()) + " could not be read and was put aside as " +
                        printable(aside.filename().string()) + ": " + printable(fault.what(), 300));
  }
}

const Json& Document::section(std::string_view name) const { return value_.at(std::string(name)); }

void Document::edit(std::string_view path, Json after, std::string_view label, std::string_view gesture) {
  const std::string name = section_name(path);
  if (!first_.contains(name)) throw Error("the document has no section '" + printable(name) + "'");
  std::string place(path);
  widen_to_list(value_, place, after);
  const Json::json_pointer pointer = pointer_of(place);
  Json changed = value_[name];
  if (place == "/" + name) {
    if (after.is_null()) throw Error("a section of the document cannot be taken out");
    changed = after;
  } else {
    Json holder = Json::object();
    holder[name] = std::move(changed);
    put(holder, pointer, after, path);
    changed = std::move(holder[name]);
  }
  if (dump(changed).size() > kLargestSection) throw Error("the page '" + name + "' would hold too much");
  validators_.at(name)(changed);

  Edit edit{place, value_at(value_, pointer), after, std::string(label), std::string(gesture)};
  if (edit.before == edit.after) return;
  value_[name] = std::move(changed);
  redo_.clear();
  const bool goes_on =
      !undo_.empty() && !gesture.empty() && undo_.back().gesture == gesture && undo_.back().path == place;
  if (goes_on) {
    undo_.back().after = edit.after;
  } else {
    undo_.push_back(edit);
    if (undo_.size() > kMostSteps) undo_.erase(undo_.begin());
  }
  apply(edit);
}

void Document::apply(const Edit& edit) {
  ++version_;
  unsaved_ = true;
  for (const Listener& listener : listeners_) listener(edit);
}

bool Document::undo() {
  if (undo_.empty()) return false;
  Edit edit = undo_.back();
  undo_.pop_back();
  redo_.push_back(edit);
  redo_.back().gesture.clear();
  std::swap(edit.before, edit.after);
  put(value_, pointer_of(edit.path), edit.after, edit.path);
  if (!undo_.empty()) undo_.back().gesture.clear();
  apply(edit);
  return true;
}

bool Document::redo() {
  if (redo_.empty()) return false;
  const Edit edit = redo_.back();
  redo_.pop_back();
  undo_.push_back(edit);
  put(value_, pointer_of(edit.path), edit.after, edit.path);
  apply(edit);
  return true;
}

std::string Document::undo_label() const { return undo_.empty() ? "" : undo_.back().label; }
std::string Document::redo_label() const { return redo_.empty() ? "" : redo_.back().label; }

void Document::save() {
  if (!unsaved_) return;
  Json file;
  file["format"] = "asperity-studio";
  file["version"] = 1;
  file["document"] = value_;
  file["undo"] = Json::array();
  file["redo"] = Json::array();
  for (const Edit& edit : undo_) file["undo"].push_back(json_of(edit));
  for (const Edit& edit : redo_) file["redo"].push_back(json_of(edit));
  write_file(file_, file.dump(1, ' ', false, Json::error_handler_t::replace) + "\n");
  unsaved_ = false;
}

}  // namespace asperity::studio

#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "asperity/studio/block.h"

namespace asperity::studio {

// One change of the document, as it went.
struct Edit {
  std::string path;     // JSON pointer below a section: "/align/T_mesh_world"
  Json before;          // null: was not there
  Json after;           // null: taken out
  std::string label;    // in words, for the undo button: "move the path"
  std::string gesture;  // edits one after another of the same gesture and path are one for undo; "": each its own
};

// All that a user decides and would be sorry to lose, as one JSON value with a section a page: choices, settings,
// poses, strokes; results are made from it again. Every change is an edit that can be undone. Stored as
// `.asperity-studio.json` in the project's folder, by rename, at the latest a second after an edit and at the end, with
// its undo steps; read again at the start. On the studio's thread alone.
class Document {
 public:
  // Checks a section as a whole before it is taken; throws Error in words.
  using Validator = std::function<void(const Json& section)>;
  // Brings a section that an older version wrote up to date, before it is checked.
  using Updater = std::function<void(Json& section)>;
  using Listener = std::function<void(const Edit&)>;

  explicit Document(std::filesystem::path file);

  // Before load(): a page's section with its first value.
  void add_section(const std::string& name, Json first, Validator validator, Updater updater = {});
  // Reads the file, if there is one. A damaged one is renamed to FILE.unreadable. A section that its page does not take
  // begins with its first value, and steps that cannot be read are dropped; the file as it was is then kept as
  // FILE.before (put_aside.h). problems() states what happened and names the file. Sections that no page has are kept.
  // Throws Error, and the file is as it was, where it cannot be opened, read, renamed or copied: the next save would
  // replace it.
  void load();
  // The same of the file's content; false if a section or the steps were not taken. Throws Error if it is not a
  // document at all; the value is then undefined.
  bool read(std::string_view text);

  const Json& value() const { return value_; }
  const Json& section(std::string_view name) const;
  std::uint64_t version() const { return version_; }

  // Throws Error, and nothing is changed, for a path that is not below a section or leads nowhere, and for a value that
  // the section refuses.
  void edit(std::string_view path, Json after, std::string_view label, std::string_view gesture = {});
  // False: there is nothing. Throws Error, and the step is dropped, if its page does not take what would come of it.
  bool undo();
  bool redo();
  // What they would do, seen from now: its `after` is the value afterwards; nullptr: nothing.
  std::optional<Edit> next_undo() const;
  std::optional<Edit> next_redo() const;
  std::string undo_label() const;  // empty: nothing to undo
  std::string redo_label() const;

  // Called after each change, undo and redo.
  void on_change(Listener listener) { listeners_.push_back(std::move(listener)); }

  // The content of the file if there is something new since the last call; the caller writes it.
  std::optional<std::string> take_unsaved();
  const std::filesystem::path& file() const { return file_; }
  const std::vector<std::string>& problems() const { return problems_; }

 private:
  struct Step {
    Edit edit;
    std::size_t bytes = 0;
  };
  // The section with the value at a path of it replaced. Throws Error if it does not take it.
  Json changed_section(const Edit& edit) const;
  bool read_steps(const Json& file);
  bool go(std::vector<Step>& from, std::vector<Step>& to, bool back);
  void remember(Edit edit);
  void tell(const Edit& edit);

  std::filesystem::path file_;
  Json value_ = Json::object();
  Json unknown_ = Json::object();  // sections that no page has, such as those of a newer version
  std::map<std::string, Json, std::less<>> first_;
  std::map<std::string, Validator, std::less<>> validators_;
  std::map<std::string, Updater, std::less<>> updaters_;
  std::vector<Step> undo_, redo_;
  std::vector<Listener> listeners_;
  std::vector<std::string> problems_;
  std::uint64_t version_ = 0;
  bool unsaved_ = false;
};

}  // namespace asperity::studio

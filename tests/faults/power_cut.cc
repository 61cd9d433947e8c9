#include "power_cut.h"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <sstream>
#include <stdexcept>

namespace asperity::cli {

namespace {

constexpr std::size_t kNever = static_cast<std::size_t>(-1);

std::vector<std::string> fields_of(const std::string& line) {
  std::vector<std::string> out;
  std::istringstream in(line);
  for (std::string field; std::getline(in, field, '\t');) out.push_back(field);
  return out;
}

void put(std::string& content, std::uint64_t at, const std::string& bytes) {
  if (content.size() < at + bytes.size()) content.resize(at + bytes.size());
  std::copy(bytes.begin(), bytes.end(), content.begin() + static_cast<std::ptrdiff_t>(at));
}

}  // namespace

std::vector<DiskCall> read_disk_log(const std::filesystem::path& log) {
  std::ifstream in(log, std::ios::binary);
  std::vector<DiskCall> out;
  for (std::string line; std::getline(in, line);) {
    const std::vector<std::string> fields = fields_of(line);
    if (fields.size() < 3) throw std::runtime_error("log: " + line);
    DiskCall call;
    call.kind = fields[0];
    const bool is_of_file = call.kind == "new" || call.kind == "write" || call.kind == "size" || call.kind == "sync";
    if (is_of_file) call.file = fields[1];
    if (call.kind == "new" || call.kind == "sync") call.path = fields[2];
    if (call.kind == "write" || call.kind == "size") call.at = std::stoull(fields[2]);
    if (!is_of_file) call.path = fields[1];
    if (call.kind == "name" || call.kind == "swap") call.to = fields[2];
    call.bytes.resize(std::stoull(fields.back()));
    if (!call.bytes.empty()) in.read(call.bytes.data(), static_cast<std::streamsize>(call.bytes.size()));
    if (!in) throw std::runtime_error("log: cut off");
    out.push_back(std::move(call));
  }
  return out;
}

PowerCut::PowerCut(const std::vector<DiskCall>& calls, const std::filesystem::path& root, const Tree& before)
    : root_(root.string()) {
  now_.push_back({true, "", {}});
  for (const auto& [name, content] : before) {  // a folder comes before what is in it
    const bool is_folder = name.ends_with('/');
    const Name place = place_of(root_ + "/" + (is_folder ? name.substr(0, name.size() - 1) : name));
    now_.push_back({is_folder, content, {}});
    bind({place.folder, place.name, static_cast<int>(now_.size()) - 1});
  }
  first_ = now_;
  for (const DiskCall& call : calls) take(call);
  first_.resize(now_.size());
  for (std::size_t k = 0; k < now_.size(); ++k) first_[k].is_folder = now_[k].is_folder;
  find_when_certain();
}

int PowerCut::node_at(const std::string& path) const {
  if (path == root_) return 0;
  if (!path.starts_with(root_ + "/")) throw std::runtime_error("not below the root: " + path);
  int node = 0;
  std::istringstream parts(path.substr(root_.size() + 1));
  for (std::string part; std::getline(parts, part, '/');) {
    if (part.empty() || part == ".") continue;
    const auto& names = now_[static_cast<std::size_t>(node)].names;
    const auto found = names.find(part);
    if (found == names.end()) return -1;
    node = found->second;
  }
  return node;
}

PowerCut::Name PowerCut::place_of(const std::string& path) const {
  const std::size_t slash = path.rfind('/');
  const int folder = node_at(path.substr(0, slash));
  if (folder < 0) throw std::runtime_error("no folder of " + path);
  return {folder, path.substr(slash + 1), -1};
}

void PowerCut::bind(const Name& name) {
  auto& names = now_[static_cast<std::size_t>(name.folder)].names;
  if (name.node < 0) {
    names.erase(name.name);
  } else {
    names[name.name] = name.node;
  }
}

void PowerCut::take(const DiskCall& call) {
  Change change;
  if (call.kind == "write" || call.kind == "size") {
    const auto found = files_.find(call.file);
    if (found == files_.end()) throw std::runtime_error("a file that was there before is changed in place");
    change.kind = call.kind == "write" ? Change::Kind::kWrite : Change::Kind::kSize;
    change.node = found->second;
    change.at = call.at;
    change.bytes = call.bytes;
  } else if (call.kind == "sync") {
    const auto found = files_.find(call.file);
    change.node = found != files_.end() && !now_[static_cast<std::size_t>(found->second)].is_folder
                      ? found->second
                      : node_at(call.path);
  } else {
    change.kind = Change::Kind::kNames;
    Name place = place_of(call.path);
    if (call.kind == "new" || call.kind == "folder") {
      now_.push_back({call.kind == "folder", "", {}});
      place.node = static_cast<int>(now_.size()) - 1;
      if (call.kind == "new") files_[call.file] = place.node;
      change.names = {place};
    } else if (call.kind == "gone") {
      change.names = {place};
    } else {
      Name to = place_of(call.to);
      to.node = node_at(call.path);
      if (call.kind == "swap") place.node = node_at(call.to);
      change.names = {place, to};
    }
    for (const Name& name : change.names) bind(name);
  }
  changes_.push_back(std::move(change));
}

void PowerCut::find_when_certain() {
  std::map<int, std::size_t> next_sync;  // of a node: the number of calls behind its next sync
  const auto sync_of = [&next_sync](int node) {
    const auto found = next_sync.find(node);
    return found == next_sync.end() ? kNever : found->second;
  };
  for (std::size_t k = changes_.size(); k-- > 0;) {
    Change& change = changes_[k];
    if (change.kind == Change::Kind::kSync) {
      next_sync[change.node] = k + 1;
    } else if (change.kind == Change::Kind::kNames) {
      for (const Name& name : change.names) change.certain_after = std::max(change.certain_after, sync_of(name.folder));
    } else {
      change.certain_after = sync_of(change.node);
    }
  }
}

Tree PowerCut::after(std::size_t count, const std::function<bool(Part, std::size_t)>& is_there) const {
  std::vector<Node> nodes = first_;
  for (std::size_t k = 0; k < count; ++k) {
    const Change& change = changes_[k];
    if (change.kind == Change::Kind::kSync) continue;
    const Part part = change.kind == Change::Kind::kNames ? Part::kNames : Part::kBytes;
    if (change.certain_after > count && !is_there(part, k)) continue;
    for (const Name& name : change.names) {
      auto& names = nodes[static_cast<std::size_t>(name.folder)].names;
      if (name.node < 0) {
        names.erase(name.name);
      } else {
        names[name.name] = name.node;
      }
    }
    if (change.kind == Change::Kind::kWrite)
      put(nodes[static_cast<std::size_t>(change.node)].bytes, change.at, change.bytes);
    if (change.kind == Change::Kind::kSize) nodes[static_cast<std::size_t>(change.node)].bytes.resize(change.at);
  }
  Tree out;
  list(nodes, 0, "", out);
  return out;
}

void PowerCut::list(const std::vector<Node>& nodes, int folder, const std::string& prefix, Tree& out) const {
  // A folder that lost its new name and kept its old one has two: both are listed, and none is followed into itself.
  if (std::count(prefix.begin(), prefix.end(), '/') > 20) return;
  for (const auto& [name, node] : nodes[static_cast<std::size_t>(folder)].names) {
    const Node& found = nodes[static_cast<std::size_t>(node)];
    if (found.is_folder) {
      out[prefix + name + "/"] = "";
      list(nodes, node, prefix + name + "/", out);
    } else {
      out[prefix + name] = found.bytes;
    }
  }
}

}  // namespace asperity::cli

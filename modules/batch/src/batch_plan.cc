#include "asperity/batch/batch_plan.h"

#include <toml++/toml.h>

#include <array>

#include "asperity/base/error.h"
#include "asperity/base/text.h"

namespace asperity {

namespace {

class PlanReader {
 public:
  explicit PlanReader(std::string name) : name_(std::move(name)) {}

  [[noreturn]] void fail(const toml::node& node, const std::string& message) const {
    throw Error(name_ + ":" + std::to_string(node.source().begin.line) + ": " + message);
  }

  std::string text(const toml::node& node, const std::string& key) const {
    const auto* value = node.as_string();
    if (value == nullptr) fail(node, key + " must be a text");
    if (value->get().empty()) fail(node, key + " is empty");
    return value->get();
  }

  std::vector<std::string> texts(const toml::node& node, const std::string& key) const {
    const auto* list = node.as_array();
    if (list == nullptr) fail(node, key + " must be a list of texts");
    std::vector<std::string> out;
    for (const toml::node& one : *list) out.push_back(text(one, key));
    return out;
  }

  // The options of a step; `mesh`: where that key is allowed.
  BatchOptions step(const toml::node& node, const std::string& key, std::string* mesh = nullptr) const {
    const auto* table = node.as_table();
    if (table == nullptr) fail(node, key + " must be a table, [" + key + "]");
    BatchOptions out;
    for (const auto& [inner, value] : *table) {
      const std::string whole = key + "." + std::string(inner.str());
      if (inner.str() == "options") {
        out.words = texts(value, whole);
        refuse_own(value, out.words);
      } else if (mesh != nullptr && inner.str() == "mesh") {
        *mesh = text(value, whole);
      } else {
        fail(value, "a plan has no " + printable(whole));
      }
    }
    if (mesh != nullptr && mesh->empty()) fail(node, key + ".mesh is missing");
    return out;
  }

 private:
  void refuse_own(const toml::node& node, const std::vector<std::string>& words) const {
    constexpr std::array<std::string_view, 5> kOwn{"-o", "--output", "--json", "--print-config", "--quiet"};
    for (const std::string& word : words) {
      for (const std::string_view own : kOwn) {
        // A short option's value may follow without a blank.
        const bool is_short = own.size() == 2 && word.starts_with(own);
        if (is_short || word == own || word.starts_with(std::string(own) + "="))
          fail(node, "'" + printable(word) + "' is set by batch itself");
      }
    }
  }

  std::string name_;
};

}  // namespace

std::vector<std::string> BatchOptions::possible_paths() const {
  std::vector<std::string> out;
  for (const std::string& word : words) {
    const std::size_t equals = word.starts_with('-') ? word.find('=') : std::string::npos;
    if (equals != std::string::npos && equals + 1 < word.size()) out.push_back(word.substr(equals + 1));
    if (!word.empty() && !word.starts_with('-')) out.push_back(word);
  }
  return out;
}

BatchPlan parse_batch_plan(std::string_view text, const std::string& name) {
  const PlanReader reader(name);
  BatchPlan out;
  try {
    const toml::table plan = toml::parse(text, name);
    for (const auto& [key, node] : plan) {
      const std::string_view word = key.str();
      if (word == "recordings") {
        out.recordings = reader.texts(node, "recordings");
      } else if (word == "output") {
        out.output = reader.text(node, "output");
      } else if (word == "process") {
        out.process = reader.step(node, "process");
      } else if (word == "texture") {
        out.texture = reader.step(node, "texture");
      } else if (word == "register") {
        out.registration = reader.step(node, "register", &out.mesh);
      } else if (word == "roughness") {
        out.roughness = reader.step(node, "roughness");
      } else {
        reader.fail(node, "a plan has no " + printable(word));
      }
    }
  } catch (const toml::parse_error& error) {
    throw Error(name + ":" + std::to_string(error.source().begin.line) + ": " + std::string(error.description()));
  }
  if (out.recordings.empty()) throw Error(name + ": recordings is missing or empty");
  return out;
}

}  // namespace asperity

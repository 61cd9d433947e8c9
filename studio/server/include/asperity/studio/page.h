#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "asperity/studio/calls.h"
#include "asperity/studio/document.h"
#include "asperity/studio/force_lease.h"
#include "asperity/studio/hub.h"
#include "asperity/studio/jobs.h"
#include "asperity/studio/message.h"
#include "asperity/studio/project.h"

namespace asperity::studio {

struct FeelConfig;

// What all pages share. Outlives them.
struct Shared {
  Hub& hub;
  Project& project;
  Document& document;
  Jobs& jobs;
  ForceLease& lease;
  bool may_command_forces = true;  // false: bound to other addresses than this machine's, without the second flag
  std::function<void(std::function<void()>)> post;   // passes a function to the studio's thread, from any thread
  std::shared_ptr<const FeelConfig> feel = nullptr;  // with what the Feel page starts; null: the defaults
  // Throws Advice where a page does not let `client` make an edit (Page::check_edit).
  std::function<void(ClientId client, const Edit& edit)> check_edit = [](ClientId, const Edit&) {};
  // What could not be stored when no browser is connected any more: it is stated at the studio's end. Thread-safe.
  std::function<void(const std::string& sentence)> report_loss = [](const std::string&) {};
};

// The server's side of one page: its section of the document, its calls ("scan.start"), its topics ("scan.probe").
// All functions are called on the studio's thread and must not take long: what does goes to jobs.
class Page {
 public:
  virtual ~Page() = default;

  // Once, before the document is read: adds its section and its calls.
  virtual void bind(Document& document, Calls& calls) = 0;
  // Once, after the document was read.
  virtual void start() {}
  // 30 times a second.
  virtual void tick(std::int64_t /*now_ns*/) {}
  // Before an edit, an undo or a redo that `client` asks for: throws Advice if it may not, such as one that changes the
  // force on another's hand.
  virtual void check_edit(ClientId, const Edit&) const {}
  virtual void edited(const Edit&) {}
  virtual void pointed(ClientId, const Pointer&) {}
  virtual void client_left(ClientId) {}
  // Before the end: forces at zero. What is still to be stored goes to Jobs::start_storing.
  virtual void stop() {}
};

}  // namespace asperity::studio

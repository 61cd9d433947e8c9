#pragma once

#include <cstdint>
#include <functional>
#include <memory>

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
  std::function<void(std::function<void()>)> post;   // hands a function to the studio's thread, from any thread
  std::shared_ptr<const FeelConfig> feel = nullptr;  // with what the Feel page starts; null: the defaults
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
  virtual void edited(const Edit&) {}
  virtual void pointed(ClientId, const Pointer&) {}
  virtual void client_left(ClientId) {}
  // Before the end: sensors closed, forces at zero.
  virtual void stop() {}
};

}  // namespace asperity::studio

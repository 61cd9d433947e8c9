#include "common_page.h"

#include <array>
#include <utility>

#include "asperity/base/host_clock.h"
#include "asperity/base/version.h"

namespace asperity::studio {

namespace {

constexpr std::array<std::string_view, 10> kKindNames{"recording", "scene", "mesh",      "texture", "result",
                                                      "image",     "study", "study-log", "table",   "surface"};
constexpr std::int64_t kLook_ns = 2'000'000'000;

Json entries_json(const Project& project) {
  Json out = Json::array();
  for (const Entry& entry : project.entries()) {
    Json each;
    each["kind"] = kKindNames.at(static_cast<std::size_t>(entry.kind));
    each["name"] = entry.name;
    out.push_back(std::move(each));
  }
  return out;
}

}  // namespace

CommonPage::CommonPage(Shared& shared, std::optional<std::string> opened)
    : shared_(shared), opened_(std::move(opened)) {}

void CommonPage::bind(Document&, Calls& calls) {
  bind_document(calls);
  bind_project(calls);
  bind_lease(calls);
}

void CommonPage::bind_document(Calls& calls) {
  calls.add("document.read", [this](const Request& request) {
    Json out;
    out["value"] = shared_.document.value();
    out["version"] = shared_.document.version();
    out["undo"] = shared_.document.undo_label();
    out["redo"] = shared_.document.redo_label();
    request.answer(out);
  });
  calls.add("document.edit", [this](const Request& request) {
    const Json* value = request.args().find("value");
    Edit edit{request.text("path"), Json(), value == nullptr ? Json() : *value, request.text("label"),
              request.text("gesture")};
    shared_.check_edit(request.client(), edit);
    shared_.document.edit(edit.path, std::move(edit.after), edit.label, edit.gesture);
    request.done();
  });
  calls.add("document.undo", [this](const Request& request) {
    if (const auto edit = shared_.document.next_undo()) shared_.check_edit(request.client(), *edit);
    if (!shared_.document.undo()) throw Error("nothing can be undone");
    request.done();
  });
  calls.add("document.redo", [this](const Request& request) {
    if (const auto edit = shared_.document.next_redo()) shared_.check_edit(request.client(), *edit);
    if (!shared_.document.redo()) throw Error("nothing can be redone");
    request.done();
  });
}

void CommonPage::bind_project(Calls& calls) {
  calls.add("project.entries", [this](const Request& request) {
    answer_by_job(shared_.jobs, request, "", "",
                  [project = shared_.project](const Observer&) { return entries_json(project); });
  });
  calls.add("studio.about", [this](const Request& request) {
    Json out;
    out["version"] = kVersion;
    out["folder"] = shared_.project.folder().filename().string();
    out["opened"] = opened_ ? Json(*opened_) : Json();
    out["may_command_forces"] = shared_.may_command_forces;
    out["client"] = request.client();
    out["problems"] = shared_.document.problems();
    request.answer(out);
  });
  calls.add("studio.ping", [](const Request& request) {
    Json out;
    out["t_ns"] = host_now_ns();
    request.answer(out);
  });
}

void CommonPage::bind_lease(Calls& calls) {
  calls.add("lease.acquire", [this](const Request& request) {
    if (!shared_.may_command_forces) {
      throw Advice("this studio does not command forces",
                   "Other machines can reach this studio. Start it with --remote-force to allow forces.");
    }
    const std::int64_t now_ns = host_now_ns();
    Json out;
    out["mine"] = shared_.lease.acquire(request.client(), now_ns);
    request.answer(out);
    send_owner(now_ns);
  });
  calls.add("lease.heartbeat", [this](const Request& request) {
    const std::int64_t now_ns = host_now_ns();
    shared_.lease.heartbeat(request.client(), now_ns);
    Json out;
    out["mine"] = shared_.lease.owner(now_ns) == request.client();
    request.answer(out);
  });
  calls.add("lease.release", [this](const Request& request) {
    shared_.lease.release(request.client());
    request.done();
    send_owner(host_now_ns());
  });
}

void CommonPage::send_owner(std::int64_t now_ns) {
  const std::optional<ClientId> owner = shared_.lease.owner(now_ns);
  if (owner == sent_owner_) return;
  sent_owner_ = owner;
  Json data;
  data["owner"] = owner ? Json(*owner) : Json();
  shared_.hub.broadcast("lease", data);
}

void CommonPage::tick(std::int64_t now_ns) {
  send_owner(now_ns);
  if (looking_ || now_ns - looked_ns_ < kLook_ns) return;
  looking_ = true;
  auto found = std::make_shared<Json>();
  shared_.jobs.start_in(
      "project", "", "", [found, project = shared_.project](const Observer&) { *found = entries_json(project); },
      [this, found](std::exception_ptr error) {
        looking_ = false;
        looked_ns_ = host_now_ns();
        if (error || *found == entries_) return;
        entries_ = std::move(*found);
        shared_.hub.broadcast("entries", entries_);
      });
}

void CommonPage::edited(const Edit& edit) {
  Json data;
  data["path"] = edit.path;
  data["value"] = edit.after;
  data["version"] = shared_.document.version();
  data["undo"] = shared_.document.undo_label();
  data["redo"] = shared_.document.redo_label();
  shared_.hub.broadcast("document", data);
}

void CommonPage::client_left(ClientId client) {
  shared_.lease.release(client);
  send_owner(host_now_ns());
}

}  // namespace asperity::studio

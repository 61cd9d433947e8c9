#include "add/add_page.h"

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "add/addition.h"
#include "add/import_plan.h"
#include "add/surface_look.h"
#include "asperity/base/base64.h"
#include "asperity/recording/read_recording.h"
#include "asperity/recording/recording_source.h"
#include "asperity/recording/write_recording.h"
#include "asperity/texture/texture_file.h"
#include "config_fields.h"
#include "write_target.h"

namespace asperity::studio {

namespace {

// Throws Error naming what is wrong.
std::vector<AddedFile> announced_files(const Json& args) {
  const Json* const files = args.find("files");
  if (files == nullptr || !files->is_array()) throw Error("add.begin: files: is not a list");
  std::vector<AddedFile> out;
  for (const Json& file : *files) {
    const Json* const path = file.is_object() ? file.find("path") : nullptr;
    const Json* const bytes = file.is_object() ? file.find("bytes") : nullptr;
    if (path == nullptr || !path->is_string() || bytes == nullptr || !bytes->is_number() ||
        !(bytes->get<double>() >= 0.0 && bytes->get<double>() <= 9007199254740992.0)) {
      throw Error("add.begin: files: an entry is not {\"path\",\"bytes\"}");
    }
    out.push_back({path->get<std::string>(), static_cast<std::uint64_t>(bytes->get<double>())});
  }
  return out;
}

class AddPage : public Page {
 public:
  explicit AddPage(Shared& shared) : shared_(shared) {}

  void bind(Document&, Calls& calls) override {
    remove_stale_temporary_folders(shared_.project.folder());
    calls.add("add.begin", [this](const Request& request) { begin(request); });
    calls.add("add.bytes", [this](const Request& request) { take_bytes(request); });
    calls.add("add.end", [this](const Request& request) { end(request); });
    calls.add("add.cancel", [this](const Request& request) {
      find(request);
      drop(static_cast<std::uint64_t>(request.integer("addition")));
      request.done();
    });
    calls.add("import.fields", [](const Request& request) {
      MappingConfig mapping;
      const auto fields = list_fields("mapping", mapping);
      request.answer(Json{{"fields", fields_json(fields, fields)}});
    });
    calls.add("import.look", [this](const Request& request) {
      answer_by_job(
          shared_.jobs, request, "", "import.look",
          [choice = import_choice(shared_.project, request.args())](const Observer&) { return import_plan(choice); });
    });
    calls.add("surface.look", [this](const Request& request) {
      answer_by_job(shared_.jobs, request, "", "surface.look",
                    [file = shared_.project.existing(request.text("file")),
                     spacing_m = spacing_of(request)](const Observer&) { return look_at_surface(file, spacing_m); });
    });
    calls.add("surface.texture", [this](const Request& request) { write_texture_of(request); });
    calls.add("import.write", [this](const Request& request) { write_import(request); });
  }

  void client_left(ClientId client) override {
    std::vector<std::uint64_t> gone;
    for (const auto& [number, open] : open_) {
      if (open.client == client) gone.push_back(number);
    }
    for (const std::uint64_t number : gone) drop(number);
  }

 private:
  struct Open {
    ClientId client;
    std::shared_ptr<Addition> addition;
  };

  void begin(const Request& request) {
    if (open_.size() >= kMostAdditions) {
      throw Advice("files are being added already", "Wait until they are added, or cancel.");
    }
    const auto addition = std::make_shared<Addition>(shared_.project, announced_files(request.args()));
    open_.emplace(++last_, Open{request.client(), addition});
    request.answer(Json{{"addition", last_}});
  }

  // Throws Error for an addition that is not there or is another window's.
  std::map<std::uint64_t, Open>::iterator find(const Request& request) {
    const auto found = open_.find(static_cast<std::uint64_t>(request.integer("addition")));
    if (found == open_.end() || found->second.client != request.client()) {
      throw Advice("this addition has ended", "Add the files again.");
    }
    return found;
  }

  // The disk is written to in a lane of its own; its order is that of the calls.
  void take_bytes(const Request& request) {
    const auto file = request.integer("file"), at = request.integer("at");
    if (file < 0 || at < 0) throw Error("add.bytes: file and at must not be negative");
    answer_by_job(
        shared_.jobs, request, "", "",
        [addition = find(request)->second.addition, file, at, text = request.text("base64")](const Observer&) {
          const auto bytes = bytes_of_base64(text);
          if (!bytes) throw Error("add.bytes: base64: is not valid base64");
          addition->append(static_cast<std::size_t>(file), static_cast<std::uint64_t>(at), *bytes);
          return Json::object();
        });
  }

  void end(const Request& request) {
    const auto found = find(request);
    const auto addition = found->second.addition;
    open_.erase(found);
    answer_by_job(shared_.jobs, request, "", "", [addition](const Observer&) {
      Json placed = Json::array();
      for (const Addition::Placed& one : addition->commit()) placed.push_back({{"from", one.from}, {"name", one.name}});
      return Json{{"placed", std::move(placed)}};
    });
  }

  // Behind what still waits to be written of it.
  void drop(std::uint64_t number) {
    auto addition = std::move(open_.at(number).addition);
    open_.erase(number);
    shared_.jobs.start_in(
        "add", "", "", [addition](const Observer&) {}, nullptr);
  }

  // Metres; 0 where the call states none.
  static double spacing_of(const Request& request) {
    const double spacing_mm = request.number("spacing_mm");
    if (!(spacing_mm >= 0.0 && spacing_mm <= 1e3)) throw Error("spacing_mm: must be from 0 to 1000");
    return 1e-3 * spacing_mm;
  }

  void write_texture_of(const Request& request) {
    const std::string name = request.text("name");
    if (!name.ends_with(".texture.json"))
      throw Advice("'" + name + "' does not end in .texture.json", "Give the texture such a name.");
    answer_by_job(shared_.jobs, request, "Texture " + name, "surface.texture",
                  [file = shared_.project.existing(request.text("file")), spacing_m = spacing_of(request),
                   target = write_target(shared_.project, request), name](const Observer& observer) {
                    observer.update("fitting", 0.0);
                    const Texture texture = texture_of_surface(
                        file, spacing_m, name.substr(0, name.size() - std::string(".texture.json").size()));
                    observer.update("writing", 0.9);
                    write_texture(target, texture);
                    return Json{{"texture", name}};
                  });
  }

  void write_import(const Request& request) {
    const std::string name = request.text("name");
    answer_by_job(
        shared_.jobs, request, "Import " + name, "import.write",
        [choice = import_choice(shared_.project, request.args()), target = write_target(shared_.project, request), name,
         &hub = shared_.hub](const Observer& observer) {
          observer.update("reading", 0.0);
          const Recording recording = import_recording(choice);
          observer.update("writing", 0.6);
          OutputFolder folder(target, replaceable_by(source_of(recording)));
          write_recording(folder.path(), recording);
          put_in_place(folder, name, hub);
          return Json{{"recording", name}, {"probe_rows", recording.probe.size()}, {"poses", recording.tracker.size()}};
        });
  }

  Shared& shared_;
  std::map<std::uint64_t, Open> open_;
  std::uint64_t last_ = 0;
};

}  // namespace

std::unique_ptr<Page> make_add_page(Shared& shared) { return std::make_unique<AddPage>(shared); }

}  // namespace asperity::studio

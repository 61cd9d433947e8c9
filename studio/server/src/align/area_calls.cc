#include "align/area_calls.h"

#include <utility>

#include "asperity/studio/calls.h"
#include "config_fields.h"
#include "write_target.h"

namespace asperity::studio {

void AreaCalls::bind(Calls& calls) {
  calls.add("align.registered", [this](const Request& request) {
    answer_in_lane(shared_.jobs, "project", request, "", "",
                   [project = shared_.project](const Observer&) { return list_registered(project); });
  });
  calls.add("align.area_config", [this](const Request& request) {
    AreaConfig config = choice().area.config(), first;
    request.answer(fields_json(list_fields("", config), list_fields("", first)));
  });
  calls.add("align.area", [this](const Request& request) { make(request); });
  calls.add("align.area_write", [this](const Request& request) { write(request); });
}

AlignChoice AreaCalls::choice() const { return choice_of_json(shared_.document.section("align")); }

void AreaCalls::make(const Request& request) {
  const AlignChoice::Area wanted = choice().area;
  if (wanted.folder.empty())
    throw Advice("no registered scans are chosen", "Choose a folder that a registration of several scans wrote.");
  const std::filesystem::path folder = shared_.project.existing(wanted.folder);
  const std::uint64_t number = ++made_;
  struct Made {
    std::shared_ptr<const AlignArea> area;
    std::unique_ptr<BlockWriter> block;
  };
  auto made = std::make_shared<Made>();
  shared_.jobs.check_room();
  shared_.jobs.start_in(
      "align area", "Area of " + wanted.folder, "align.area",
      [made, wanted, folder](const Observer& observer) {
        made->area = make_align_area(wanted.folder, folder, wanted.config(), observer);
        observer.update("drawing", 0.9);
        made->block = std::make_unique<BlockWriter>(area_block(*made->area));
      },
      [this, made, request, number](std::exception_ptr error) {
        try {
          if (error) std::rethrow_exception(error);
          if (number == made_) last_ = made->area;
          made->block->head()["number"] = number;
          request.answer(std::move(*made->block));
        } catch (const std::exception& fault) {
          request.refuse(fault);
        }
      });
}

void AreaCalls::write(const Request& request) const {
  const std::string name = request.text("name");
  write_target(shared_.project, request);
  if (!last_ || static_cast<std::uint64_t>(request.integer("number")) != made_)
    throw Advice("the area on the screen is not the newest one", "Make the area again.");
  answer_by_job(shared_.jobs, request, "Writing " + name, "align.area_write",
                [area = last_, name, project = shared_.project, hub = &shared_.hub](const Observer&) {
                  return write_align_area(*area, project, name, *hub);
                });
}

}  // namespace asperity::studio

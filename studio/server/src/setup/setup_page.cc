#include "setup/setup_page.h"

#include <string>

#include "setup/mesh_info.h"
#include "setup/project_setup.h"

namespace asperity::studio {

namespace {

class SetupPage : public Page {
 public:
  explicit SetupPage(Shared& shared) : shared_(shared) {}

  void bind(Document& document, Calls& calls) override {
    document.add_section(kProjectSection, json_of_setup({}), [](const Json& section) { setup_of_json(section); });
    calls.add("mesh.info", [this](const Request& request) {
      const std::filesystem::path file = shared_.project.existing(request.text("file"));
      const std::string own = request.has("unit") ? request.text("unit") : "";
      answer_by_job(shared_.jobs, request, "", "mesh.info",
                    [file, reading = mesh_reading(file, own, project_setup(shared_.document))](
                        const Observer& observer) { return read_mesh_info(file, reading, observer); });
    });
  }

 private:
  Shared& shared_;
};

}  // namespace

std::unique_ptr<Page> make_setup_page(Shared& shared) { return std::make_unique<SetupPage>(shared); }

}  // namespace asperity::studio

#include "home/home_page.h"

#include <set>
#include <string>
#include <utility>

#include "asperity/base/output.h"
#include "asperity/base/text.h"
#include "home/recent_projects.h"
#include "home/sample_project.h"

namespace asperity::studio {

namespace {

namespace fs = std::filesystem;

class HomePage : public Page {
 public:
  HomePage(Shared& shared, fs::path recent) : shared_(shared), recent_(std::move(recent)) {}

  void bind(Document&, Calls& calls) override {
    calls.add("home.recent", [this](const Request& request) {
      answer_by_job(shared_.jobs, request, "", "",
                    [recent = recent_, own = shared_.project.folder().string()](const Observer&) {
                      return recent_json(recent, own);
                    });
    });
    calls.add("home.sample", [this](const Request& request) {
      answer_by_job(shared_.jobs, request, "Making the sample project", "home.sample",
                    [project = shared_.project](const Observer& observer) {
                      const std::string name = project.free_name(kSampleFolder);
                      OutputFolder folder(project.writable(name), [](const fs::path&) { return false; });
                      write_sample_project(folder.path(), observer);
                      folder.commit();
                      return Json{{"folder", name}, {"recording", name + '/' + kSampleRecording}};
                    });
    });
  }

 private:
  // The other projects; those whose folder has gone are left out.
  static Json recent_json(const fs::path& recent, const std::string& own) {
    Json out = Json::array();
    std::error_code error;
    for (const RecentProject& one : read_recent_projects(recent)) {
      if (one.folder == own || !fs::is_directory(one.folder, error)) continue;
      out.push_back({{"folder", printable(one.folder, 500)}, {"opened", printable(one.opened, 40)}});
    }
    return out;
  }

  Shared& shared_;
  fs::path recent_;
};

}  // namespace

std::unique_ptr<Page> make_home_page(Shared& shared, const fs::path& recent) {
  return std::make_unique<HomePage>(shared, recent);
}

}  // namespace asperity::studio

#pragma once

#include <cstdint>
#include <exception>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "align/align_run.h"
#include "align/align_scene.h"
#include "align/area_calls.h"
#include "asperity/geometry/mesh_bvh.h"
#include "asperity/studio/page.h"

namespace asperity::studio {

// The page Align: a scan path is laid on a mesh, by hand, by picked points or by registration, and written as a scene
// (thesis §5.4, Fig. 23; docs/studio-align.md).
class AlignPage : public Page {
 public:
  explicit AlignPage(Shared& shared) : shared_(shared), areas_(shared) {}

  void bind(Document& document, Calls& calls) override;
  void tick(std::int64_t now_ns) override;
  void edited(const Edit& edit) override;

 private:
  AlignChoice choice() const;
  Json ran() const;  // the document's, null if there is none
  // The pose that is shown: the document's, or where one begins.
  Pose pose(const AlignScene& scene) const;
  // The scene of the present choice. Throws Advice if it is not open.
  std::shared_ptr<const AlignScene> scene() const;

  void open(const Request& request);
  void turn_sliders(const Request& request) const;
  void pick(const Request& request);
  void measure(const Request& request);
  void judge(const Request& request);
  void run(const Request& request);
  // Registers the open scene; `after` is called with what went wrong, or with nothing.
  void register_from(const std::optional<Pose>& guess, const std::map<std::string, std::string>& config,
                     const std::string& title, std::function<void(std::exception_ptr)> after);
  void finish(AlignRun run);
  void forget_result();
  // Brings the result in line with the registration that the document names: nothing that was seen is lost by a
  // restart, and an undo takes it back.
  void follow_document();
  void accept(const Request& request);
  void write(const Request& request);
  void send_iterations();

  Shared& shared_;
  std::shared_ptr<const AlignScene> scene_;
  std::shared_ptr<const BlockWriter> block_;  // of scene_, as it is sent
  // Of the last residuals, for the lane alone that takes them.
  std::shared_ptr<std::vector<ClosestPoint>> closest_;
  std::uint64_t runs_ = 0;
  std::shared_ptr<IterationLog> log_;
  std::optional<AlignRun> last_;
  bool running_ = false;
  AreaCalls areas_;
  Json sent_ran_;  // the document's "ran" that last_ is the result of, or that could not be worked out
};

std::unique_ptr<Page> make_align_page(Shared& shared);

}  // namespace asperity::studio

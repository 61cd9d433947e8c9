#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "align/align_run.h"
#include "align/align_scene.h"
#include "asperity/geometry/mesh_bvh.h"
#include "asperity/studio/page.h"

namespace asperity::studio {

// The page Align: a scan path is laid on a mesh, by hand, by picked points or by registration, and written as a scene
// (seed §5.4, Fig. 23; docs/studio-align.md).
class AlignPage : public Page {
 public:
  explicit AlignPage(Shared& shared) : shared_(shared) {}

  void bind(Document& document, Calls& calls) override;
  void tick(std::int64_t now_ns) override;

 private:
  AlignChoice choice() const;
  // The pose that is shown: the document's, or where one begins.
  Pose pose(const AlignScene& scene) const;
  // The scene of the present choice. Throws Advice if it is not open.
  std::shared_ptr<const AlignScene> scene() const;

  void open(const Request& request);
  void turn_sliders(const Request& request) const;
  void pick(const Request& request);
  void measure(const Request& request);
  void run(const Request& request);
  void finish(const Request& request, AlignRun run);
  void accept(const Request& request);
  void write(const Request& request);
  void tell_iterations();

  Shared& shared_;
  std::shared_ptr<const AlignScene> scene_;
  std::vector<ClosestPoint> closest_;  // of the last residuals
  std::uint64_t runs_ = 0;
  std::shared_ptr<IterationLog> log_;
  std::optional<AlignRun> last_;
};

std::unique_ptr<Page> make_align_page(Shared& shared);

}  // namespace asperity::studio

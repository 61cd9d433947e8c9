#pragma once

#include <cstdint>
#include <functional>
#include <memory>

#include "asperity/scene/scene.h"
#include "asperity/session/tile_touches.h"
#include "asperity/studio/calls.h"
#include "feel/feel_setup.h"

namespace asperity::studio {

// A scene that is rendered instead of the one of the Feel page, blind: a trial of a study.
struct FeelVisit {
  std::uint64_t key = 0;                  // of the presented scene; not 0
  FeelSetup setup;                        // device and settings
  std::function<Scene(FeelSetup&)> make;  // called on a job's thread
  std::shared_ptr<TileTouches> touches;   // hears of all ticks while it is presented; may be null
};

// The one loop that commands forces, lent to another page. Its limit, lease, watchdog and stop are those of the Feel
// page. On the studio's thread.
class FeelHost {
 public:
  virtual ~FeelHost() = default;

  // Starts the device of `visit`, and answers `request` when it is rendered, or with the refusal. Throws Advice while
  // something is rendered.
  virtual void visit(const Request& request, FeelVisit visit) = 0;
  // Lays something else under the hand. The force is at zero while that is done, and for kHold_ns after.
  virtual void change_visit(FeelVisit visit) = 0;
  // Ends the visit, if there is one.
  virtual void leave() = 0;
  // Whether a visit continues and is not leaving, and the key of the scene that is rendered now; 0: none, or no force
  // is permitted.
  virtual bool is_visited() const = 0;
  // Whether one is at its end, the force going to zero; another can begin after.
  virtual bool is_leaving() const = 0;
  virtual std::uint64_t visited_key() const = 0;
  // Called after any of these has changed.
  virtual void on_visit(std::function<void()> changed) = 0;

  static constexpr std::int64_t kHold_ns = 300'000'000;
};

}  // namespace asperity::studio

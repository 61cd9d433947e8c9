#pragma once

#include <cstdint>
#include <memory>

#include "align/align_area.h"
#include "align/align_choice.h"
#include "asperity/studio/page.h"

namespace asperity::studio {

// The calls of the page Align that make areas: align.registered, align.area_config, align.area, align.area_write. The
// last area that was made is kept, so that what was seen is what is written.
class AreaCalls {
 public:
  explicit AreaCalls(Shared& shared) : shared_(shared) {}

  void bind(Calls& calls);

 private:
  AlignChoice choice() const;
  void make(const Request& request);
  void write(const Request& request) const;

  Shared& shared_;
  std::uint64_t made_ = 0;
  std::shared_ptr<const AlignArea> last_;
};

}  // namespace asperity::studio

#include "asperity/link/probe_source.h"

#include <utility>

namespace asperity {

namespace {

class LinkedProbe : public ProbeSource {
 public:
  explicit LinkedProbe(ProbeLink link) : link_(std::move(link)) {}

  void read(std::vector<ProbeSample>& out, std::chrono::milliseconds timeout) override { link_.read(out, timeout); }
  LinkStatistics statistics() const override { return link_.statistics(); }
  std::optional<ProbeDescription> description() const override { return link_.description(); }
  std::string name() const override { return link_.name(); }

 private:
  ProbeLink link_;
};

}  // namespace

std::unique_ptr<ProbeSource> make_probe_source(ProbeLink link) {
  return std::make_unique<LinkedProbe>(std::move(link));
}

}  // namespace asperity

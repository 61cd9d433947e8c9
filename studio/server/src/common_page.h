#pragma once

#include <memory>
#include <optional>
#include <set>
#include <string>

#include "asperity/studio/page.h"

namespace asperity::studio {

// What all pages of the app use: the document's and the project's calls, the lease, what is running here.
class CommonPage : public Page {
 public:
  CommonPage(Shared& shared, std::optional<std::string> opened);

  void bind(Document& document, Calls& calls) override;
  void tick(std::int64_t now_ns) override;
  void edited(const Edit& edit) override;
  void client_left(ClientId client) override;

 private:
  void bind_document(Calls& calls);
  void bind_project(Calls& calls);
  void bind_lease(Calls& calls);
  void send_owner(std::int64_t now_ns);

  Shared& shared_;
  std::optional<std::string> opened_;
  std::optional<ClientId> sent_owner_;
  std::int64_t looked_ns_ = 0;
  bool looking_ = false;
  Json entries_;
};

}  // namespace asperity::studio

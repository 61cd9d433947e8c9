#include "complaint.h"

#include "asperity/base/progress.h"
#include "asperity/studio/calls.h"

namespace asperity::studio {

std::optional<Complaint> complaint_of(const std::exception_ptr& error, const std::string& hint) {
  try {
    std::rethrow_exception(error);
  } catch (const Cancelled&) {
    return std::nullopt;
  } catch (const Advice& advice) {
    return Complaint{advice.what(), advice.hint()};
  } catch (const std::exception& fault) {
    return Complaint{fault.what(), hint};
  }
}

}  // namespace asperity::studio

#pragma once

#include "asperity/studio/calls.h"
#include "asperity/study/study_error.h"

namespace asperity::studio {

// What a user of the Study page can do about a fault.
Advice advice_for(const StudyError& fault);

// What `work` gives; a StudyError becomes Advice.
template <class Work>
auto advised(const Work& work) {
  try {
    return work();
  } catch (const StudyError& fault) {
    throw advice_for(fault);
  }
}

}  // namespace asperity::studio

#pragma once

#include <string>

#include "asperity/base/error.h"

namespace asperity {

// Why a study or its file cannot be used.
enum class StudyFault {
  kForeignFile,         // no file of a study
  kUnknownVersion,      // one of a version that is not known
  kParticipant,         // the participant's code
  kTooFewTextures,      // for the method
  kTooManyTrials,       // more than kMostTrials
  kStaircaseLevels,     // out of order
  kStaircaseReversals,  // none is left after the halvings
  kNoFriction,          // of a texture whose friction is to be changed
  kTexturesChanged,     // since the session began
};

// An Error with its cause, so that a message can state what to do about it.
class StudyError : public Error {
 public:
  StudyError(StudyFault fault, const std::string& message) : Error(message), fault_(fault) {}
  StudyFault fault() const { return fault_; }

 private:
  StudyFault fault_;
};

}  // namespace asperity

#include "study/study_advice.h"

namespace asperity::studio {

namespace {

const char* hint_for(StudyFault fault) {
  switch (fault) {
    case StudyFault::kForeignFile:
      return "Choose a study that this page wrote.";
    case StudyFault::kUnknownVersion:
      return "Open it with the program that wrote it, or with a newer one.";
    case StudyFault::kParticipant:
      return "Enter a code such as p01, not a name.";
    case StudyFault::kTooFewTextures:
      return "Choose more textures or images of the folder.";
    case StudyFault::kTooManyTrials:
      return "Use fewer textures or fewer repetitions.";
    case StudyFault::kStaircaseLevels:
      return "Change one of the three.";
    case StudyFault::kStaircaseReversals:
      return "Set at least two reversals more than halvings.";
    case StudyFault::kNoFriction:
      return "Set the study's friction, or choose another parameter.";
    case StudyFault::kTexturesChanged:
      return "Restore what has changed and continue, or begin a new session.";
  }
  return "";
}

}  // namespace

Advice advice_for(const StudyError& fault) { return {fault.what(), hint_for(fault.fault())}; }

}  // namespace asperity::studio

#include "study/study_advice.h"

namespace asperity::studio {

namespace {

const char* hint_for(StudyFault fault) {
  switch (fault) {
    case StudyFault::kForeignFile:
      return "Choose a study that this page has written.";
    case StudyFault::kUnknownVersion:
      return "Open it with the program that has written it, or a newer one.";
    case StudyFault::kParticipant:
      return "Give one such as p01; no names.";
    case StudyFault::kTooFewTextures:
      return "Choose more textures or images of the folder.";
    case StudyFault::kTooManyTrials:
      return "Take fewer textures or fewer repetitions.";
    case StudyFault::kStaircaseLevels:
      return "Change one of the three.";
    case StudyFault::kStaircaseReversals:
      return "Ask for two reversals more than halvings, or more.";
  }
  return "";
}

}  // namespace

Advice advice_for(const StudyError& fault) { return {fault.what(), hint_for(fault.fault())}; }

}  // namespace asperity::studio

#include "limit_table.h"

#include <fmt/format.h>

#include "add/addition.h"
#include "asperity/studio/force_lease.h"
#include "asperity/studio/hub.h"
#include "asperity/studio/jobs.h"
#include "asperity/studio/message.h"
#include "asperity/studio/web_server.h"
#include "client_table.h"
#include "control_folder.h"
#include "outbox.h"
#include "server_limits.h"

namespace asperity::studio {

namespace {

std::string bytes_text(std::size_t bytes) {
  constexpr std::size_t kKiB = 1024, kMiB = kKiB * kKiB;
  return bytes % kMiB == 0 ? fmt::format("{} MiB", bytes / kMiB) : fmt::format("{} KiB", bytes / kKiB);
}

// 200000 as 200,000.
std::string count_text(std::size_t count) {
  std::string out = std::to_string(count);
  for (std::size_t at = out.size(); at > 3; at -= 3) out.insert(at - 3, ",");
  return out;
}

std::string time_text(double seconds) {
  return seconds < 1.0 ? fmt::format("{:.0f} ms", 1000.0 * seconds) : fmt::format("{:.0f} s", seconds);
}

double in_seconds(std::chrono::nanoseconds time) { return std::chrono::duration<double>(time).count(); }

std::vector<LimitRow> connection_rows() {
  const WebServerConfig config;
  return {
      {"TLS handshakes",
       fmt::format("{:.0f} a second, {} at once", 1.0 / in_seconds(kHandshakesApart), kMostHandshakesAhead),
       "the others wait in a queue; closed if they start later than the time for a handshake",
       {"TlsServer.SpreadsHandshakes"}},
      {"a request's header", bytes_text(kMostHeaderBytes), "431", {"WebServerLimits.HeaderAndBody"}},
      {"a request's body", bytes_text(kMostBodyBytes), "413", {"WebServerLimits.HeaderAndBody"}},
      {"time for a TLS handshake; for a request; for its answer; for a WebSocket's handshake; each",
       time_text(config.request_timeout_s),
       "the connection is closed",
       {"TlsServer.EndsHandshakesThatDoNotEnd", "WebServerAbuse.EndsConnectionsThatTrickle",
        "WebServerLimits.AnAnswerThatIsNotTaken", "WebServerAbuse.EndsConnectionsThatAreHalfOpen"}},
      {"what comes behind a connection's last answer",
       bytes_text(kMostDrainedBytes),
       "the connection is closed",
       {"WebServerLimits.WhatComesBehindTheLastAnswer"}},
      {"a wrong token",
       time_text(in_seconds(kGuessDelay)),
       "that much later is it answered (403)",
       {"WebServerLimits.AWrongTokenIsAnsweredLate"}},
      {"sessions",
       count_text(kMostSessions),
       "the oldest without a window ends; 503 if all have one",
       {"Sessions.AreBounded"}},
      {"windows (WebSockets)",
       count_text(static_cast<std::size_t>(config.max_clients)),
       "close code 1013",
       {"WebServerLimits.Windows"}},
      {"connections in addition to these",
       count_text(kMostHttpConnections),
       "closed at once",
       {"WebServerLimits.Connections"}},
      {"a window without a sign of life",
       time_text(config.idle_timeout_s),
       "asked by a ping at half of that, then closed",
       {"WebServerAbuse.EndsConnectionsThatAreHalfOpen"}},
      {"heartbeats of the one that holds the force",
       time_text(1e-9 * static_cast<double>(ForceLease::kSilence_ns)),
       "it holds the force no more",
       {"ForceLease.EndsWithTheHeartbeats"}},
  };
}

std::vector<LimitRow> message_rows() {
  return {
      {"a message",
       bytes_text(kMaxMessageBytes),
       "close code 1009",
       {"WebServerAbuse.EndsConnectionsOfEnormousFrames"}},
      {"a message's depth; keys of one object; values",
       fmt::format("{}; {}; {}", kMaxMessageDepth, count_text(kMaxMessageKeys), count_text(kMaxMessageValues)),
       "close code 1008, as of any malformed one",
       {"DecodeMessage.BoundsLengthDepthAndKeys"}},
      {"calls of a window that wait for their answers",
       count_text(ClientTable::kMostUnanswered),
       "refused",
       {"WebServerAbuse.BoundsCallsThatAreNotAnswered"}},
      {"these calls together",
       bytes_text(ClientTable::kMostUnansweredBytes),
       "nothing more is read from it until answers have gone out; closed after the time without a sign of life",
       {"WebServerAbuse.ReadsNoMoreWhileMebibytesOfCallsWait",
        "WebServerAbuse.EndsAConnectionWhoseCallsAreNeverAnswered"}},
      {"pointers",
       fmt::format("{} a second, {} at once", count_text(static_cast<std::size_t>(1.0 / in_seconds(kPointersApart))),
                   kMostPointersAhead),
       "left out",
       {"WebServerLimits.Pointers"}},
      {"topics of a window", count_text(ClientTable::kMostTopics), "refused", {"WebServerAbuse.BoundsTopics"}},
      {"work that waits", count_text(Jobs::kMostWaiting) + " jobs", "refused", {"JobsTest.NoMoreThanSoManyWait"}},
  };
}

std::vector<LimitRow> waiting_rows() {
  return {
      {"pictures and states that wait for a slow window",
       "the newest of each",
       "the older one is dropped",
       {"WebServerOutbox.KeepsTheNewestPictureInItsPlace"}},
      {"series that wait for it",
       bytes_text(kMaxSeriesBytes),
       "the oldest are dropped",
       {"WebServerOutbox.DropsTheOldestOfASeries", "WebServerAbuse.DropsFramesForABrowserThatDoesNotRead"}},
      {"answers and events that wait for it",
       fmt::format("{} or {}", bytes_text(Outbox::kMostMessageBytes), count_text(Outbox::kMostMessages)),
       "the window is cut off",
       {"WebServerOutbox.TakesTenThousandAnswersOr64MiB", "WebServerAbuse.CutsOffABrowserThatDoesNotTakeItsAnswers"}},
      {"these for all windows together",
       bytes_text(ClientTable::kMostMessageBytes),
       "the one for which most waits is cut off",
       {"WebServerClients.AreCutOffWhereAllTogetherAreTooMuch"}},
  };
}

std::vector<LimitRow> document_rows() {
  return {
      {"files that are added at once; their bytes; folders deep",
       fmt::format("{}; {}; {}", count_text(kMostAddedFiles), bytes_text(kMostAddedBytes), kDeepestAdded),
       "refused, and nothing is added",
       {"AddPageTest.BoundsWhatOneAdditionBrings", "AddPageTest.PathsThatLeadElsewhereAreRefusedAndNothingIsMade"}},
      {"additions that are under way, of all windows",
       count_text(kMostAdditions),
       "refused",
       {"AddPageTest.BoundsWhatOneAdditionBrings"}},
      {"a section of the document",
       bytes_text(kLargestSectionBytes),
       "the edit is refused",
       {"DocumentTest.BoundsASectionAndItsSteps"}},
      {"steps to undo",
       fmt::format("{} or {}", kMostUndoSteps, bytes_text(kMostUndoBytes)),
       "the oldest are dropped",
       {"DocumentTest.BoundsASectionAndItsSteps", "DocumentTest.ManyLargeEditsStayWithinWhatIsReadAgain"}},
      {"an edit's path; its parts; its label",
       fmt::format("{} bytes; {}; {} bytes", count_text(kLongestPath), kMostPathParts, kLongestLabel),
       "the edit is refused",
       {"DocumentTest.LongPathsAndLabelsAreRefusedAtOnce"}},
      {"a PEM file; certificates in it",
       fmt::format("{}; {}", bytes_text(kMostPemBytes), kMostCertificates),
       "the studio does not start",
       {"TlsFiles.AreRefusedWhereTheyAreNoSuch"}},
      {"a request at the control socket; the time for it",
       fmt::format("{}; {}", bytes_text(kMostControlRequest_bytes), time_text(in_seconds(kControlPatience))),
       "closed without an answer",
       {"Control.RefusesWhatItDoesNotKnow", "Control.WaitsForNobodyLong"}},
  };
}

}  // namespace

std::vector<LimitRow> limit_rows() {
  std::vector<LimitRow> out = connection_rows();
  for (const auto& rows : {message_rows(), waiting_rows(), document_rows()}) {
    out.insert(out.end(), rows.begin(), rows.end());
  }
  return out;
}

std::string limit_table() {
  std::string out = "| What | Limit | Beyond it | Test |\n|---|---|---|---|\n";
  for (const LimitRow& row : limit_rows()) {
    std::string tests;
    for (const std::string& test : row.tests) {
      if (!tests.empty()) tests += ", ";
      tests += "`" + test + "`";
    }
    out += "| " + row.what + " | " + row.limit + " | " + row.beyond + " | " + tests + " |\n";
  }
  return out;
}

}  // namespace asperity::studio

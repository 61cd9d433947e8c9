#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>

namespace asperity::studio {

// What one browser may cost the server. Those of messages are in message.h, those of what waits for a browser in
// outbox.h and client_table.h, of work in jobs.h; all of them are in the table of docs/studio-safety.md
// (limit_table.h).
inline constexpr std::uint32_t kMostHeaderBytes = 8U << 10U;
inline constexpr std::uint64_t kMostBodyBytes = 4U << 10U;
inline constexpr auto kGuessDelay = std::chrono::milliseconds(250);
// Open connections that are not WebSockets, or not yet.
inline constexpr int kMostHttpConnections = 64;
// TLS handshakes that are begun: at most one in this time, in heaps of at most so many. Each costs a signature, which a
// connected window must not wait for.
inline constexpr auto kHandshakesApart = std::chrono::milliseconds(50);
inline constexpr int kMostHandshakesAhead = 8;
inline constexpr std::size_t kMostSessions = 64;
// Pointers of one browser: at most one in this time, in heaps of at most so many.
inline constexpr auto kPointersApart = std::chrono::milliseconds(1);
inline constexpr int kMostPointersAhead = 100;
// Bytes that are read and thrown away behind the last answer of a connection.
inline constexpr std::size_t kMostDrainedBytes = 1U << 20U;

// The document that browsers edit.
inline constexpr std::size_t kLargestSectionBytes = 4U << 20U;
inline constexpr std::size_t kMostUndoSteps = 200;
inline constexpr std::size_t kMostUndoBytes = 8U << 20U;
inline constexpr std::size_t kLongestPath = 1000;
inline constexpr std::size_t kMostPathParts = 32;
inline constexpr std::size_t kLongestLabel = 200;

// Files of --tls-cert and --tls-key.
inline constexpr std::size_t kMostPemBytes = 256U << 10U;
inline constexpr int kMostCertificates = 10;

}  // namespace asperity::studio

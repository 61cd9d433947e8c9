#pragma once

namespace asperity {

// What a hand would notice of a difference, as far as the difference's own uncertainty lets it be known.
enum class HandVerdict { kSame, kNoticeable, kUndetermined };

}  // namespace asperity

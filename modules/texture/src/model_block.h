#pragma once

#include <string>
#include <vector>

#include "asperity/texture/texture.h"
#include "asperity/texture/texture_file.h"
#include "block_json.h"

namespace asperity {

// The member of extra that is ours.
inline constexpr const char* kFitKey = "fit";

// What a model's block is read from; whoever reads it finishes it. `path` is the block's key, the model's name.
struct BlockInput {
  JsonObject& block;
  std::string path;
  const PayloadReader& payload;

  // The content of the file that the block's member `file` names. Throws Error for a name that is not a
  // plain file name ending in `ending`.
  std::string read_payload(const char* ending) const;
};

// What a block is written to, beside its text: payloads, named `stem` and an ending.
struct BlockOutput {
  std::string stem;
  std::vector<TexturePayload> payloads;

  // Keeps `content`; returns the name that the block has for it.
  std::string add_payload(const char* ending, std::string content);
};

}  // namespace asperity

#pragma once

#include <string>
#include <vector>

#include "asperity/texture/texture.h"
#include "asperity/texture/texture_file.h"
#include "block_json.h"

namespace asperity {

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

// One pair of overloads a model, in a source file of its own. read_block throws Error naming file, line
// and key for whatever the model does not allow; write_block for what could not be read again.
void read_block(const BlockInput& input, Fourier1d& model);
std::string write_block(const Fourier1d& model, BlockOutput& output);
void read_block(const BlockInput& input, Fourier2d& model);
std::string write_block(const Fourier2d& model, BlockOutput& output);
void read_block(const BlockInput& input, HeightMap& model);
std::string write_block(const HeightMap& model, BlockOutput& output);
void read_block(const BlockInput& input, ArealTexture& model);
std::string write_block(const ArealTexture& model, BlockOutput& output);
void read_block(const BlockInput& input, StochasticTexture& model);
std::string write_block(const StochasticTexture& model, BlockOutput& output);
void read_block(const BlockInput& input, AutoregressiveTexture& model);
std::string write_block(const AutoregressiveTexture& model, BlockOutput& output);
void read_block(const BlockInput& input, DecayingSinusoids& model);
std::string write_block(const DecayingSinusoids& model, BlockOutput& output);

}  // namespace asperity

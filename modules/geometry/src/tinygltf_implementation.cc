// The only translation unit with tinygltf's code.
#include <fstream>  // tinygltf 2.7 names it even where TINYGLTF_NO_FS is set

#define TINYGLTF_IMPLEMENTATION
#include "tinygltf_config.h"

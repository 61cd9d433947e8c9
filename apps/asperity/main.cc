#include "asperity/base/version.h"

#include <cstdio>

int main() { std::puts(asperity::kVersion); }

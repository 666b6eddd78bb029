#include "source_dir.h"

const char* hersey::source_dir() { return HERSEY_SOURCE_DIR; }

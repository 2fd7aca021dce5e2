#include "welkin/realtime/shader_sources.hpp"

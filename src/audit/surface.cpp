#include "audit/surface.hpp"

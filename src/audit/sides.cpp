#include "audit/sides.hpp"

#include "audit/timeline.hpp"

#include "audit/ooze.hpp"

#include "audit/exposed.hpp"

#include "audit/machine.hpp"

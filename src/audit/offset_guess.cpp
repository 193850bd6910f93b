#include "audit/offset_guess.hpp"

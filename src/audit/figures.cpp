#include "audit/figures.hpp"

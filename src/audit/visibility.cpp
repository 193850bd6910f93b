#include "audit/visibility.hpp"

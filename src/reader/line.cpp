#include "reader/line.hpp"

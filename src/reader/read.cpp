#include "reader/read.hpp"

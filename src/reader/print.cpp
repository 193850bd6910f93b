#include "reader/print.hpp"

#include "reader/dialect.hpp"

#include "reader/layers.hpp"

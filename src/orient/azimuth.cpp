#include "orient/azimuth.hpp"

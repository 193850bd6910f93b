#include "audit/report.hpp"

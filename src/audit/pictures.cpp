#include "audit/pictures.hpp"

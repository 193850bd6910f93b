#include "shield/rampart.hpp"

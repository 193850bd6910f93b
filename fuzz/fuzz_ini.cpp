#include <cstddef>
#include <cstdint>

#include "config_targets.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  cleancolor::fuzz_ini({reinterpret_cast<const char*>(data), size});
  return 0;
}

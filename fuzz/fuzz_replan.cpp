#include <cstddef>
#include <cstdint>

#include "replan_target.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  cleancolor::fuzz_replan({reinterpret_cast<const char*>(data), size});
  return 0;
}

#include "viewer/array_file.hpp"

#include "array_reader.hpp"

namespace cleancolor {
namespace {

TEST(ArrayFile, GivesBackWhatWasPutIn) {
  const std::vector<float> points = {1, 2, 3, 4.5F, -5, 6e7F};
  const std::vector<std::uint8_t> bytes = {7, 8, 9};
  const std::vector<std::uint16_t> words = {65535};
  const std::vector<std::uint32_t> none;
  const std::array arrays = {named_array("points", points, 3), named_array("bytes", bytes), named_array("words", words),
                             named_array("none", none)};
  const ArrayReader read(array_file(arrays, {{"worst", {3, 1}}}));
  EXPECT_EQ(read.array<float>("points", 3), points);
  EXPECT_EQ(read.array<std::uint8_t>("bytes"), bytes);
  EXPECT_EQ(read.array<std::uint16_t>("words"), words);
  EXPECT_EQ(read.array<std::uint32_t>("none"), none);
  EXPECT_EQ(read.header().at("worst"), nlohmann::json({3, 1}));
}

TEST(ArrayFile, BeginsAsTheManualSays) {
  const std::vector<std::uint32_t> one = {0x01020304};
  const std::string file = array_file(std::array{named_array("n", one)});
  EXPECT_EQ(file.substr(0, 8), "CCARRAY1");
  EXPECT_EQ(file.substr(file.size() - 8), std::string("\x04\x03\x02\x01\0\0\0\0", 8));
}

TEST(ArrayFile, TakesTextsThatAreNoUtf8) {
  EXPECT_NO_THROW(ArrayReader(array_file({}, {{"name", "\xff"}})));
}

}  // namespace
}  // namespace cleancolor

// array_reader.hpp
//
// For tests of the viewer: array files read back, bounds and alignment checked on the way.
#pragma once

#include <gtest/gtest.h>

#include <cstring>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "viewer/array_file.hpp"

namespace cleancolor {

class ArrayReader {
 public:
  explicit ArrayReader(std::string file) : file_(std::move(file)) {
    EXPECT_TRUE(file_.starts_with("CCARRAY1"));
    std::uint32_t length = 0;
    std::memcpy(&length, file_.data() + 8, 4);
    begin_ = 12 + length;
    EXPECT_EQ(begin_ % 8, 0u);
    header_ = nlohmann::json::parse(std::string_view(file_).substr(12, length));
  }

  const nlohmann::json& header() const { return header_; }

  template <class T>
  std::vector<T> array(const std::string& name, std::size_t components = 1) const {
    const nlohmann::json& entry = header_.at("arrays").at(name);
    EXPECT_EQ(entry.at("type"), array_type<T>()) << name;
    EXPECT_EQ(entry.at("components"), components) << name;
    const std::size_t offset = entry.at("offset");
    EXPECT_EQ(offset % 8, 0u) << name;
    std::vector<T> values(entry.at("count").get<std::size_t>() * components);
    EXPECT_LE(begin_ + offset + values.size() * sizeof(T), file_.size()) << name;
    if (!values.empty()) std::memcpy(values.data(), file_.data() + begin_ + offset, values.size() * sizeof(T));
    return values;
  }

 private:
  std::string file_;
  std::size_t begin_ = 0;
  nlohmann::json header_;
};

}  // namespace cleancolor

// viewer/api_error.hpp
//
// ApiError: a request that is refused, with its HTTP status and the field at fault.
#pragma once

#include <string>

#include "base/error.hpp"

namespace cleancolor {

/// An Error like any other to whoever does not care; the API turns it into {"error": {"message", "field"}}.
class ApiError : public Error {
 public:
  ApiError(int status, const std::string& message, std::string field = "")
      : Error(message), status_(status), field_(std::move(field)) {}
  int status() const { return status_; }
  const std::string& field() const { return field_; }

 private:
  int status_;
  std::string field_;
};

}  // namespace cleancolor

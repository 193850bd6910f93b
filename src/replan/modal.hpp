// replan/modal.hpp
//
// Modal lines: what a file says once and means until it says otherwise.
//
//   line  ->  what it sets;  two states  ->  the lines that lead from one to the other
//
// Type, width and height of roads (comments), fans, accelerations and jerk, pressure advance, flow; labels of objects,
// which begin and end. Whoever prints in another order says them anew where they differ.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "reader/line.hpp"

namespace cleancolor {

/// By what is set: the line that set it, verbatim; of a label that ended an empty text.
using ModalState = std::map<std::string, std::string, std::less<>>;

inline constexpr std::string_view type_key = "1 type";
inline constexpr std::string_view width_key = "2 width";
inline constexpr std::string_view height_key = "3 height";
inline constexpr std::string_view mesh_key = "4 mesh";
inline constexpr std::string_view object_id_key = "5 object id";

/// What the line sets; nothing where it is no such line.
struct ModalLine {
  std::string key;
  bool ends = false;  // it ends what another began: a label
};
std::optional<ModalLine> modal_line(const GcodeLine& line);

/// What of it says how fast the carriage may become faster and turn.
ModalState of_moving(const ModalState& state);

/// Whether what is set holds for the tool in use alone: its flow, its pressure advance.
bool is_of_tool(std::string_view key);

/// The same outside of all objects.
ModalState of_no_object(ModalState state);

/// Takes the line into the state.
void take(ModalState& state, const ModalLine& what, std::string_view text);

/// The lines that lead from one state to the other, ends of labels first. What `to` does not know stays as it is.
std::vector<std::string> lines_between(const ModalState& from, const ModalState& to);

/// What a file has set so far, and all that held at some time; equal states once.
class StateLog {
 public:
  void take(const ModalLine& what, std::string_view text);
  void set(std::string_view key, std::string_view text);
  void set_first(std::string_view key, std::string_view text);  // where it is not set yet
  void change_tool(int from, int to);                           // what is of a tool alone goes and comes with it

  std::size_t size() const { return now_.size(); }  // settings
  std::size_t bytes() const { return bytes_; }      // of text, in all states
  std::uint32_t index();                            // of the state that holds now
  const ModalState& now() const { return now_; }
  std::vector<ModalState> all() &&;  // in the order of their indices

 private:
  ModalState now_;
  bool changed_ = true;
  std::uint32_t index_ = 0;
  std::size_t bytes_ = 0;
  std::map<ModalState, std::uint32_t> known_;
  std::map<int, ModalState> of_tool_;  // of those that are not in use
};

}  // namespace cleancolor

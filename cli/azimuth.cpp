#include "cli/azimuth.hpp"

#include <ostream>

#include "base/output_file.hpp"
#include "cli/console.hpp"
#include "cli/report.hpp"
#include "cli/slice.hpp"

namespace cleancolor {

void run(const AzimuthCommand& command, std::ostream& out, std::ostream& err, bool err_is_terminal) {
  Console console(err, {.terminal = err_is_terminal, .quiet = command.slice.quiet});
  const Progress progress = console.progress();
  const SliceRequest request = slice_request(command.slice, progress);
  const Azimuths found = azimuths(request, progress);
  if (request.config.idle_nozzle != IdleNozzle::same_height)
    progress.warn("idle nozzles of this printer leave the print: both curves are what they would do if they did not");
  console.clear();
  if (!command.slice.output.empty()) {
    OutputFile picture(command.slice.output);
    picture.write(azimuth_svg(found));
    picture.commit();
  }
  if (command.json) {
    out << azimuth_json(found);
  } else if (!command.slice.quiet) {
    out << azimuth_table(found);
  }
}

}  // namespace cleancolor

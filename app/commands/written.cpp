// SPDX-License-Identifier: MIT
#include "app/commands/written.h"

#include "app/report.h"
#include "reconstruct/number_text.h"

namespace loft::app {

void tell(const std::filesystem::path& output, const io::Written& written, Terminal& terminal) {
  const auto& [rounding, origin] = written;
  if (origin)
    terminal.warn(
        output.string() + ": coordinates are about " + exact((*origin)[0]) + ", " +
        exact((*origin)[1]) + ", " + exact((*origin)[2]) +
        ", as 32-bit floats cannot hold them about 0; add that, or take .ply, .obj or .off");
  if (rounding.left > 0)
    terminal.warn(output.string() + ": " + counted(rounding.left, "fault") +
                  " by rounding could not be mended (faces without area, that "
                  "meet, or that touch); .ply, .obj and .off keep all digits");
}

}  // namespace loft::app

// SPDX-License-Identifier: MIT
#include "app/descriptors.h"

#include <fcntl.h>
#include <unistd.h>

namespace loft::app {

void open_closed_descriptors() {
  // The lowest number that is free is taken.
  int file = ::open("/dev/null", O_RDONLY);
  while (file >= 0 && file <= STDERR_FILENO) file = ::open("/dev/null", O_RDONLY);
  if (file >= 0) ::close(file);
}

}  // namespace loft::app

// SPDX-License-Identifier: MIT
#include "app/commands/map_outputs.h"

#include "io/bytes/atomic_file.h"
#include "io/bytes/file.h"
#include "io/maps.h"

namespace loft::app {

using std::filesystem::path;

bool is_table(const path& output) { return io::extension(output) == ".csv"; }

void check_table_or_map(const path& output) {
  if (is_table(output)) {
    const io::AtomicFile tried(output);
    return;
  }
  try {
    io::check_writable_map(output);
  } catch (const io::UnknownFormat&) {
    throw io::UnknownFormat(output, ".csv " + io::map_output_extensions());
  }
}

void write_table(const path& output, std::string_view table) {
  io::AtomicFile file(output);
  file.stream() << table;
  file.commit();
}

}  // namespace loft::app

// SPDX-License-Identifier: MIT
#include "io/stack_writer.h"

#include <algorithm>
#include <array>
#include <ostream>

#include "io/bytes/atomic_file.h"
#include "io/bytes/file.h"
#include "io/bytes/format_table.h"
#include "io/contours/cli_writer.h"
#include "io/contours/contour_writer.h"
#include "io/contours/csv_writer.h"
#include "io/stacks/slices_json.h"

namespace loft::io {

namespace {

using Losses = std::vector<std::string>;

Losses write_ndjson(std::ostream& out, const Stack& stack) {
  write_stack_json(out, stack);
  return {};
}

struct StackWriter {
  std::string_view extension;
  Losses (*write)(std::ostream&, const Stack&);
};
constexpr std::array stack_writers{StackWriter{".ndjson", write_ndjson},
                                   StackWriter{".jsonl", write_ndjson},
                                   StackWriter{".csv", write_csv}, StackWriter{".cli", write_cli},
                                   StackWriter{".contour", write_contour}};

}  // namespace

std::vector<std::string> write_stack(const std::filesystem::path& path, const Stack& stack) {
  const StackWriter& format = format_of(stack_writers, path);
  AtomicFile file(path);
  Losses losses = format.write(file.stream(), stack);
  file.commit();
  return losses;
}

void check_stack_writable(const std::filesystem::path& path) {
  static_cast<void>(format_of(stack_writers, path));
  const AtomicFile file(path);
}

std::string stack_writer_extensions() { return extensions_of(stack_writers); }

}  // namespace loft::io

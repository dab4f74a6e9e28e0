// SPDX-License-Identifier: MIT
#include "io/volumes/file_beside.h"

#include "io/bytes/file.h"
#include "io/bytes/text.h"

namespace loft::io {

FileBytes read_file_beside(const StackInput& header, std::string_view field,
                           const std::string& file) {
  const auto fail = [&](const std::string& what) {
    throw InputError(header.name + ": " + std::string(field) + ": " + in_quotes(file) + what);
  };
  const std::filesystem::path path(file);
  if (path.has_parent_path() || path.is_absolute() || file == "..")
    fail(" is not beside the header; put both into one folder");
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(header.folder / path, ignored)) fail(" is not there");
  return FileBytes(header.folder / path);
}

}  // namespace loft::io

// SPDX-License-Identifier: MIT
#include "io/stack_file.h"

#include <algorithm>
#include <fstream>
#include <string>
#include <system_error>
#include <utility>

#include "io/bytes/file.h"
#include "io/bytes/text.h"
#include "io/stacks/join.h"
#include "io/stacks/slice_line.h"
#include "io/stacks/slices_json.h"
#include "io/stacks/stack_format.h"
#include "reconstruct/defect.h"

namespace loft::io {

namespace {

std::ifstream open(const std::filesystem::path& path) {
  if (path == "-")
    throw FileError(Access::read, "standard input",
                    "it cannot be read twice, as working out of core asks for; give a file");
  std::ifstream file(path, std::ios::binary);
  if (!file) throw FileError(Access::read, path, last_cause());
  if (!is_stack_file(path)) throw UnknownFormat(path, stack_extensions());
  return file;
}

std::uint64_t size_of(const std::filesystem::path& path) {
  std::error_code ignored;
  const auto size = std::filesystem::file_size(path, ignored);
  return ignored ? 0 : size;
}

bool is_read_by_line(const std::filesystem::path& path) {
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored)) return false;  // of images
  return path == "-" || find_stack_format(path) == nullptr ||
         find_stack_format(path)->read == read_ndjson;
}

/// A slice without its points; where these are in the world stays.
Slice only_places(const Slice& slice) {
  Slice result{slice.z, {}};
  if (std::ranges::any_of(slice.contours, [](const Contour& c) { return !c.places.empty(); }))
    for (const Contour& contour : slice.contours)
      result.contours.push_back({{}, {}, {}, contour.places});
  return result;
}

}  // namespace

StackFile::StackFile(std::span<const std::filesystem::path> paths, const ReadOptions& options,
                     const Visit& visit)
    : paths_(paths.begin(), paths.end()), labels_(labels_of(paths, options.unlabelled)) {
  if (std::ranges::all_of(paths_, is_read_by_line)) {
    read_lines(options.threads, visit);
    if (options.fill) about_.fill = options.fill;
  } else {
    about_ = read_stack(paths, options);
    keep_in_memory(visit);
  }
}

void StackFile::read_lines(unsigned threads, const Visit& visit) {
  std::uint64_t total = 0;
  for (const auto& path : paths_) total += size_of(path);
  std::uint64_t before = 0;
  std::string problems;
  std::vector<Slice> slices;  // only where their points are in the world
  for (std::size_t f = 0; f < paths_.size(); ++f) {
    try {
      std::ifstream file = open(paths_[f]);
      Stack about =
          for_each_slice(file, paths_[f].string(), threads, [&](Slice&& slice, LinePlace place) {
            entries_.push_back({f, place, slice.z, point_count(slice)});
            const std::uint64_t done = before + place.offset + place.length;
            label_unlabelled(slice, labels_[f]);
            visit(slice, total == 0 ? 1 : static_cast<double>(done) / static_cast<double>(total));
            slices.push_back(only_places(slice));
          });
      join(about_, std::move(about), paths_[f].string(), f == 0);
    } catch (const InputError& error) {
      if (!problems.empty()) problems += '\n';
      problems += error.what();
    }
    before += size_of(paths_[f]);
  }
  if (!problems.empty()) throw InputError(problems);
  about_.slices = std::move(slices);
}

void StackFile::keep_in_memory(const Visit& visit) {
  in_memory_ = std::exchange(about_.slices, {});
  for (std::size_t i = 0; i < in_memory_.size(); ++i) {
    const Slice& slice = in_memory_[i];
    entries_.push_back({0, {}, slice.z, point_count(slice)});
    visit(slice, static_cast<double>(i + 1) / static_cast<double>(in_memory_.size()));
    about_.slices.push_back(only_places(slice));
  }
}

SliceSource StackFile::source() const {
  SliceSource source;
  for (const Entry& entry : entries_) source.slices.push_back({entry.z, entry.points});
  source.read = [this](std::uint32_t i) { return read(i); };
  return source;
}

Slice StackFile::read(std::uint32_t i) const {
  if (!in_memory_.empty()) return in_memory_[i];
  const Entry& entry = entries_[i];
  std::ifstream file = open(paths_[entry.file]);
  std::string text(entry.place.length, '\0');
  file.seekg(static_cast<std::streamoff>(entry.place.offset));
  file.read(text.data(), static_cast<std::streamsize>(text.size()));
  SliceLine line;
  if (file) line = parse_slice_line(without_mark(text));
  if (!file || !line.problems.empty() || line.z != entry.z)
    throw FileError(Access::read, paths_[entry.file], "it changed while it was being read");
  label_unlabelled(line.slice, labels_[entry.file]);
  return std::move(line.slice);
}

}  // namespace loft::io

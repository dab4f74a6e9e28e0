// SPDX-License-Identifier: MIT
#include "app/server/exported_page.h"

#include <algorithm>
#include <limits>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <system_error>

#include "app/exit_code.h"
#include "app/server/assets.h"
#include "io/bytes/atomic_file.h"
#include "io/bytes/file.h"
#include "io/stacks/slices_json.h"

namespace loft::app {

namespace {

std::string base64(std::string_view bytes) {
  constexpr std::string_view digits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t count = std::min<std::size_t>(bytes.size() - i, 3);
    unsigned three = 0;
    for (std::size_t k = 0; k < 3; ++k)
      three = three << 8U | (k < count ? static_cast<unsigned char>(bytes[i + k]) : 0U);
    for (std::size_t k = 0; k < 4; ++k)
      text += k <= count ? digits[three >> (18 - 6 * k) & 63U] : '=';
  }
  return text;
}

void write_file(const std::filesystem::path& file, std::string_view content) {
  io::AtomicFile output(file);
  output.stream().write(content.data(), static_cast<std::streamsize>(content.size()));
  output.commit();
}

/// Scripts from the disk may not be modules.
std::string as_script(std::string_view module) {
  return "(() => {\n'use strict';\n" + std::string(module) + "\n})();\n";
}

std::string page_without_modules(std::string page) {
  constexpr std::string_view module = R"(<script type="module" src="viewer.js"></script>)";
  const std::size_t place = page.find(module);
  if (place == std::string::npos)
    throw Error("this program was built without its viewer, for which npm is needed");
  return page.replace(place, module.size(),
                      "<script defer src=\"export.js\"></script>\n"
                      "  <script defer src=\"contents.js\"></script>\n"
                      "  <script defer src=\"viewer.js\"></script>");
}

/// A text for each part.
Json slabs_of(Shown& shown, const Json& reset) {
  std::set<std::size_t> parts;
  for (const Json& slab : reset["slabs"])
    parts.insert(parse_slab_ranges(slab["id"].get<std::string>())->front().part);
  Json all = Json::array();
  for (const std::size_t part : parts) {
    const SlabRange range{part, 0, std::numeric_limits<std::uint32_t>::max()};
    all.push_back(
        base64(shown.slabs(std::span(&range, 1), std::numeric_limits<std::size_t>::max())));
  }
  return all;
}

Json slices_of(const Shown& shown) {
  Json slices = Json::array();
  for (const double z : shown.heights()) {
    std::string line;
    io::append_slice(line, shown.slice(z).value());
    slices.push_back(std::move(line));
  }
  return slices;
}

void require_empty(const std::filesystem::path& folder) {
  std::error_code error;
  if (!std::filesystem::exists(folder, error)) return;
  if (!std::filesystem::is_directory(folder, error))
    throw UsageError(folder.string() + " is a file; name a folder");
  if (!std::filesystem::is_empty(folder, error))
    throw UsageError(folder.string() + " is not empty; name another folder, or give --force");
}

void write_page(const std::filesystem::path& folder) {
  for (const Asset& asset : assets()) {
    if (asset.path == "/") {
      write_file(folder / "index.html", page_without_modules(std::string(asset.content)));
    } else if (asset.path == "/viewer.js") {
      write_file(folder / "viewer.js", as_script(asset.content));
    } else {
      write_file(folder / asset.path.substr(1), asset.content);
    }
  }
}

}  // namespace

void export_page(Shown& shown, const std::filesystem::path& folder, bool overwrites) {
  if (!overwrites) require_empty(folder);
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) throw io::FileError(io::Access::write, folder, error.message());
  write_page(folder);
  const Json reset = Json::parse(shown.reset_event().first);
  const Json labels = to_json(shown.labels());
  for (const Json& extension : reset.value("downloads", Json::array({".glb", ".ply"})))
    if (const auto content = shown.surface(extension.get<std::string>()))
      write_file(folder / ("surface" + extension.get<std::string>()), *content);
  write_file(folder / "labels.json", print(labels) + '\n');
  const Json contents{{"reset", reset},
                      {"status", shown.status()},
                      {"labels", labels},
                      {"slices", slices_of(shown)},
                      {"slabs", slabs_of(shown, reset)}};
  write_file(
      folder / "contents.js",
      "loftContents(" + contents.dump(-1, ' ', false, Json::error_handler_t::replace) + ");\n");
}

}  // namespace loft::app

// SPDX-License-Identifier: MIT
// Bundles the page and writes it as C++: node build.mjs OUT.cpp, where node_modules is.
import { readFile, writeFile } from 'node:fs/promises';
import { createRequire } from 'node:module';
import { dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';

const folder = dirname(fileURLToPath(import.meta.url));
const out = process.argv[2];
if (!out) throw new Error('usage: node build.mjs OUT.cpp');

const { build } = createRequire(join(process.cwd(), 'package.json'))('esbuild');
const bundle = await build({
  absWorkingDir: folder,
  nodePaths: [join(process.cwd(), 'node_modules')],
  entryPoints: { viewer: 'src/main.js', style: 'viewer.css', live: 'live/main.js', 'live-style': 'live/live.css' },
  bundle: true,
  minify: true,
  format: 'esm',
  target: 'es2022',
  legalComments: 'eof',
  write: false,
  outdir: 'dist',
});

const bundled = (name) => bundle.outputFiles.find((file) => file.path.endsWith(`/${name}`)).contents;
const icon = ['/icon.svg', 'image/svg+xml', await readFile(join(folder, 'icon.svg'))];
const pages = {
  assets: [
    ['/', 'text/html; charset=utf-8', await readFile(join(folder, 'index.html'))],
    ['/viewer.js', 'text/javascript; charset=utf-8', bundled('viewer.js')],
    ['/viewer.css', 'text/css; charset=utf-8', bundled('style.css')],
    ['/export.js', 'text/javascript; charset=utf-8', await readFile(join(folder, 'export.js'))],
    icon,
  ],
  live_assets: [
    ['/', 'text/html; charset=utf-8', await readFile(join(folder, 'live/index.html'))],
    ['/live.js', 'text/javascript; charset=utf-8', bundled('live.js')],
    ['/live.css', 'text/css; charset=utf-8', bundled('live-style.css')],
    icon,
  ],
};

// Octal escapes end after three digits: what comes next is never taken for one more.
function escaped(byte) {
  const isPlain = byte >= 32 && byte <= 126 && !'"?\\'.includes(String.fromCharCode(byte));
  return isPlain ? String.fromCharCode(byte) : `\\${byte.toString(8).padStart(3, '0')}`;
}

// No compiler has to take literals of more than 65,536 bytes.
function pieces(bytes) {
  const lines = [];
  for (let i = 0; i < bytes.length; i += 32768)
    lines.push(`"${Array.from(bytes.subarray(i, i + 32768), escaped).join('')}"sv`);
  return lines.join(',\n');
}

// The function that returns the files of a page.
function definition([name, files]) {
  const contents = files.map(([, , bytes], i) =>
    `  static const std::string file${i} = join({\n${pieces(bytes)}});\n`);
  const entries = files.map(([path, type], i) => `Asset{"${path}", "${type}", file${i}}`);
  return `std::span<const Asset> ${name}() {
${contents.join('')}  static const std::array files{${entries.join(', ')}};
  return files;
}
`;
}

await writeFile(out, `// Made by viewer/build.mjs.
#include <array>
#include <initializer_list>
#include <string>
#include <string_view>

#include "app/server/assets.h"

namespace loft::app {

using namespace std::string_view_literals;

namespace {

std::string join(std::initializer_list<std::string_view> pieces) {
  std::string all;
  for (const std::string_view piece : pieces) all += piece;
  return all;
}

}  // namespace

${Object.entries(pages).map(definition).join('\n')}
}  // namespace loft::app
`);

// SPDX-License-Identifier: MIT
// node build.mjs OUT.cpp: bundles the page and writes it as a C++ source (app/assets.h).
import { readFile, writeFile } from 'node:fs/promises';
import { fileURLToPath } from 'node:url';
import { build, transform } from 'esbuild';

const here = (name) => fileURLToPath(new URL(name, import.meta.url));

async function script() {
  const result = await build({ entryPoints: [here('src/main.js')], bundle: true, minify: true, format: 'esm',
    target: 'es2022', legalComments: 'inline', write: false });
  return result.outputFiles[0].contents;
}

async function style() {
  const { code } = await transform(await readFile(here('style.css'), 'utf8'), { loader: 'css', minify: true });
  return Buffer.from(code);
}

// As `char`, which is signed or not.
function array(name, content) {
  const numbers = Array.from(content, (byte) => (byte < 128 ? byte : `'\\x${byte.toString(16)}'`));
  const lines = [];
  for (let i = 0; i < numbers.length; i += 40) lines.push(numbers.slice(i, i + 40).join(','));
  return `constexpr char ${name}[] = {\n${lines.join(',\n')}};\n`;
}

const files = [
  { name: 'page', path: '/', type: 'text/html; charset=utf-8', content: await readFile(here('index.html')) },
  { name: 'script', path: '/viewer.js', type: 'text/javascript; charset=utf-8', content: await script() },
  { name: 'style', path: '/viewer.css', type: 'text/css; charset=utf-8', content: await style() },
];
const entries = files.map(({ name, path, type }) => `  {"${path}", "${type}", {${name}, sizeof ${name}}},\n`);
const source = `// SPDX-License-Identifier: MIT
// Made by viewer/build.mjs.
#include "app/assets.h"

namespace loft::app {

namespace {

${files.map(({ name, content }) => array(name, content)).join('\n')}
constexpr Asset all[] = {
${entries.join('')}};

}  // namespace

std::span<const Asset> assets() { return all; }

}  // namespace loft::app
`;
await writeFile(process.argv[2], source);

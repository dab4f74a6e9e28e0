// SPDX-License-Identifier: MIT
// Checks glTF files with the Khronos validator: no error and no warning is let through.
//   node validate_gltf.mjs FILE...
import { readFile } from 'node:fs/promises';

const validator = await import('gltf-validator').catch(() => {
  console.error('gltf-validator is not installed; run: npm ci --prefix tests/io');
  process.exit(2);
});

let bad = process.argv.length <= 2;
if (bad) console.error('usage: node validate_gltf.mjs FILE...');
for (const path of process.argv.slice(2)) {
  const { issues } = await validator.default.validateBytes(new Uint8Array(await readFile(path)));
  console.log(`${path}: ${issues.numErrors} errors, ${issues.numWarnings} warnings`);
  for (const { severity, code, message, pointer } of issues.messages) {
    if (severity <= 1) console.log(`  ${code} ${pointer ?? ''}: ${message}`);
  }
  bad ||= issues.numErrors + issues.numWarnings > 0;
}
process.exit(bad ? 1 : 0);

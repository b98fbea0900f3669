// Runs the Khronos glTF validator on a file and prints its report as JSON. Exits with 1 where there is an
// error or a warning.
//
//   node validate_gltf.mjs TOOLS FILE    TOOLS: the folder in which `npm ci` installed package.json

import { readFile } from 'node:fs/promises';
import { createRequire } from 'node:module';
import { basename, join, resolve } from 'node:path';

const [tools, file] = process.argv.slice(2);
const validator = createRequire(join(resolve(tools), 'package.json'))('gltf-validator');
const report = await validator.validateBytes(new Uint8Array(await readFile(file)), {
    uri: basename(file),
    maxIssues: 20,
});
console.log(JSON.stringify(report, null, 1));
process.exit(report.issues.numErrors + report.issues.numWarnings > 0 ? 1 : 0);

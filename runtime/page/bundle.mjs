// Makes the page that plays a motion: one file with its script and style in it, and the mark <!--MOTION--> where
// `samara export` puts the motion.
//
//   node bundle.mjs TOOLS OUTPUT    TOOLS: the folder in which `npm ci` installed package.json

import { readFile, rename, writeFile } from 'node:fs/promises';
import { createRequire } from 'node:module';
import { dirname, join, resolve } from 'node:path';
import { fileURLToPath } from 'node:url';

const [tools, output] = process.argv.slice(2);
const source = dirname(fileURLToPath(import.meta.url));
const esbuild = createRequire(join(resolve(tools), 'package.json'))('esbuild');

async function bundled(entry) {
    const result = await esbuild.build({
        entryPoints: [join(source, entry)],
        bundle: true,
        minify: true,
        format: 'iife',
        target: 'es2020',
        legalComments: 'inline',
        nodePaths: [join(resolve(tools), 'node_modules')],
        write: false,
    });
    return result.outputFiles[0].text;
}

const page = (await readFile(join(source, 'page.html'), 'utf8'))
    .replace('/*STYLE*/', await bundled('style.css'))
    .replace('/*SCRIPT*/', (await bundled('main.js')).replaceAll('$', '$$$$'));
await writeFile(output + '.part', page);
await rename(output + '.part', output);

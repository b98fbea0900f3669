// Reads a .usda file with two readers that know nothing of samara and prints what each found as one JSON object:
//
//   node read_usd.mjs TOOLS FILE    TOOLS: the folder in which `npm ci` installed package.json
//
// three: three.js's USDLoader, its meshes and animation in the stage's own axes, and its parser's time samples.
// tinyusdz: its composed layer, printed again as text, and the meshes of its render scene.
// Exits with 1 and a line where a reader refuses the file.

import { readFile } from 'node:fs/promises';
import { createRequire } from 'node:module';
import { join, resolve } from 'node:path';
import { pathToFileURL } from 'node:url';

const [tools, file] = process.argv.slice(2);
const require = createRequire(join(resolve(tools), 'package.json'));
const bytes = await readFile(file);
const load = (module) => import(pathToFileURL(require.resolve(module)).href);

async function withThree() {
    const { USDLoader } = await load('three/addons/loaders/USDLoader.js');
    const { USDAParser } = await load('three/addons/loaders/usd/USDAParser.js');
    const text = bytes.toString('utf8');
    const group = new USDLoader().parse(text);
    const meshes = [];
    group.traverse((object) => {
        if (!object.isMesh) return;
        const positions = object.geometry.getAttribute('position');
        object.geometry.computeBoundingBox();
        const box = object.geometry.boundingBox;
        meshes.push({
            parent: object.parent.name,
            triangles: (object.geometry.index ?? positions).count / 3,
            box: [box.min.toArray(), box.max.toArray()],
        });
    });
    const tracks = {};
    for (const animation of group.animations ?? []) {
        for (const track of animation.tracks) {
            tracks[track.name] = { times: Array.from(track.times), values: Array.from(track.values) };
        }
    }
    const samples = {};
    const { specsByPath } = new USDAParser().parseData(text);
    for (const [path, spec] of Object.entries(specsByPath)) {
        if (!spec.fields?.timeSamples) continue;
        const { times, values } = spec.fields.timeSamples;
        // The parser looks for a fourth number in every tuple.
        const whole = (value) => (value.length === 4 && !Number.isFinite(value[3]) ? value.slice(0, 3) : value);
        samples[path] = { times, values: values.map(whole) };
    }
    return { turned_upright: group.rotation.x, meshes, tracks, samples, root: specsByPath['/'].fields };
}

async function withTinyusdz() {
    // The package is made for browsers: it is told that this is one, and given its bytes, which it would fetch.
    const folder = join(require.resolve('tinyusdz'), '..');
    const wasm = await readFile(join(folder, 'tinyusdz.wasm'));
    Object.defineProperty(process, 'type', { value: 'renderer' });
    globalThis.window = globalThis;
    console.log = console.error;
    const script = await readFile(join(folder, 'tinyusdz.js'));
    const { default: start } = await import(`data:text/javascript;base64,${script.toString('base64')}`);
    const module = await start({
        instantiateWasm(imports, use) {
            WebAssembly.instantiate(wasm, imports).then((result) => use(result.instance, result.module));
            return {};
        },
    });
    const layer = new module.TinyUSDZLoaderNative();
    layer.setEnableComposition(true);
    if (!layer.loadAsLayerFromBinary(bytes, 'motion.usda')) throw new Error(`tinyusdz: ${layer.error()}`);
    if (layer.hasReferences() && !layer.composeReferences()) throw new Error(`tinyusdz: ${layer.error()}`);
    const text = layer.layerToString();
    const scene = new module.TinyUSDZLoaderNative();
    if (!scene.loadFromBinary(bytes, 'motion.usda')) throw new Error(`tinyusdz: ${scene.error()}`);
    const meshes = [];
    for (let i = 0; i < scene.numMeshes(); ++i) {
        const mesh = scene.getMesh(i);
        meshes.push({ points: mesh.points.length / 3, name: mesh.absPath ?? mesh.primName });
    }
    return { text, meshes };
}

const print = process.stdout.write.bind(process.stdout);
try {
    const three = await withThree();
    print(JSON.stringify({ three, tinyusdz: await withTinyusdz() }));
} catch (fault) {
    console.error(String(fault.message ?? fault).slice(0, 500));
    process.exit(1);
}

// Reads a .glb file with three.js's GLTFLoader and prints its meshes as one JSON object:
//
//   node read_gltf.mjs TOOLS FILE    TOOLS: the folder in which `npm ci` installed package.json
//
// For each mesh its name, colour, number of triangles and the matrices (by columns) of its instances, or its own.

import { readFile } from 'node:fs/promises';
import { createRequire } from 'node:module';
import { join, resolve } from 'node:path';
import { pathToFileURL } from 'node:url';

const [tools, file] = process.argv.slice(2);
const require = createRequire(join(resolve(tools), 'package.json'));
const load = (module) => import(pathToFileURL(require.resolve(module)).href);

globalThis.self = globalThis;
const { GLTFLoader } = await load('three/addons/loaders/GLTFLoader.js');
const bytes = await readFile(file);
const { scene } = await new GLTFLoader().parseAsync(bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.byteLength), '');
scene.updateMatrixWorld();
const meshes = [];
scene.traverse((object) => {
    if (!object.isMesh) return;
    const matrix = object.matrixWorld.clone();
    const matrices = Array.from({ length: object.isInstancedMesh ? object.count : 1 }, (_, i) => {
        if (object.isInstancedMesh) object.getMatrixAt(i, matrix);
        else matrix.identity();
        return matrix.premultiply(object.matrixWorld).toArray();
    });
    meshes.push({
        name: object.name,
        instanced: object.isInstancedMesh === true,
        color: object.material.color.toArray(),
        triangles: object.geometry.index.count / 3,
        matrices,
    });
});
console.log(JSON.stringify(meshes));

// All copies of one body, as instanced meshes of several levels of detail.

import {
    BufferAttribute, BufferGeometry, Color, DynamicDrawUsage, InstancedMesh, Matrix4, MeshStandardMaterial, Quaternion, Vector3,
} from 'three';
import { materialsOf } from './look.js';
import { poseAt } from './motion.js';

/** The levels of detail: the least radius in pixels, and the most triangles. */
const LEVELS = [{ from: 22, most: Infinity }, { from: 6, most: 320 }, { from: 0, most: 48 }];
const LEAST_RADIUS = 3.5;  // pixels: smaller copies are drawn larger

export function geometryOf({ points, normals, triangles, texture, look }) {
    const geometry = new BufferGeometry();
    geometry.setAttribute('position', new BufferAttribute(points, 3));
    if (texture?.length > 0) geometry.setAttribute('uv', new BufferAttribute(texture, 2));
    geometry.setIndex(new BufferAttribute(triangles, 1));
    if (normals.length > 0) geometry.setAttribute('normal', new BufferAttribute(normals, 3));
    else geometry.computeVertexNormals();
    let first = 0;
    look?.materials.forEach((material, slot) => {
        geometry.addGroup(first, 3 * material.triangles, slot);
        first += 3 * material.triangles;
    });
    return geometry;
}

/** Numbers keys in the order in which they occur. */
class Numbering {
    constructor() {
        this.numbers = new Map();
    }

    of(key) {
        if (!this.numbers.has(key)) this.numbers.set(key, this.numbers.size);
        return this.numbers.get(key);
    }
}

/**
 * Returns the surface with the points of each grid cell merged into their mean. Points with normals in different octants
 * stay separate, so that the two faces of a thin body are lit separately though they may coincide in space.
 */
function clustered({ points, normals, triangles }, cell) {
    const places = new Numbering();
    const corners = new Numbering();
    const sums = [];
    const shading = [];
    const placeOfCorner = [];
    const cornerOf = new Uint32Array(points.length / 3);
    for (let i = 0; i < cornerOf.length; ++i) {
        const at = 3 * i;
        const place = places.of([0, 1, 2].map((k) => Math.floor(points[at + k] / cell)).join());
        const octant = (normals[at] > 0) + 2 * (normals[at + 1] > 0) + 4 * (normals[at + 2] > 0);
        const corner = corners.of(8 * place + octant);
        const sum = (sums[place] ??= [0, 0, 0, 0]);
        const shade = (shading[corner] ??= [0, 0, 0]);
        for (let k = 0; k < 3; ++k) {
            sum[k] += points[at + k];
            shade[k] += normals[at + k];
        }
        ++sum[3];
        placeOfCorner[corner] = place;
        cornerOf[i] = corner;
    }
    const kept = [];
    for (let i = 0; i < triangles.length; i += 3) {
        const [a, b, c] = [0, 1, 2].map((k) => cornerOf[triangles[i + k]]);
        const [p, q, r] = [a, b, c].map((corner) => placeOfCorner[corner]);
        if (p !== q && q !== r && r !== p) kept.push(a, b, c);
    }
    return {
        points: Float32Array.from(placeOfCorner.flatMap((place) => {
            const [x, y, z, count] = sums[place];
            return [x / count, y / count, z / count];
        })),
        normals: normals.length === 0 ? normals : Float32Array.from(shading.flatMap((shade) => {
            const length = Math.hypot(...shade) || 1;
            return shade.map((value) => value / length);
        })),
        triangles: Uint32Array.from(kept),
    };
}

/** Returns the body's surface at a level of LEVELS, or the coarsest one that keeps a shape. */
export function surfaceAt(body, level) {
    const { most } = LEVELS[level];
    let surface = body;
    for (let parts = 16; surface.triangles.length > 3 * most && parts > 2; --parts) {
        const coarser = clustered(body, (2 * body.radius) / parts);
        if (coarser.triangles.length === 0) break;
        surface = coarser;
    }
    return surface;
}

/** Returns the colour of each copy: those of the motion in turn, or else a different shade of `color`; white with a look. */
function shadesOf(body, color, motion) {
    const { copies } = body;
    const shades = new Float32Array(3 * copies).fill(1);
    if (body.look) return shades;
    const shade = new Color();
    const { colors, first_copy: start } = motion;
    for (let copy = 0; colors.length > 0 && copy < copies; ++copy) shades.set(colors[(start + copy) % colors.length], 3 * copy);
    if (colors.length > 0) return shades;
    for (let copy = 0; copy < copies; ++copy) {
        const part = copies > 1 ? ((copy * 0.618034) % 1) - 0.5 : 0;
        shade.copy(color).offsetHSL(0.03 * part, 0, 0.14 * part).toArray(shades, 3 * copy);
    }
    return shades;
}

export class Crowd {
    /** `loaded` is called whenever an image of the body's look has arrived. */
    constructor(body, color, motion, scene, loaded) {
        this.body = body;
        this.shades = shadesOf(body, new Color(color), motion);
        this.painted = null;
        const plain = new MeshStandardMaterial({ roughness: 0.5, metalness: 0 });
        const { materials, coarse } = body.look ? materialsOf(body, loaded) : { materials: plain, coarse: plain };
        const meshOf = (surface) => {
            const mesh = new InstancedMesh(geometryOf(surface), surface.look ? materials : coarse, body.copies);
            mesh.instanceMatrix.setUsage(DynamicDrawUsage);
            mesh.setColorAt(0, new Color());
            mesh.instanceColor.setUsage(DynamicDrawUsage);
            mesh.frustumCulled = false;
            mesh.castShadow = true;
            mesh.receiveShadow = true;
            mesh.userData.copies = new Uint32Array(body.copies);  // the copy of each instance
            scene.add(mesh);
            return mesh;
        };
        const levels = body.copies > 1 ? LEVELS : LEVELS.slice(0, 1);
        this.meshes = levels.map((_, level) => meshOf(surfaceAt(body, level)));
        this.slots = new Uint32Array(2 * body.copies);  // level and instance of each copy
        this.enlarged = false;
    }

    /** Draws one copy in another colour; without arguments none. */
    paint(copy, color) {
        this.painted = color ? { copy, color: new Color(color) } : null;
    }

    /**
     * Places all copies at a fraction between two frames: positions are interpolated linearly, orientations
     * spherically. `eye`: place of the camera; `focal`: pixels per metre at a distance of one metre.
     */
    place(frame, next, fraction, eye, focal) {
        const { body } = this;
        const { poses, radius, sizes } = body;
        const counts = this.meshes.map(() => 0);
        const coarsest = this.meshes.length - 1;
        const turn = [0, 0, 0, 1];
        this.enlarged = false;
        for (let copy = 0; copy < body.copies; ++copy) {
            const a = poseAt(body, frame, copy);
            const b = poseAt(body, next, copy);
            const x = poses[a] + fraction * (poses[b] - poses[a]);
            const y = poses[a + 1] + fraction * (poses[b + 1] - poses[a + 1]);
            const z = poses[a + 2] + fraction * (poses[b + 2] - poses[a + 2]);
            Quaternion.slerpFlat(turn, 0, poses, a + 3, poses, b + 3, fraction);
            const pixels = (sizes[copy] * radius * focal) / Math.hypot(x - eye.x, y - eye.y, z - eye.z);
            let level = 0;
            while (level < coarsest && pixels < LEVELS[level].from) ++level;
            const mesh = this.meshes[level];
            const instance = counts[level]++;
            const scale = Math.max(1, LEAST_RADIUS / pixels);
            if (scale > 1.2) this.enlarged = true;
            writeMatrix(mesh.instanceMatrix.array, 16 * instance, x, y, z, turn, sizes[copy] * scale);
            const colors = mesh.instanceColor.array;
            for (let k = 0; k < 3; ++k) colors[3 * instance + k] = this.shades[3 * copy + k];
            if (this.painted?.copy === copy) this.painted.color.toArray(colors, 3 * instance);
            mesh.userData.copies[instance] = copy;
            this.slots[2 * copy] = level;
            this.slots[2 * copy + 1] = instance;
        }
        this.meshes.forEach((mesh, level) => {
            mesh.count = counts[level];
            mesh.visible = mesh.count > 0;
            mesh.instanceMatrix.needsUpdate = true;
            mesh.instanceColor.needsUpdate = true;
            mesh.boundingSphere = null;
        });
    }

    /** Returns the drawn pose, read from the mesh. */
    drawnPose(copy) {
        const matrix = new Matrix4();
        this.meshes[this.slots[2 * copy]].getMatrixAt(this.slots[2 * copy + 1], matrix);
        const position = new Vector3();
        const turn = new Quaternion();
        matrix.decompose(position, turn, new Vector3());
        return { position: position.toArray(), orientation: [turn.w, turn.x, turn.y, turn.z] };
    }
}

/** Writes a place, a rotation (quaternion x y z w) and a scale as a matrix by columns. */
function writeMatrix(to, at, x, y, z, [i, j, k, w], scale) {
    to[at] = (1 - 2 * (j * j + k * k)) * scale;
    to[at + 1] = 2 * (i * j + k * w) * scale;
    to[at + 2] = 2 * (i * k - j * w) * scale;
    to[at + 3] = 0;
    to[at + 4] = 2 * (i * j - k * w) * scale;
    to[at + 5] = (1 - 2 * (i * i + k * k)) * scale;
    to[at + 6] = 2 * (j * k + i * w) * scale;
    to[at + 7] = 0;
    to[at + 8] = 2 * (i * k + j * w) * scale;
    to[at + 9] = 2 * (j * k - i * w) * scale;
    to[at + 10] = (1 - 2 * (i * i + j * j)) * scale;
    to[at + 11] = 0;
    to[at + 12] = x;
    to[at + 13] = y;
    to[at + 14] = z;
    to[at + 15] = 1;
}

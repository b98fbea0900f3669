// The bodies in space: z up, metres, one instanced mesh for each body.

import {
    BufferAttribute, BufferGeometry, Color, DirectionalLight, DoubleSide, GridHelper, HemisphereLight, InstancedMesh, Line,
    LineBasicMaterial, Matrix4, Mesh, MeshBasicMaterial, MeshStandardMaterial, PerspectiveCamera, PlaneGeometry,
    Quaternion, Raycaster, Scene, Vector2, Vector3, WebGLRenderer,
} from 'three';
import { OrbitControls } from 'three/addons/controls/OrbitControls.js';
import { PLACE_FLOATS, placeOf, poseAt } from './motion.js';
import { roundStep } from './series.js';

const COLORS = ['#4c8fbd', '#e08e45', '#5fa777', '#b779a8', '#c9b458', '#7d8ca3'];
const OBSTACLE = '#b9b2a4';
const CHOSEN = '#d1495b';
const TRAIL_FRAMES = 20000;
const MOST_GHOSTS = 80;

function geometryOf({ points, normals, triangles }) {
    const geometry = new BufferGeometry();
    geometry.setAttribute('position', new BufferAttribute(points, 3));
    geometry.setAttribute('normal', new BufferAttribute(normals, 3));
    geometry.setIndex(new BufferAttribute(triangles, 1));
    return geometry;
}

export class Stage {
    constructor(canvas, motion) {
        this.motion = motion;
        this.renderer = new WebGLRenderer({ canvas, antialias: true, preserveDrawingBuffer: true });
        this.renderer.setPixelRatio(window.devicePixelRatio || 1);
        this.scene = new Scene();
        this.scene.background = new Color('#f4f6f8');
        this.scene.add(new HemisphereLight('#ffffff', '#ccd3da', 2.4));
        this.measureSpace();
        const sun = new DirectionalLight('#ffffff', 1.9);
        sun.position.set(-0.4, -0.6, 1).multiplyScalar(10 * this.size);
        this.scene.add(sun);

        this.camera = new PerspectiveCamera(35, 1, 1e-3 * this.size, 100 * this.size);
        this.camera.up.set(0, 0, 1);
        this.controls = new OrbitControls(this.camera, canvas);
        this.showAll();

        this.meshes = motion.bodies.map((body, index) => this.bodyMesh(body, COLORS[index % COLORS.length]));
        this.obstacles = motion.obstacles.map((obstacle) => this.obstacleMesh(obstacle));
        this.addGround();
        this.trail = new Line(new BufferGeometry(), new LineBasicMaterial({ color: CHOSEN }));
        this.trail.frustumCulled = false;
        this.scene.add(this.trail);
        this.chosen = { body: 0, copy: 0 };
        this.place = new Vector3();
        this.followed = null;
        this.time = motion.times[0];
    }

    /** The box that all frames' centres of mass and the bodies around them take. */
    measureSpace() {
        const low = new Vector3(Infinity, Infinity, Infinity);
        const high = new Vector3(-Infinity, -Infinity, -Infinity);
        const point = new Vector3();
        for (const body of this.motion.bodies) {
            const inner = [new Vector3(Infinity, Infinity, Infinity), new Vector3(-Infinity, -Infinity, -Infinity)];
            for (let i = 0; i < body.poses.length; i += poseAt(body, 0, 1)) {
                point.fromArray(body.poses, i);
                inner[0].min(point);
                inner[1].max(point);
            }
            low.min(inner[0].subScalar(body.radius));
            high.max(inner[1].addScalar(body.radius));
        }
        if (this.motion.ground !== null) low.z = Math.min(low.z, this.motion.ground);
        this.low = low;
        this.high = high;
        this.size = Math.max(low.distanceTo(high), 1e-6);
    }

    /** Looks at everything from the front, a little from the right and above, as near as all of it is in view. */
    showAll() {
        const canvas = this.renderer.domElement;
        this.camera.aspect = canvas.clientWidth / Math.max(1, canvas.clientHeight);
        this.camera.updateProjectionMatrix();
        const { low, high } = this;
        const middle = new Vector3().addVectors(low, high).multiplyScalar(0.5);
        const direction = new Vector3(0.45, -1, 0.24).normalize();
        const corners = [0, 1, 2, 3, 4, 5, 6, 7].map((i) =>
            new Vector3((i & 1 ? high : low).x, (i & 2 ? high : low).y, (i & 4 ? high : low).z));
        const isOut = (corner) => {
            const seen = corner.clone().project(this.camera);
            return Math.abs(seen.x) > 0.9 || Math.abs(seen.y) > 0.9;
        };
        this.controls.target.copy(middle);
        for (let distance = 0.6 * this.size; distance < 50 * this.size; distance *= 1.04) {
            this.camera.position.copy(middle).addScaledVector(direction, distance);
            this.camera.lookAt(middle);
            this.camera.updateMatrixWorld();
            if (!corners.some(isOut)) break;
        }
        this.controls.update();
    }

    obstacleMesh(obstacle) {
        const material = new MeshStandardMaterial({ color: OBSTACLE, roughness: 0.9, metalness: 0, side: DoubleSide });
        const mesh = new Mesh(geometryOf(obstacle), material);
        this.scene.add(mesh);
        return mesh;
    }

    bodyMesh(body, color) {
        const geometry = geometryOf(body);
        const material = new MeshStandardMaterial({ roughness: 0.55, metalness: 0 });
        const mesh = new InstancedMesh(geometry, material, body.copies);
        mesh.frustumCulled = false;
        mesh.userData.color = new Color(color);
        for (let copy = 0; copy < body.copies; ++copy) mesh.setColorAt(copy, mesh.userData.color);
        this.scene.add(mesh);
        return mesh;
    }

    addGround() {
        const { low, high } = this;
        const z = this.motion.ground ?? low.z;
        const middle = new Vector3((low.x + high.x) / 2, (low.y + high.y) / 2, z);
        const extent = 1.25 * Math.max(high.x - low.x, high.y - low.y, 0.4 * (high.z - low.z));
        this.gridStep = roundStep(extent, 12);
        const parts = 2 * Math.ceil(extent / this.gridStep / 2);
        const grid = new GridHelper(parts * this.gridStep, parts, '#aeb7c1', '#cfd6dd');
        grid.rotation.x = Math.PI / 2;
        grid.position.set(
            Math.round(middle.x / this.gridStep) * this.gridStep,
            Math.round(middle.y / this.gridStep) * this.gridStep, z);
        this.scene.add(grid);
        if (this.motion.ground === null) return;
        const plane = new Mesh(
            new PlaneGeometry(parts * this.gridStep, parts * this.gridStep),
            new MeshBasicMaterial({ color: '#e6e2d8', polygonOffset: true, polygonOffsetFactor: 2, polygonOffsetUnits: 2 }));
        plane.position.copy(grid.position);
        this.scene.add(plane);
    }

    choose(body, copy) {
        const paint = (color) => {
            const mesh = this.meshes[this.chosen.body];
            mesh.setColorAt(this.chosen.copy, color ?? mesh.userData.color);
            mesh.instanceColor.needsUpdate = true;
        };
        paint();
        this.chosen = { body, copy };
        const bodies = this.motion.bodies;
        if (bodies.length > 1 || bodies[0].copies > 1) paint(new Color(CHOSEN));
        this.layTrail();
        this.layGhosts();
        this.followed = null;
    }

    /** Pale images of the chosen body along its path, a body's length apart. */
    layGhosts() {
        const body = this.motion.bodies[this.chosen.body];
        if (this.ghosts) {
            this.scene.remove(this.ghosts);
            this.ghosts.dispose();
        }
        let length = 0;
        const at = (frame) => new Vector3().fromArray(body.poses, poseAt(body, frame, this.chosen.copy));
        const ways = [0];
        for (let frame = 1; frame < this.motion.times.length; ++frame) {
            length += at(frame).distanceTo(at(frame - 1));
            ways.push(length);
        }
        const apart = Math.max(1.3 * body.radius, length / MOST_GHOSTS);
        this.ghostFrames = [];
        ways.forEach((way, frame) => {
            if (way >= this.ghostFrames.length * apart) this.ghostFrames.push(frame);
        });
        const material = new MeshStandardMaterial({
            color: CHOSEN, roughness: 0.8, transparent: true, opacity: 0.28, depthWrite: false,
        });
        this.ghosts = new InstancedMesh(this.meshes[this.chosen.body].geometry, material, this.ghostFrames.length);
        this.ghosts.frustumCulled = false;
        const matrix = new Matrix4();
        const one = new Vector3(1, 1, 1);
        this.ghostFrames.forEach((frame, i) => {
            const turn = new Quaternion().fromArray(body.poses, poseAt(body, frame, this.chosen.copy) + 3);
            this.ghosts.setMatrixAt(i, matrix.compose(at(frame), turn, one));
        });
        this.scene.add(this.ghosts);
    }

    /** Shows or hides the path and the images along it. */
    showTrail(on) {
        this.trail.visible = on;
        this.ghosts.visible = on;
    }

    /** The chosen body's whole path; what is drawn of it ends at the time shown. */
    layTrail() {
        const body = this.motion.bodies[this.chosen.body];
        const frames = this.motion.times.length;
        this.trailStride = Math.ceil(frames / TRAIL_FRAMES);
        const points = [];
        for (let frame = 0; frame < frames; frame += this.trailStride) {
            const at = poseAt(body, frame, this.chosen.copy);
            points.push(body.poses[at], body.poses[at + 1], body.poses[at + 2]);
        }
        points.push(0, 0, 0);  // the place at the time shown
        this.trail.geometry.dispose();
        this.trail.geometry = new BufferGeometry();
        this.trail.geometry.setAttribute('position', new BufferAttribute(new Float32Array(points), 3));
    }

    /** Places all bodies as they are at `time`: linear in position, along the arc in orientation. */
    show(time, follow) {
        this.time = time;
        const { frame, next, fraction } = placeOf(this.motion, time);
        const position = new Vector3();
        const after = new Vector3();
        const turn = new Quaternion();
        const turnAfter = new Quaternion();
        const matrix = new Matrix4();
        const one = new Vector3(1, 1, 1);
        this.motion.bodies.forEach((body, index) => {
            const mesh = this.meshes[index];
            for (let copy = 0; copy < body.copies; ++copy) {
                const a = poseAt(body, frame, copy);
                const b = poseAt(body, next, copy);
                position.fromArray(body.poses, a).lerp(after.fromArray(body.poses, b), fraction);
                turn.fromArray(body.poses, a + 3).slerp(turnAfter.fromArray(body.poses, b + 3), fraction);
                mesh.setMatrixAt(copy, matrix.compose(position, turn, one));
                if (index === this.chosen.body && copy === this.chosen.copy) this.place.copy(position);
            }
            mesh.instanceMatrix.needsUpdate = true;
            mesh.boundingSphere = null;
        });
        this.motion.obstacles.forEach(({ places }, index) => {
            const mesh = this.obstacles[index];
            const moves = places.length > PLACE_FLOATS;
            const a = moves ? frame * PLACE_FLOATS : 0;
            const b = moves ? next * PLACE_FLOATS : 0;
            mesh.position.fromArray(places, a).lerp(after.fromArray(places, b), fraction);
            mesh.quaternion.fromArray(places, a + 3).slerp(turnAfter.fromArray(places, b + 3), fraction);
        });
        this.endTrail(frame);
        this.followPlace(follow);
    }

    endTrail(frame) {
        const points = this.trail.geometry.getAttribute('position');
        const last = Math.floor(frame / this.trailStride) + 1;
        const body = this.motion.bodies[this.chosen.body];
        // The point after the last whole one is the place shown; the one that was there before is put back.
        if (this.trailEnd !== undefined && this.trailEnd < points.count - 1) {
            const at = poseAt(body, this.trailEnd * this.trailStride, this.chosen.copy);
            points.setXYZ(this.trailEnd, body.poses[at], body.poses[at + 1], body.poses[at + 2]);
        }
        this.trailEnd = last;
        points.setXYZ(last, this.place.x, this.place.y, this.place.z);
        points.needsUpdate = true;
        this.trail.geometry.setDrawRange(0, last + 1);
        this.ghosts.count = this.ghostFrames.filter((ghost) => ghost <= frame).length;
    }

    /** Shifts camera and target with the chosen body. */
    followPlace(follow) {
        if (!follow) {
            this.followed = null;
            return;
        }
        if (this.followed === null) {
            const radius = this.motion.bodies[this.chosen.body].radius;
            const offset = this.camera.position.clone().sub(this.controls.target);
            offset.setLength(Math.min(offset.length(), 12 * radius));
            this.controls.target.copy(this.place);
            this.camera.position.copy(this.place).add(offset);
        } else {
            const way = this.place.clone().sub(this.followed);
            this.controls.target.add(way);
            this.camera.position.add(way);
        }
        this.followed = this.place.clone();
    }

    /** The body and copy at a point of the canvas (CSS pixels), or null. */
    pick(x, y) {
        const canvas = this.renderer.domElement;
        const pointer = new Vector2((2 * x) / canvas.clientWidth - 1, 1 - (2 * y) / canvas.clientHeight);
        const ray = new Raycaster();
        ray.setFromCamera(pointer, this.camera);
        const hit = ray.intersectObjects(this.meshes)[0];
        return hit ? { body: this.meshes.indexOf(hit.object), copy: hit.instanceId } : null;
    }

    draw() {
        const canvas = this.renderer.domElement;
        const width = canvas.clientWidth;
        const height = canvas.clientHeight;
        const size = this.renderer.getSize(new Vector2());
        if (size.x !== width || size.y !== height) {
            this.renderer.setSize(width, height, false);
            this.camera.aspect = width / height;
            this.camera.updateProjectionMatrix();
        }
        this.renderer.render(this.scene, this.camera);
    }

    /** The pose that is drawn: read from the mesh itself. */
    drawnPose(body, copy) {
        const matrix = new Matrix4();
        this.meshes[body].getMatrixAt(copy, matrix);
        const position = new Vector3();
        const turn = new Quaternion();
        matrix.decompose(position, turn, new Vector3());
        return { position: position.toArray(), orientation: [turn.w, turn.x, turn.y, turn.z] };
    }
}

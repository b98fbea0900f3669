// The three-dimensional view of the bodies: z up, in metres.

import {
    DoubleSide, InstancedMesh, Matrix4, Mesh, MeshStandardMaterial, PerspectiveCamera, Quaternion, Raycaster,
    Scene, Vector2, Vector3, WebGLRenderer,
} from 'three';
import { OrbitControls } from 'three/addons/controls/OrbitControls.js';
import { Line2 } from 'three/addons/lines/Line2.js';
import { LineGeometry } from 'three/addons/lines/LineGeometry.js';
import { LineMaterial } from 'three/addons/lines/LineMaterial.js';
import { Crowd, geometryOf, surfaceAt } from './crowd.js';
import { ForceArrows } from './forces.js';
import { Ground, Light } from './light.js';
import { PLACE_FLOATS, placeOf, poseAt } from './motion.js';
import { BODIES, CHOSEN, OBSTACLE, onPalette, paletteColor } from './palette.js';
import { roundStep } from './series.js';

const TRAIL_FRAMES = 20000;
const MOST_GHOSTS = 80;
const LANDMARKS = 1000;  // for one body
const MOST_PIXEL_RATIO = 2;
const MARKED_BELOW = 9;  // pixels of radius: the chosen body gets a ring
const FOLLOWED_BELOW = 8;  // pixels of radius: a single body is followed from the start

export class Stage {
    constructor(canvas, motion) {
        this.motion = motion;
        this.renderer = new WebGLRenderer({ canvas, antialias: true, alpha: true, preserveDrawingBuffer: true });
        this.renderer.info.autoReset = false;
        this.scene = new Scene();
        this.measureSpace();
        this.light = new Light(this.renderer, this.scene, this.size);

        this.camera = new PerspectiveCamera(35, 1, 1e-3 * this.size, 100 * this.size);
        this.camera.up.set(0, 0, 1);
        this.controls = new OrbitControls(this.camera, canvas);
        this.controls.enableDamping = !window.matchMedia('(prefers-reduced-motion: reduce)').matches;
        this.controls.zoomToCursor = true;
        this.controls.minDistance = 2e-3 * this.size;
        this.controls.maxDistance = 20 * this.size;
        this.controls.addEventListener('change', () => { this.stale = true; });
        this.controls.addEventListener('start', () => { this.handled = true; });

        this.crowds = motion.bodies.map((body, index) =>
            new Crowd(body, BODIES[index % BODIES.length], motion, this.scene, () => { this.stale = true; }));
        this.obstacles = motion.obstacles.map((obstacle) => this.obstacleMesh(obstacle));
        this.addGround();
        this.trail = new Line2(new LineGeometry(), new LineMaterial({ color: CHOSEN, linewidth: 2 }));
        this.trail.frustumCulled = false;
        this.scene.add(this.trail);
        this.forces = new ForceArrows(this.scene, document.getElementById('forces-legend'));
        this.marker = document.getElementById('marker');
        this.chosen = { body: 0, copy: 0 };
        this.place = new Vector3();
        this.followed = null;
        this.time = motion.times[0];
        this.repaint();
        onPalette(() => this.repaint());
        this.fit();
        this.showAll();
    }

    repaint() {
        this.ground.paint(paletteColor(this.motion.ground === null ? 'grid-floor' : 'ground'), paletteColor('grid'));
        this.stale = true;
    }

    /** Computes the bounding box of the bodies in all frames. */
    measureSpace() {
        this.landmarks = [];  // points that the first view contains
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
            const radius = body.radius * body.sizes.reduce((a, b) => Math.max(a, b));
            const apart = Math.ceil(body.poses.length / poseAt(body, 0, 1) / LANDMARKS);
            for (let i = 0; i < body.poses.length; i += apart * poseAt(body, 0, 1)) {
                for (const side of [-1, 1]) {
                    const landmark = new Vector3().fromArray(body.poses, i);
                    this.landmarks.push(landmark.addScalar(side * radius));
                }
            }
            low.min(inner[0].subScalar(radius));
            high.max(inner[1].addScalar(radius));
        }
        this.addObstacles(low, high);
        if (this.motion.ground !== null) low.z = Math.min(low.z, this.motion.ground);
        this.low = low;
        this.high = high;
        this.size = Math.max(low.distanceTo(high), 1e-6);
    }

    /** Extends the box by the parts of the obstacles beside or under the bodies. */
    addObstacles(low, high) {
        const room = high.clone().sub(low).multiplyScalar(0.6);
        const least = low.clone().sub(room);
        const most = high.clone().add(room);
        const point = new Vector3();
        const turn = new Quaternion();
        for (const { points, places } of this.motion.obstacles) {
            turn.fromArray(places, 3);
            for (let i = 0; i < points.length; i += 3) {
                point.fromArray(points, i).applyQuaternion(turn);
                point.x += places[0];
                point.y += places[1];
                point.z += places[2];
                point.clamp(least, most);
                this.landmarks.push(point.clone());
                low.min(point);
                high.max(point);
            }
        }
    }

    /** Moves the camera to the front, a little to the right and above, as near as everything is in view. */
    showAll() {
        const { low, high } = this;
        const middle = new Vector3().addVectors(low, high).multiplyScalar(0.5);
        const direction = new Vector3(0.45, -1, 0.24).normalize();
        this.controls.target.copy(middle);
        for (let distance = 0.3 * this.size; distance < 50 * this.size; distance *= 1.04) {
            this.camera.position.copy(this.controls.target).addScaledVector(direction, distance);
            this.camera.lookAt(this.controls.target);
            this.camera.updateMatrixWorld();
            const { low: left, high: right } = this.viewOf(this.landmarks);
            if (right.x - left.x < 1.8 && right.y - left.y < 1.7 && right.z < 1) {
                const aside = left.add(right).multiplyScalar(0.5 * distance / this.camera.projectionMatrix.elements[5]);
                const across = new Vector3().setFromMatrixColumn(this.camera.matrixWorld, 0);
                const up = new Vector3().setFromMatrixColumn(this.camera.matrixWorld, 1);
                const way = across.multiplyScalar(aside.x * this.camera.aspect).addScaledVector(up, aside.y);
                this.controls.target.add(way);
                this.camera.position.add(way);
                break;
            }
        }
        this.controls.update();
        this.handled = false;
        this.stale = true;
    }

    /** Returns the bounding box of points on the screen, from -1 to 1. */
    viewOf(points) {
        const low = new Vector3(Infinity, Infinity, Infinity);
        const high = new Vector3(-Infinity, -Infinity, -Infinity);
        const seen = new Vector3();
        for (const point of points) {
            seen.copy(point).project(this.camera);
            low.min(seen);
            high.max(seen);
        }
        return { low, high };
    }

    /** Returns the pixels per metre at one metre from the camera. */
    get focal() {
        return this.renderer.domElement.clientHeight / (2 * Math.tan((this.camera.fov * Math.PI) / 360));
    }

    /** Returns the chosen body's radius in pixels. */
    get chosenPixels() {
        const { radius, sizes } = this.motion.bodies[this.chosen.body];
        return (radius * sizes[this.chosen.copy] * this.focal) / this.camera.position.distanceTo(this.place);
    }

    /** Whether there is a single body that is too small to be seen with its whole path in view. */
    get isLost() {
        const [body] = this.motion.bodies;
        this.place.fromArray(body.poses, 0);
        return this.motion.bodies.length === 1 && body.copies === 1 && this.chosenPixels < FOLLOWED_BELOW;
    }

    obstacleMesh(obstacle) {
        const material = new MeshStandardMaterial({ color: OBSTACLE, roughness: 0.9, metalness: 0, side: DoubleSide });
        const mesh = new Mesh(geometryOf(obstacle), material);
        mesh.castShadow = true;
        mesh.receiveShadow = true;
        this.scene.add(mesh);
        return mesh;
    }

    addGround() {
        const { low, high } = this;
        const z = this.motion.ground ?? low.z;
        const middle = new Vector3((low.x + high.x) / 2, (low.y + high.y) / 2, z);
        const extent = 1.25 * Math.max(high.x - low.x, high.y - low.y, 0.4 * (high.z - low.z));
        this.gridStep = roundStep(extent, 12);
        this.ground = new Ground(this.scene, middle, 4 * this.size, this.gridStep);
    }

    choose(body, copy) {
        this.crowds[this.chosen.body].paint();
        this.chosen = { body, copy };
        const bodies = this.motion.bodies;
        if (bodies.length > 1 || bodies[0].copies > 1) this.crowds[body].paint(copy, CHOSEN);
        this.layTrail();
        this.layGhosts();
        this.forces.choose(bodies[body], copy);
        this.followed = null;
    }

    /** Adds pale images of the chosen body along its path, a body's length apart. */
    layGhosts() {
        const body = this.motion.bodies[this.chosen.body];
        if (this.ghosts) {
            this.scene.remove(this.ghosts);
            this.ghosts.geometry.dispose();
            this.ghosts.dispose();
        }
        let length = 0;
        const at = (frame) => new Vector3().fromArray(body.poses, poseAt(body, frame, this.chosen.copy));
        const ways = [0];
        for (let frame = 1; frame < this.motion.times.length; ++frame) {
            length += at(frame).distanceTo(at(frame - 1));
            ways.push(length);
        }
        const size = body.sizes[this.chosen.copy];
        const apart = Math.max(1.3 * size * body.radius, length / MOST_GHOSTS);
        this.ghostFrames = [];
        ways.forEach((way, frame) => {
            if (way >= this.ghostFrames.length * apart) this.ghostFrames.push(frame);
        });
        const material = new MeshStandardMaterial({
            color: CHOSEN, roughness: 0.8, transparent: true, opacity: 0.28, depthWrite: false,
        });
        this.ghosts = new InstancedMesh(geometryOf(surfaceAt(body, 1)), material, this.ghostFrames.length);
        this.ghosts.frustumCulled = false;
        const matrix = new Matrix4();
        const scale = new Vector3(size, size, size);
        this.ghostFrames.forEach((frame, i) => {
            const turn = new Quaternion().fromArray(body.poses, poseAt(body, frame, this.chosen.copy) + 3);
            this.ghosts.setMatrixAt(i, matrix.compose(at(frame), turn, scale));
        });
        this.scene.add(this.ghosts);
    }

    /** Shows or hides the path and the images along it. */
    showTrail(on) {
        this.trail.visible = on;
        this.ghosts.visible = on;
    }

    /** Shows or hides the forces on the chosen body. */
    showForces(on) {
        this.forces.shown = on;
    }

    /** Adds the chosen body's path; it is drawn up to the shown time. */
    layTrail() {
        const body = this.motion.bodies[this.chosen.body];
        const frames = this.motion.times.length;
        this.trailStride = Math.ceil(frames / TRAIL_FRAMES);
        const points = [];
        for (let frame = 0; frame < frames; frame += this.trailStride) {
            const at = poseAt(body, frame, this.chosen.copy);
            points.push(body.poses[at], body.poses[at + 1], body.poses[at + 2]);
        }
        points.push(0, 0, 0);  // the place at the shown time
        this.trail.geometry.dispose();
        this.trail.geometry = new LineGeometry().setPositions(points);
        this.trailPoints = points;
        this.trailEnd = undefined;
    }

    /** Places all bodies and obstacles at `time`, and updates path, ring and camera. */
    show(time, follow) {
        this.time = time;
        const { frame, next, fraction } = placeOf(this.motion, time);
        const after = new Vector3();
        const body = this.motion.bodies[this.chosen.body];
        this.place.fromArray(body.poses, poseAt(body, frame, this.chosen.copy))
            .lerp(after.fromArray(body.poses, poseAt(body, next, this.chosen.copy)), fraction);
        this.followPlace(follow);
        this.forces.place(this.place, frame, next, fraction);
        for (const crowd of this.crowds) crowd.place(frame, next, fraction, this.camera.position, this.focal);
        const turnAfter = new Quaternion();
        this.motion.obstacles.forEach(({ places }, index) => {
            const mesh = this.obstacles[index];
            const moves = places.length > PLACE_FLOATS;
            const a = moves ? frame * PLACE_FLOATS : 0;
            const b = moves ? next * PLACE_FLOATS : 0;
            mesh.position.fromArray(places, a).lerp(after.fromArray(places, b), fraction);
            mesh.quaternion.fromArray(places, a + 3).slerp(turnAfter.fromArray(places, b + 3), fraction);
        });
        this.endTrail(frame);
        this.stale = true;
    }

    /** Ends the path at the shown place: segment i connects the points i and i + 1. */
    endTrail(frame) {
        const { data } = this.trail.geometry.getAttribute('instanceStart');
        const last = Math.floor(frame / this.trailStride);
        if (this.trailEnd !== undefined) {
            const whole = 3 * (this.trailEnd + 1);
            data.array.set(this.trailPoints.slice(whole, whole + 3), 6 * this.trailEnd + 3);
        }
        this.trailEnd = last;
        this.place.toArray(data.array, 6 * last + 3);
        data.needsUpdate = true;
        this.trail.geometry.instanceCount = last + 1;
        this.ghosts.count = this.ghostFrames.filter((ghost) => ghost <= frame).length;
    }

    /** Moves camera and target with the chosen body. */
    followPlace(follow) {
        if (!follow) {
            this.followed = null;
            return;
        }
        if (this.followed === null) {
            const body = this.motion.bodies[this.chosen.body];
            const radius = body.radius * body.sizes[this.chosen.copy];
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

    /** Returns the body and copy at a point of the canvas (CSS pixels), or null. */
    pick(x, y) {
        const canvas = this.renderer.domElement;
        const pointer = new Vector2((2 * x) / canvas.clientWidth - 1, 1 - (2 * y) / canvas.clientHeight);
        const ray = new Raycaster();
        ray.setFromCamera(pointer, this.camera);
        const hit = ray.intersectObjects(this.crowds.flatMap((crowd) => crowd.meshes.filter((mesh) => mesh.visible)))[0];
        if (!hit) return null;
        const body = this.crowds.findIndex((crowd) => crowd.meshes.includes(hit.object));
        return { body, copy: hit.object.userData.copies[hit.instanceId] };
    }

    /** Whether some bodies are drawn larger than they are. */
    get enlarged() {
        return this.crowds.some((crowd) => crowd.enlarged);
    }

    /** Applies the canvas's size and the screen's density; returns whether either has changed. */
    fit() {
        const { clientWidth, clientHeight } = this.renderer.domElement;
        const ratio = Math.min(MOST_PIXEL_RATIO, window.devicePixelRatio || 1);
        const size = this.renderer.getSize(new Vector2());
        if (size.x === clientWidth && size.y === clientHeight && this.renderer.getPixelRatio() === ratio) return false;
        this.renderer.setPixelRatio(ratio);
        this.renderer.setSize(clientWidth, clientHeight, false);
        this.camera.aspect = clientWidth / Math.max(1, clientHeight);
        this.camera.updateProjectionMatrix();
        this.stale = true;
        return true;
    }

    /** Draws a ring around the chosen body where it is small. */
    mark() {
        const seen = this.place.clone().project(this.camera);
        this.marker.hidden = this.chosenPixels > MARKED_BELOW || Math.abs(seen.z) > 1;
        const { clientWidth, clientHeight } = this.renderer.domElement;
        const x = ((1 + seen.x) / 2) * clientWidth;
        const y = ((1 - seen.y) / 2) * clientHeight;
        this.marker.style.transform = `translate(${x}px, ${y}px)`;
    }

    draw() {
        this.light.aim(this.controls.target, this.camera.position.distanceTo(this.controls.target));
        this.mark();
        this.renderer.info.reset();
        this.renderer.render(this.scene, this.camera);
        this.stale = false;
    }

    drawnPose(body, copy) {
        return this.crowds[body].drawnPose(copy);
    }
}

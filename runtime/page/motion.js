// Reads the motion in the page: a JSON object in #motion-header, and the arrays of each body and obstacle in base64.

/** Number of floats of a pose: position (3), quaternion x y z w, descent speed, inclination, angular speed. */
const FLOATS = 10;

/** Number of floats of an obstacle's place: position (3), quaternion x y z w; one place where it stands still. */
export const PLACE_FLOATS = 7;

/** The measures that follow the pose. `scale` turns SI units into those shown. */
export const MEASURES = [
    { name: 'descent speed', unit: 'm/s', scale: 1, place: 7 },
    { name: 'inclination', unit: '\u00b0', scale: 180 / Math.PI, place: 8 },
    { name: 'angular speed', unit: 'rad/s', scale: 1, place: 9 },
];

function bytesOf(id) {
    const element = document.getElementById(id);
    const text = atob(element.textContent.trim());
    element.remove();
    const bytes = new Uint8Array(text.length);
    for (let i = 0; i < text.length; ++i) bytes[i] = text.charCodeAt(i);
    return bytes.buffer;
}

export function readMotion() {
    const motion = JSON.parse(document.getElementById('motion-header').textContent);
    motion.times = new Float64Array(bytesOf('motion-times'));
    motion.bodies.forEach((body, index) => {
        body.points = new Float32Array(bytesOf(`motion-${index}-points`));
        body.normals = new Float32Array(bytesOf(`motion-${index}-normals`));
        body.triangles = new Uint32Array(bytesOf(`motion-${index}-triangles`));
        if (body.look) {
            body.texture = new Float32Array(bytesOf(`motion-${index}-texture`));
            body.look.images = body.look.images.map((type, image) =>
                new Blob([bytesOf(`motion-${index}-image-${image}`)], { type }));
        }
        body.poses = new Float32Array(bytesOf(`motion-${index}-poses`));
        if (motion.has_forces) body.forces = new Float32Array(bytesOf(`motion-${index}-forces`));
        body.sizes ??= new Array(body.copies).fill(1);
    });
    motion.obstacles.forEach((obstacle, index) => {
        obstacle.points = new Float32Array(bytesOf(`motion-obstacle-${index}-points`));
        obstacle.normals = new Float32Array(bytesOf(`motion-obstacle-${index}-normals`));
        obstacle.triangles = new Uint32Array(bytesOf(`motion-obstacle-${index}-triangles`));
        obstacle.places = new Float32Array(bytesOf(`motion-obstacle-${index}-places`));
    });
    return motion;
}

/** Returns the frame before a time, and the fraction of the interval to the next. */
export function placeOf(motion, time) {
    const times = motion.times;
    let low = 0;
    let high = times.length - 1;
    while (high - low > 1) {
        const middle = (low + high) >> 1;
        if (times[middle] <= time) low = middle;
        else high = middle;
    }
    if (high === low) return { frame: 0, next: 0, fraction: 0 };
    const fraction = (time - times[low]) / (times[high] - times[low]);
    return { frame: low, next: high, fraction: Math.min(1, Math.max(0, fraction)) };
}

/** Returns the index in body.poses at which the floats of a pose begin. */
export function poseAt(body, frame, copy) {
    return (frame * body.copies + copy) * FLOATS;
}

/** Returns a measure (in the shown unit) of one copy at every frame. */
export function seriesOf(motion, body, copy, measure) {
    return Float32Array.from(motion.times, (_, frame) =>
        body.poses[poseAt(body, frame, copy) + measure.place] * measure.scale);
}

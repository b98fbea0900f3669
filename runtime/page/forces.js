// The fluid's forces on the chosen body as arrows from its centre of mass.

import { ArrowHelper, Vector3 } from 'three';

/** The forces in the order of the page's data, with their colours. */
const FORCES = [
    { name: 'drag', color: '#d55e00' },
    { name: 'lift', color: '#0072b2' },
    { name: 'inertia', color: '#009e73' },
    { name: 'noise', color: '#cc79a7' },
];
const LONGEST = 4;  // of the body's radius

export class ForceArrows {
    constructor(scene, legend) {
        this.arrows = FORCES.map(({ color }) => {
            const arrow = new ArrowHelper(new Vector3(0, 0, 1), new Vector3(), 1, color);
            arrow.visible = false;
            arrow.renderOrder = 1;
            scene.add(arrow);
            return arrow;
        });
        for (const { name, color } of FORCES) {
            const label = document.createElement('span');
            label.textContent = name;
            label.style.color = color;
            legend.append(label, ' ');
        }
        this.shown = false;
    }

    /** Shows the forces on a copy of a body, the greatest of the whole motion as the longest arrow. */
    choose(body, copy) {
        this.body = body;
        this.copy = copy;
        this.radius = body.radius * body.sizes[copy];
        this.greatest = 0;
        if (!body.forces) return;
        const frames = body.forces.length / (3 * FORCES.length * body.copies);
        for (let frame = 0; frame < frames; ++frame) {
            for (let part = 0; part < FORCES.length; ++part) {
                this.greatest = Math.max(this.greatest, this.forceAt(frame, part).length());
            }
        }
    }

    /** Returns a force (N) at a frame. */
    forceAt(frame, part) {
        const at = ((frame * this.body.copies + this.copy) * FORCES.length + part) * 3;
        return new Vector3().fromArray(this.body.forces, at);
    }

    /** Places the arrows at the body's place, by the forces between two frames. */
    place(place, frame, next, fraction) {
        this.arrows.forEach((arrow, part) => {
            arrow.visible = false;
            if (!this.shown || this.greatest === 0) return;
            const force = this.forceAt(frame, part).lerp(this.forceAt(next, part), fraction);
            const length = (LONGEST * this.radius * force.length()) / this.greatest;
            if (length < 1e-3 * this.radius) return;
            arrow.visible = true;
            arrow.position.copy(place);
            arrow.setDirection(force.normalize());
            arrow.setLength(length, Math.min(0.25 * length, 0.4 * this.radius), Math.min(0.15 * length, 0.2 * this.radius));
        });
    }
}

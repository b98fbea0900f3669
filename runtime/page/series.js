// Time series under the stage: one plot for each measure, with a cursor at the time shown.

import { paletteColor } from './palette.js';

const MARGIN = { left: 56, right: 14, top: 26, bottom: 36 };

/** Returns a round step that divides `range` into at most `most` parts. */
export function roundStep(range, most) {
    const raw = range / most;
    const power = 10 ** Math.floor(Math.log10(raw));
    for (const factor of [1, 2, 5]) if (factor * power >= raw * 0.999) return factor * power;
    return 10 * power;
}

function decimals(step) {
    return Math.max(0, -Math.floor(Math.log10(step) + 1e-9));
}

export class SeriesPlot {
    constructor(parent, measure, times, onSeek) {
        this.measure = measure;
        this.times = times;
        this.values = null;
        this.time = times[0];
        this.canvas = document.createElement('canvas');
        this.canvas.setAttribute('role', 'img');
        this.canvas.setAttribute('aria-label', `${measure.name} over time`);
        parent.append(this.canvas);
        const seek = (event) => {
            const box = this.canvas.getBoundingClientRect();
            const width = box.width - MARGIN.left - MARGIN.right;
            const fraction = Math.min(1, Math.max(0, (event.clientX - box.left - MARGIN.left) / width));
            onSeek(times[0] + fraction * this.duration);
        };
        this.canvas.addEventListener('pointerdown', (event) => {
            this.canvas.setPointerCapture(event.pointerId);
            seek(event);
        });
        this.canvas.addEventListener('pointermove', (event) => {
            if (event.buttons & 1) seek(event);
        });
        new ResizeObserver(() => this.draw()).observe(this.canvas);
    }

    get duration() {
        return this.times[this.times.length - 1] - this.times[0] || 1;
    }

    show(values) {
        this.values = values;
        let low = Infinity;
        let high = -Infinity;
        for (const value of values) {
            low = Math.min(low, value);
            high = Math.max(high, value);
        }
        this.lowest = low;
        this.highest = high;
        this.draw();
    }

    /** Chooses round values for the axis, as many as fit into `height` pixels. */
    scale(height) {
        const { lowest, highest } = this;
        const least = Math.max(1e-3 * Math.max(Math.abs(lowest), Math.abs(highest)), 1e-6);
        this.step = roundStep(Math.max(highest - lowest, least), Math.min(4, Math.max(1, Math.floor(height / 24))));
        this.low = Math.floor(lowest / this.step + 1e-6) * this.step;
        this.high = Math.ceil(highest / this.step - 1e-6) * this.step;
        if (this.high <= this.low) this.high = this.low + this.step;
    }

    /** Moves the cursor; `value` is the measure there. */
    point(time, value) {
        this.time = time;
        this.value = value;
        this.draw();
    }

    draw() {
        if (!this.values) return;
        const ratio = window.devicePixelRatio || 1;
        const width = this.canvas.clientWidth;
        const height = this.canvas.clientHeight;
        if (width === 0 || height === 0) return;
        this.canvas.width = Math.round(width * ratio);
        this.canvas.height = Math.round(height * ratio);
        const pen = this.canvas.getContext('2d');
        pen.scale(ratio, ratio);
        pen.font = '12px system-ui, "DejaVu Sans", sans-serif';
        this.scale(height - MARGIN.top - MARGIN.bottom);
        const x = (time) =>
            MARGIN.left + ((time - this.times[0]) / this.duration) * (width - MARGIN.left - MARGIN.right);
        const y = (value) =>
            height - MARGIN.bottom -
            ((value - this.low) / (this.high - this.low)) * (height - MARGIN.top - MARGIN.bottom);
        this.drawAxes(pen, x, y, width, height);
        this.drawCurve(pen, x, y);
        this.drawCursor(pen, x, y, width, height);
    }

    drawAxes(pen, x, y, width, height) {
        pen.strokeStyle = paletteColor('line');
        pen.fillStyle = paletteColor('soft');
        pen.lineWidth = 1;
        pen.textBaseline = 'middle';
        pen.textAlign = 'right';
        pen.beginPath();
        for (let i = 0; this.low + i * this.step <= this.high + 1e-6 * this.step; ++i) {
            const value = this.low + i * this.step;
            pen.moveTo(MARGIN.left, y(value));
            pen.lineTo(width - MARGIN.right, y(value));
            pen.fillText(value.toFixed(decimals(this.step)), MARGIN.left - 7, y(value));
        }
        const step = roundStep(this.duration, Math.max(2, Math.floor(width / 90)));
        const first = Math.ceil(this.times[0] / step - 1e-6);
        pen.textBaseline = 'top';
        pen.textAlign = 'center';
        for (let i = first; i * step <= this.times[0] + this.duration * (1 + 1e-9); ++i) {
            pen.moveTo(x(i * step), height - MARGIN.bottom);
            pen.lineTo(x(i * step), height - MARGIN.bottom + 4);
            pen.fillText((i * step).toFixed(decimals(step)), x(i * step), height - MARGIN.bottom + 6);
        }
        pen.stroke();
        pen.fillText('time (s)', (MARGIN.left + width - MARGIN.right) / 2, height - MARGIN.bottom + 20);
    }

    drawCurve(pen, x, y) {
        pen.strokeStyle = paletteColor('curve');
        pen.lineWidth = 1.6;
        pen.lineJoin = 'round';
        pen.beginPath();
        this.values.forEach((value, frame) => pen.lineTo(x(this.times[frame]), y(value)));
        pen.stroke();
    }

    drawCursor(pen, x, y, width, height) {
        pen.strokeStyle = paletteColor('cursor');
        pen.lineWidth = 1;
        pen.beginPath();
        pen.moveTo(x(this.time), MARGIN.top - 4);
        pen.lineTo(x(this.time), height - MARGIN.bottom);
        pen.stroke();
        pen.fillStyle = paletteColor('cursor');
        pen.beginPath();
        pen.arc(x(this.time), y(this.value), 3.5, 0, 2 * Math.PI);
        pen.fill();
        pen.textBaseline = 'top';
        pen.textAlign = 'left';
        pen.fillStyle = paletteColor('ink');
        pen.fillText(`${this.measure.name} (${this.measure.unit})`, MARGIN.left, 3);
        pen.textAlign = 'right';
        pen.fillStyle = paletteColor('cursor');
        const digits = decimals(this.step) + 1;
        const space = this.measure.unit === '\u00b0' ? '' : ' ';
        pen.fillText(this.value.toFixed(digits) + space + this.measure.unit, width - MARGIN.right, 3);
    }
}

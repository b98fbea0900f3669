// Plays the motion in the page: clock, controls and keys.

import { MEASURES, placeOf, readMotion, seriesOf } from './motion.js';
import { onPalette } from './palette.js';
import { SeriesPlot } from './series.js';
import { Stage } from './stage.js';

const SPEEDS = [0.05, 0.1, 0.25, 0.5, 1, 2, 4];
const LONGEST_TICK = 250;  // milliseconds
const element = (id) => document.getElementById(id);

const motion = readMotion();
const begin = motion.times[0];
const end = motion.times[motion.times.length - 1];
const stage = new Stage(element('stage'), motion);
const plots = MEASURES.map((measure) => new SeriesPlot(element('series'), measure, motion.times, (time) => seek(time)));
const chosen = { body: 0, copy: 0 };
let series = [];
let time = begin;
let playing = false;
let before = null;
let stale = true;
let ticks = 0;

function speed() {
    return Number(element('speed').value);
}

function seek(to) {
    time = Math.min(end, Math.max(begin, to));
    stale = true;
}

function play(on) {
    playing = on && end > begin;
    if (playing && time >= end) time = begin;
    element('play').textContent = playing ? '\u275a\u275a' : '\u25b6\ufe0e';
    before = null;
}

function choose(body, copy) {
    chosen.body = body;
    chosen.copy = Math.min(Math.max(0, Math.trunc(copy) || 0), motion.bodies[body].copies - 1);
    const { copies } = motion.bodies[body];
    element('body').value = String(body);
    element('copy').value = String(motion.first_copy + chosen.copy);
    element('copy').min = String(motion.first_copy);
    element('copy').max = String(motion.first_copy + copies - 1);
    element('copy-choice').hidden = copies === 1;
    stage.choose(chosen.body, chosen.copy);
    series = MEASURES.map((measure) => seriesOf(motion, motion.bodies[body], chosen.copy, measure));
    stale = true;
    refresh();
    plots.forEach((plot, i) => plot.show(series[i]));
}

/** Updates everything to the shown time. */
function refresh() {
    stage.showForces(element('forces').checked);
    element('forces-legend').hidden = !element('forces').checked;
    stage.show(time, element('follow').checked);
    stage.showTrail(element('trail').checked);
    const { frame, next, fraction } = placeOf(motion, time);
    plots.forEach((plot, i) => plot.point(time, series[i][frame] * (1 - fraction) + series[i][next] * fraction));
    element('scrub').value = String(time);
    element('time').value = `${time.toFixed(3)} of ${end.toFixed(2)} s`;
    element('scale').textContent = scaleText();
    stale = false;
}

function scaleText() {
    const grid = `${motion.ground === null ? 'grid' : 'ground, grid'}: ${Number(stage.gridStep.toPrecision(2))} m`;
    return stage.enlarged ? `${grid}\nsmall bodies drawn larger` : grid;
}

function tick(now) {
    if (playing) {
        // After the page was hidden, or the machine was busy, playing continues instead of jumping ahead.
        if (before !== null) seek(time + (speed() * Math.min(now - before, LONGEST_TICK)) / 1000);
        before = now;
        if (time >= end) play(false);
    }
    if (stage.fit() && !stage.handled && !element('follow').checked) stage.showAll();
    stage.controls.update();
    if (stale) refresh();
    else if (stage.stale) stage.show(time, element('follow').checked);  // updates the levels of detail
    if (stage.stale) stage.draw();
    ++ticks;
    requestAnimationFrame(tick);
}

function stepFrames(count) {
    play(false);
    const { frame, fraction } = placeOf(motion, time);
    const at = Math.round(frame + fraction) + count;
    seek(motion.times[Math.min(motion.times.length - 1, Math.max(0, at))]);
}

function changeSpeed(by) {
    const choice = element('speed');
    choice.selectedIndex = Math.min(SPEEDS.length - 1, Math.max(0, choice.selectedIndex + by));
}

function toggle(id) {
    element(id).checked = !element(id).checked;
    stale = true;
}

function showAll() {
    element('follow').checked = false;
    stage.showAll();
    stale = true;
}

function showHelp(on) {
    element('help').hidden = !on;
    element('help-switch').setAttribute('aria-expanded', String(on));
}

const KEYS = {
    ' ': () => play(!playing),
    ArrowLeft: (event) => stepFrames(event.shiftKey ? -10 : -1),
    ArrowRight: (event) => stepFrames(event.shiftKey ? 10 : 1),
    ArrowUp: () => changeSpeed(1),
    ArrowDown: () => changeSpeed(-1),
    Home: () => seek(begin),
    End: () => seek(end),
    f: () => toggle('follow'),
    t: () => toggle('trail'),
    a: () => { if (motion.has_forces) toggle('forces'); },
    r: () => showAll(),
    h: () => showHelp(element('help').hidden),
};

function fillControls() {
    for (const value of SPEEDS) element('speed').add(new Option(`${value}\u00d7`, value, value === 1, value === 1));
    motion.bodies.forEach((body, index) => {
        element('body').add(new Option(body.copies > 1 ? `${body.name} (${body.copies})` : body.name, index));
    });
    element('body-choice').hidden = motion.bodies.length === 1;
    element('forces-choice').hidden = !motion.has_forces;
    element('forces').checked = motion.has_forces;
    element('scrub').min = String(begin);
    element('scrub').max = String(end);
    const caption = element('caption');
    caption.textContent = motion.title;
    const detail = document.createElement('span');
    detail.textContent = motion.detail;
    caption.append(detail);
    document.title = `${motion.title} \u2013 samara`;
    element('follow').checked = stage.isLost;
}

function listen() {
    element('play').addEventListener('click', () => play(!playing));
    element('whole').addEventListener('click', showAll);
    element('help-switch').addEventListener('click', () => showHelp(element('help').hidden));
    onPalette(() => { stale = true; });
    element('scrub').addEventListener('input', (event) => {
        play(false);
        seek(Number(event.target.value));
    });
    element('body').addEventListener('change', (event) => choose(Number(event.target.value), 0));
    element('copy').addEventListener('change', (event) => choose(chosen.body, Number(event.target.value) - motion.first_copy));
    for (const id of ['follow', 'trail', 'forces']) element(id).addEventListener('change', () => { stale = true; });
    window.addEventListener('keydown', (event) => {
        if (event.ctrlKey || event.metaKey || event.altKey || event.target.id === 'copy') return;
        const action = KEYS[event.key.length === 1 ? event.key.toLowerCase() : event.key];
        if (!action) return;
        event.preventDefault();
        action(event);
    });
    let down = null;
    const canvas = element('stage');
    canvas.addEventListener('pointerdown', (event) => { down = [event.offsetX, event.offsetY]; });
    canvas.addEventListener('pointerup', (event) => {
        if (down && Math.hypot(event.offsetX - down[0], event.offsetY - down[1]) < (event.pointerType === 'touch' ? 12 : 4)) {
            const hit = stage.pick(event.offsetX, event.offsetY);
            if (hit) choose(hit.body, hit.copy);
        }
        down = null;
    });
}

fillControls();
showHelp(window.innerWidth > 800 && window.innerHeight > 600);
listen();
choose(0, 0);
play(!window.matchMedia('(prefers-reduced-motion: reduce)').matches);
requestAnimationFrame(tick);

/** Controls of the player for scripts and tests. */
window.samara = {
    motion,
    play,
    choose,
    seek: (to) => {
        play(false);
        seek(to);
        refresh();
        stage.draw();
    },
    time: () => time,
    playing: () => playing,
    ticks: () => ticks,
    chosen,
    drawnPose: (body, copy) => stage.drawnPose(body, copy),
    series: () => series,
    stage,
};

// The light with its shadows, and the ground that they fall on.

import {
    Color, DirectionalLight, HemisphereLight, Mesh, MeshLambertMaterial, PCFShadowMap, PlaneGeometry, Vector3,
} from 'three';

const SHADOW_PIXELS = 2048;
const FROM = new Vector3(-0.38, -0.5, 1).normalize();

/** Soft ambient light, and one key light whose shadow map is fitted to the view. */
export class Light {
    constructor(renderer, scene, size) {
        renderer.shadowMap.enabled = true;
        renderer.shadowMap.type = PCFShadowMap;
        this.size = size;
        this.sky = new HemisphereLight('#ffffff', '#c4c2be', 1.6);
        this.key = new DirectionalLight('#fffaf2', 2.2);
        this.key.castShadow = true;
        this.key.shadow.mapSize.set(SHADOW_PIXELS, SHADOW_PIXELS);
        this.key.shadow.radius = 3;
        scene.add(this.sky, this.key, this.key.target);
    }

    /** Centres the shadow map on the camera's target. */
    aim(target, distance) {
        const { shadow } = this.key;
        const half = Math.min(0.6 * this.size, 0.9 * distance);
        const pixel = (2 * half) / SHADOW_PIXELS;
        this.key.target.position.copy(target);
        this.key.position.copy(target).addScaledVector(FROM, 2 * this.size);
        Object.assign(shadow.camera, { left: -half, right: half, top: half, bottom: -half, near: 1e-3 * this.size, far: 4 * this.size });
        shadow.camera.updateProjectionMatrix();
        shadow.normalBias = 1.5 * pixel;
        shadow.bias = -1e-4;
    }
}

const GRID_HEAD = `
uniform float gridStep;
uniform float reach;
uniform vec3 middle;
uniform vec3 lineColor;
varying vec3 place;
float lines(float step) {
    vec2 at = place.xy / step;
    vec2 wide = fwidth(at);
    vec2 near = abs(fract(at - 0.5) - 0.5) / max(wide, 1e-6);
    return (1.0 - min(min(near.x, near.y), 1.0)) * (1.0 - smoothstep(0.15, 0.6, max(wide.x, wide.y)));
}`;
const GRID_BODY = `
float far = distance(place.xy, middle.xy) / reach;
outgoingLight = mix(outgoingLight, lineColor, 0.5 * lines(gridStep) + 0.12 * lines(0.2 * gridStep));
diffuseColor.a = 1.0 - smoothstep(0.12, 0.9, far);
#include <opaque_fragment>`;

/** A level plane with a grid that receives shadows and fades out in the distance. */
export class Ground {
    constructor(scene, middle, reach, gridStep) {
        this.uniforms = {
            gridStep: { value: gridStep }, reach: { value: reach }, middle: { value: middle }, lineColor: { value: new Color() },
        };
        this.material = new MeshLambertMaterial({ transparent: true, polygonOffset: true, polygonOffsetFactor: 2, polygonOffsetUnits: 2 });
        this.material.onBeforeCompile = (shader) => {
            Object.assign(shader.uniforms, this.uniforms);
            shader.vertexShader = shader.vertexShader
                .replace('#include <common>', '#include <common>\nvarying vec3 place;')
                .replace('#include <begin_vertex>', '#include <begin_vertex>\nplace = (modelMatrix * vec4(position, 1.0)).xyz;');
            shader.fragmentShader = shader.fragmentShader
                .replace('#include <common>', '#include <common>' + GRID_HEAD)
                .replace('#include <opaque_fragment>', GRID_BODY);
        };
        const plane = new Mesh(new PlaneGeometry(2 * reach, 2 * reach), this.material);
        plane.position.copy(middle);
        plane.receiveShadow = true;
        plane.renderOrder = -1;
        scene.add(plane);
    }

    paint(color, lineColor) {
        this.material.color.set(color);
        this.uniforms.lineColor.value.set(lineColor);
    }
}

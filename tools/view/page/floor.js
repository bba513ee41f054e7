// The floor: a grid of metres that fades out, and the world axes.

import {CapsuleMesh} from './capsule_mesh.js';
import {rgb} from './theme.js';
import * as THREE from './three.js';

const HALF_MM = 12000;

const vertexShader = `
  varying vec2 vPlace;
  void main() {
    vPlace = position.xy;
    gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
  }`;

const fragmentShader = `
  varying vec2 vPlace;
  uniform vec3 ground;
  uniform vec3 line;
  uniform float reach;
  uniform float solid;
  float grid(float step_, float width) {
    vec2 at = abs(fract(vPlace / step_ - 0.5) - 0.5) * step_;
    vec2 pixel = fwidth(vPlace);
    vec2 on = 1.0 - smoothstep(vec2(0.0), pixel * width, at);
    return max(on.x, on.y) * (1.0 - smoothstep(0.1, 0.5, max(pixel.x, pixel.y) / step_));
  }
  void main() {
    float fade = 1.0 - smoothstep(0.45 * reach, reach, length(vPlace));
    float lines = grid(1000.0, 1.4);
    float alpha = fade * max(lines, solid);
    gl_FragColor = vec4(mix(ground, line, lines), alpha);
  }`;

export class Floor extends THREE.Group {
  constructor() {
    super();
    this.plane = new THREE.Mesh(
        new THREE.PlaneBufferGeometry(2 * HALF_MM, 2 * HALF_MM), new THREE.ShaderMaterial({
          vertexShader,
          fragmentShader,
          extensions: {derivatives: true},
          transparent: true,
          depthWrite: false,
          side: THREE.DoubleSide,
          uniforms: {
            ground: {value: new THREE.Color()},
            line: {value: new THREE.Color()},
            reach: {value: 7000},
            solid: {value: 0.85},
          },
        }));
    // First, so that transparent objects are drawn over it.
    this.plane.renderOrder = -2;
    this.axes = new CapsuleMesh(3, {thin: true, glow: 0.5});
    this.add(this.plane, this.axes);
    this.recolor();
  }

  recolor() {
    const uniforms = this.plane.material.uniforms;
    uniforms.ground.value.setRGB(...rgb('floor'));
    uniforms.line.value.setRGB(...rgb('grid'));
    this.axes.clear();
    this.axes.add(0, 0, 6, 9, 500, 0, 6, 9, rgb('axis-x'));
    this.axes.add(0, 0, 6, 9, 0, 500, 6, 9, rgb('axis-y'));
    this.axes.add(0, 0, 6, 9, 0, 0, 506, 9, rgb('axis-z'));
    this.axes.commit();
  }

  /** Over a camera's picture only the lines are shown. */
  setSolid(isSolid) {
    this.plane.material.uniforms.solid.value = isSolid ? 0.85 : 0;
  }

  /** Extends the floor beyond the cameras. */
  setReach(reachMm) {
    this.plane.material.uniforms.reach.value = Math.min(HALF_MM, Math.max(5000, reachMm));
  }
}

// Surface voxels, coloured by part. The cells of a message are passed to the graphics card
// unchanged.

import * as THREE from './three.js';

const PARTS = 10;
const drawn = new THREE.Vector2();
// Voxels come a few times a second. In between, each moves with its body part, which shows how the
// body fitted when the voxels were made. The first ten points are the centroids of the parts.
const LONGEST_CARRY_MS = 1000;

// Each voxel is one point of the cube's size, shaded as a ball; a cube would have 36 corners.
const vertexShader = `
  attribute vec4 cell;
  uniform vec3 origin;
  uniform float size;
  uniform float pixels;
  uniform vec3 palette[${PARTS + 1}];
  uniform vec3 moved[${PARTS + 1}];
  varying vec3 vTint;
  void main() {
    int part = int(min(cell.w, ${PARTS}.0));
    vec3 p = origin + (cell.xyz + 0.5) * size + moved[part];
    vTint = palette[part];
    gl_Position = projectionMatrix * modelViewMatrix * vec4(p, 1.0);
    gl_PointSize = max(1.5, 0.4 * size * pixels * projectionMatrix[1][1] / gl_Position.w);
  }`;

const fragmentShader = `
  varying vec3 vTint;
  void main() {
    vec2 at = 2.0 * gl_PointCoord - 1.0;
    float far = dot(at, at);
    if (far > 1.0) discard;
    gl_FragColor = vec4(vTint * (1.0 - 0.25 * far - 0.12 * at.y), 1.0);
  }`;

function vectors() {
  return Array.from({length: PARTS + 1}, () => new THREE.Vector3());
}

export class VoxelMesh extends THREE.Points {
  constructor() {
    super(new THREE.BufferGeometry(), new THREE.ShaderMaterial({
      vertexShader,
      fragmentShader,
      uniforms: {
        origin: {value: new THREE.Vector3()},
        size: {value: 1},
        palette: {value: vectors()},
        moved: {value: vectors()},
        pixels: {value: 1},
      },
    }));
    this.frustumCulled = false;
    this.capacity = 0;
    this.message = null;
    this.visible = false;
  }

  /** @param palette a colour [r, g, b] for each part, and for voxels without one. */
  setPalette(palette) {
    this.material.uniforms.palette.value.forEach((to, i) => to.set(...palette[i]));
  }

  /** Takes a decoded message. */
  take(message) {
    this.message = message;
    if (message.count > this.capacity) this.reserve(2 * message.count);
    const cell = this.geometry.attributes.cell;
    if (cell) {
      cell.array.set(message.cells);
      cell.updateRange = {offset: 0, count: 4 * message.count};
      cell.needsUpdate = true;
    }
    this.geometry.setDrawRange(0, message.count);
    this.material.uniforms.origin.value.set(...message.originMm);
    this.material.uniforms.size.value = message.sizeMm;
  }

  reserve(capacity) {
    // The buffer of an attribute cannot grow: release the old geometry's.
    this.geometry.dispose();
    this.geometry = new THREE.BufferGeometry();
    this.capacity = capacity;
    const cell = new THREE.BufferAttribute(new Uint16Array(4 * capacity), 4);
    this.geometry.setAttribute('cell', cell.setUsage(THREE.DynamicDrawUsage));
    // three.js takes the number of points from this attribute.
    this.geometry.setAttribute('position', cell);
  }

  onBeforeRender(renderer) {
    this.material.uniforms.pixels.value = renderer.getDrawingBufferSize(drawn).y;
  }

  /** Places the voxels for the shown time. `then` is the pose at their time, or null. */
  place(timeMs, then, now) {
    const age = this.message ? timeMs - this.message.timeMs : Infinity;
    this.visible = age < LONGEST_CARRY_MS && this.message.count > 0;
    if (!this.visible) return;
    const carry = then && now && then.hasPose && now.hasPose;
    this.material.uniforms.moved.value.forEach((to, part) => {
      const i = 3 * (part < PARTS ? part : 0);
      if (!carry || !Number.isFinite(now.points[i] - then.points[i])) return to.set(0, 0, 0);
      return to.set(...[0, 1, 2].map((axis) => now.points[i + axis] - then.points[i + axis]));
    });
  }
}

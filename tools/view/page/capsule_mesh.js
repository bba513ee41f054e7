// Many tapered capsules in one draw call. The template has angles only. The shader places its
// points on the hull of the two spheres, exactly, for any radii.

import * as THREE from './three.js';

// position = (angle around the axis, place between pole and seam, end).
function makeTemplate(sides, rings) {
  const position = [];
  const index = [];
  for (let end = 0; end < 2; ++end) {
    for (let ring = 0; ring <= rings; ++ring) {
      for (let side = 0; side <= sides; ++side) {
        position.push(2 * Math.PI * side / sides, ring / rings, end);
      }
    }
  }
  const row = sides + 1;
  for (let ring = 0; ring < 2 * rings + 1; ++ring) {
    for (let side = 0; side < sides; ++side) {
      const i = ring * row + side;
      index.push(i, i + 1, i + row, i + 1, i + row + 1, i + row);
    }
  }
  return {position: new THREE.Float32BufferAttribute(position, 3), index};
}

// Bodies are seen from near; sticks and trails are thin.
const fineTemplate = makeTemplate(16, 5);
const drawn = new THREE.Vector2();
const coarseTemplate = makeTemplate(7, 1);

const vertexShader = `
  attribute vec4 a;
  attribute vec4 b;
  attribute vec4 tint;
  varying vec3 vNormal;
  varying vec3 vEye;
  varying vec4 vTint;
  uniform bool flat_;
  uniform float thinnest;
  const float kQuarter = 1.5707963;
  void main() {
    vec3 axis = b.xyz - a.xyz;
    float length_ = length(axis);
    axis = length_ > 1e-3 ? axis / length_ : vec3(0.0, 0.0, 1.0);
    float seam = asin(clamp((a.w - b.w) / max(length_, 1e-3), -1.0, 1.0));
    float rise = position.z < 0.5 ? mix(-kQuarter, seam, position.y)
                                  : mix(seam, kQuarter, position.y);
    vec3 other = abs(axis.z) < 0.9 ? vec3(0.0, 0.0, 1.0) : vec3(1.0, 0.0, 0.0);
    vec3 u = normalize(cross(other, axis));
    vec3 v = cross(axis, u);
    vec3 side = cos(position.x) * u + sin(position.x) * v;
    vec3 n = cos(rise) * side + sin(rise) * axis;
    vec4 ball = position.z < 0.5 ? a : b;
    float far = (projectionMatrix * modelViewMatrix * vec4(ball.xyz, 1.0)).w;
    vec3 p = ball.xyz + max(ball.w, thinnest * far) * n;
    if (flat_) p.z = 1.0;
    vec4 eye = modelViewMatrix * vec4(p, 1.0);
    vNormal = n;
    vEye = cameraPosition - p;
    vTint = tint;
    gl_Position = projectionMatrix * eye;
  }`;

// A sky, and a lamp at the eye, so that bodies look solid from all sides.
const fragmentShader = `
  varying vec3 vNormal;
  varying vec3 vEye;
  varying vec4 vTint;
  uniform bool flat_;
  uniform vec3 flatColor;
  uniform float opacity;
  uniform float glow;
  void main() {
    vec3 n = normalize(vNormal);
    float light = 0.62 + 0.22 * n.z + 0.26 * max(0.0, dot(n, normalize(vEye)));
    vec3 lit = vTint.rgb * mix(light, 1.0, glow);
    gl_FragColor = flat_ ? vec4(flatColor, 1.0) : vec4(lit, vTint.a * opacity);
  }`;

function makeMaterial(options) {
  return new THREE.ShaderMaterial({
    vertexShader,
    fragmentShader,
    uniforms: {
      flat_: {value: options.flat ?? false},
      flatColor: {value: new THREE.Color(0)},
      opacity: {value: 1},
      thinnest: {value: 0},
      glow: {value: options.glow ?? 0},
    },
    transparent: options.transparent ?? false,
    depthTest: options.depthTest ?? true,
    depthWrite: options.depthWrite ?? true,
  });
}

export class CapsuleMesh extends THREE.Mesh {
  /**
   * @param options thin (few triangles each), transparent, depthTest, depthWrite, glow (0: lit …
   *     1: unlit).
   */
  constructor(capacity, options = {}) {
    super(new THREE.InstancedBufferGeometry(), makeMaterial(options));
    const template = options.thin ? coarseTemplate : fineTemplate;
    this.geometry.setIndex(template.index);
    this.geometry.setAttribute('position', template.position);
    this.frustumCulled = false;
    this.reserve(capacity);
  }

  /** Keeps everything at least a pixel and a half wide; thinner lines would break into dots. */
  onBeforeRender(renderer, scene, eye) {
    const height = renderer.getDrawingBufferSize(drawn).y;
    this.material.uniforms.thinnest.value = 1.5 / (height * eye.projectionMatrix.elements[5]);
  }

  reserve(capacity) {
    this.capacity = capacity;
    for (const name of ['a', 'b', 'tint']) {
      const attribute = new THREE.InstancedBufferAttribute(new Float32Array(4 * capacity), 4);
      attribute.setUsage(THREE.DynamicDrawUsage);
      this.geometry.setAttribute(name, attribute);
    }
    this.clear();
  }

  clear() {
    this.count = 0;
    this.geometry.maxInstancedCount = 0;
    this.visible = false;
  }

  /** Adds a capsule. Ignores one with an invalid coordinate, and those beyond the capacity. */
  add(ax, ay, az, ra, bx, by, bz, rb, [red, green, blue], alpha = 1) {
    if (this.count === this.capacity || !Number.isFinite(ax + ay + az + bx + by + bz)) return;
    const {a, b, tint} = this.geometry.attributes;
    const at = 4 * this.count++;
    a.array.set([ax, ay, az, ra], at);
    b.array.set([bx, by, bz, rb], at);
    tint.array.set([red, green, blue, alpha], at);
  }

  /** @return where the last capsules begin, as they are drawn: x, y, z of each [mm]. */
  lastStarts(count) {
    const {array} = this.geometry.attributes.a;
    const first = this.count - count;
    return Float32Array.from(
        {length: 3 * count}, (_, i) => array[4 * (first + Math.floor(i / 3)) + i % 3]);
  }

  /** Shows what was added since clear(). */
  commit() {
    this.geometry.maxInstancedCount = this.count;
    this.visible = this.count > 0;
    for (const name of ['a', 'b', 'tint']) this.geometry.attributes[name].needsUpdate = true;
  }

  /** @return a mesh of the same capsules, flattened onto the floor: their shadow. */
  makeShadow() {
    const shadow = new THREE.Mesh(this.geometry, makeMaterial({flat: true}));
    shadow.frustumCulled = false;
    return shadow;
  }
}

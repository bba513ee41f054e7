// Camera models: a small body and the frustum of each, coloured by state.

import {CapsuleMesh} from './capsule_mesh.js';
import {rgb} from './theme.js';
import * as THREE from './three.js';

const DEPTH = 0.45;  // Depth of the drawn frustum, in metres.
const MOST_CAMERAS = 64;

/** A camera's label and colour: by state, then by trust. */
export const CAMERA_LOOKS = {
  'streaming': {color: 'ok', mark: '●'},
  'starting': {color: 'warn', mark: '◔'},
  'not trusted': {color: 'warn', mark: '◆'},
  'lost': {color: 'bad', mark: '✕'},
  'ended': {color: 'muted', mark: '■'},
  'unknown': {color: 'muted', mark: '○'},
  'in the take': {color: 'accent', mark: '●'},
};

function corner(camera, i) {
  return camera.corners_mm[i].map(
      (value, axis) => camera.position_mm[axis] + DEPTH * (value - camera.position_mm[axis]));
}

export class CameraModels extends THREE.Group {
  constructor() {
    super();
    this.mesh = new CapsuleMesh(10 * MOST_CAMERAS, {thin: true, glow: 0.35});
    this.add(this.mesh);
    this.cameras = [];
    this.looks = new Map();
    this.hidden = null;
  }

  setCameras(cameras) {
    this.cameras = cameras;
    this.redraw();
  }

  /** @param looks name → key of CAMERA_LOOKS. */
  setLooks(looks) {
    const changed = [...looks].some(([name, look]) => this.looks.get(name) !== look);
    this.looks = looks;
    if (changed) this.redraw();
  }

  lookOf(name) {
    return CAMERA_LOOKS[this.looks.get(name)] ?? CAMERA_LOOKS['unknown'];
  }

  /** Hides the camera through which the scene is viewed. */
  hide(name) {
    this.hidden = name;
    this.redraw();
  }

  redraw() {
    this.mesh.clear();
    for (const camera of this.cameras) {
      if (camera.name !== this.hidden) this.draw(camera, rgb(this.lookOf(camera.name).color));
    }
    this.mesh.commit();
  }

  draw(camera, tint) {
    const eye = camera.position_mm;
    const forward = camera.rotation.slice(6, 9);
    const tail = eye.map((value, axis) => value - 130 * forward[axis]);
    this.mesh.add(...tail, 55, ...eye, 40, tint);
    for (let i = 0; i < 4; ++i) {
      const here = corner(camera, i);
      this.mesh.add(...eye, 5, ...here, 5, tint);
      this.mesh.add(...here, 5, ...corner(camera, (i + 1) % 4), i === 0 ? 12 : 5, tint);
    }
  }
}

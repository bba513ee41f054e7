// Contents and view of the scene: checkboxes, the list of cameras, keys.

import {byId, make} from './dom.js';
import {bindKeys} from './keys.js';
import {color} from './theme.js';

const LAYER_KEYS = {
  b: 'body',
  j: 'joints',
  v: 'voxels',
  t: 'trails',
  c: 'cameras',
  k: 'keypoints'
};

export class ViewTools {
  /** @param scene the 3-D scene, or null without WebGL. */
  constructor(scene, pictures) {
    this.scene = scene;
    this.pictures = pictures;
    this.names = [];
    for (const box of byId('layers').querySelectorAll('input')) {
      box.addEventListener('change', () => this.setLayer(box.dataset.layer, box.checked));
    }
    byId('view-from')
        .addEventListener('change', ({target}) => this.seeThrough(target.value || null));
    this.bind();
  }

  bind() {
    for (const [key, layer] of Object.entries(LAYER_KEYS)) {
      bindKeys(
          [key], [key.toUpperCase()], `show or hide ${layer}`, () => this.toggleLayer(layer));
    }
    bindKeys(
        [...'123456789'], ['1', '…', '9'], 'view through a camera',
        (key) => this.seeThrough(this.names[key - 1] ?? null));
    bindKeys(['0', 'Escape'], ['0', 'Esc'], 'free view', () => this.seeThrough(null));
    bindKeys(
        [...'wasd'], ['W', 'A', 'S', 'D'], 'turn the view', (key) => this.scene?.orbit.key(key));
    bindKeys(
        [...'WASD'], ['Shift', 'W', 'A', 'S', 'D'], 'move the view',
        (key) => this.scene?.orbit.key(key));
    bindKeys(['+', '=', '-'], ['+', '−'], 'zoom', (key) => this.scene?.orbit.key(key));
    bindKeys(['r'], ['R'], 'view of the whole studio', () => {
      this.seeThrough(null);
      this.scene?.orbit.reset();
    });
    bindKeys(['f'], ['F'], 'look at the people', () => this.lookAtPeople());
  }

  setLayer(layer, isOn) {
    if (layer === 'keypoints')
      this.pictures.setKeypoints(isOn);
    else
      this.scene?.setLayer(layer, isOn);
  }

  toggleLayer(layer) {
    byId('layers').querySelector(`[data-layer=${layer}]`).click();
  }

  setCameras(cameras) {
    this.names = cameras.map((camera) => camera.name);
    this.scene?.setCameras(cameras);
    this.pictures.setCameras(cameras);
    const list = byId('view-from');
    list.replaceChildren(
        make('option', {text: 'Free view', value: ''}),
        ...this.names.map((name) => make('option', {text: `From ${name}`, value: name})));
    list.value = this.scene?.through ?? '';
  }

  /** Views through a camera, or freely; choosing the same camera again means freely. */
  seeThrough(name) {
    const next = name === this.scene?.through ? null : name;
    this.scene?.seeThrough(next);
    this.pictures.choose(next);
    byId('view-from').value = next ?? '';
    byId('stage').classList.toggle('through', next !== null);
  }

  /** Looks at the people shown, so that all are visible. */
  lookAtPeople() {
    const middles = [...this.scene?.figures.values() ?? []]
                        .filter((figure) => figure.visible)
                        .map(
                            ({shown, position}) => [0, 1, 2].map(
                                (axis) => shown.points[axis] + position.getComponent(axis)));
    if (middles.length === 0) return;
    this.seeThrough(null);
    const along = (axis, pick) => pick(...middles.map((middle) => middle[axis]));
    const [low, high] =
        [Math.min, Math.max].map((pick) => [0, 1, 2].map((axis) => along(axis, pick)));
    this.scene.orbit.target = low.map((value, axis) => (value + high[axis]) / 2);
    const apartMm = Math.hypot(...low.map((value, axis) => high[axis] - value));
    this.scene.orbit.zoom((2800 + 1.2 * apartMm) / this.scene.orbit.distance);
  }

  /** @return a camera's colour in the scene. */
  cameraColor(name) {
    return this.scene ? color(this.scene.cameraModels.lookOf(name).color) : null;
  }

  draw(nowMs) {
    if (!this.scene) return;
    this.scene.render(nowMs);
    this.pictures.drawBehind(this.scene.through, byId('behind'), this.scene.pictureBox());
  }
}

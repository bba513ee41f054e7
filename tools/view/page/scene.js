// The studio in 3-D: floor, cameras, figures, and the view.

import {CameraModels} from './camera_models.js';
import {Detail, drawsInSoftware} from './detail.js';
import {make, setText} from './dom.js';
import {Figure} from './figure.js';
import {Floor} from './floor.js';
import {Orbit} from './orbit.js';
import {onTheme} from './theme.js';
import * as THREE from './three.js';

const NEAR_MM = 50;
const FAR_MM = 60000;

/** Tangents of the four sides of a camera's picture, from the rays of its corners. */
function picturesTangents(camera) {
  const local = camera.corners_mm.map((corner) => {
    const ray = corner.map((value, axis) => value - camera.position_mm[axis]);
    const row = (i) => camera.rotation.slice(3 * i, 3 * i + 3)
                           .reduce((sum, value, axis) => sum + value * ray[axis], 0);
    return [row(0) / row(2), row(1) / row(2)];
  });
  const mean = (axis, i, j) => (local[i][axis] + local[j][axis]) / 2;
  return {left: mean(0, 0, 3), right: mean(0, 1, 2), top: mean(1, 0, 1), bottom: mean(1, 2, 3)};
}

export class StudioScene {
  /**
   * @param canvas for drawing; @param labels the element above it for names;
   * @param notice the element above these, at the top centre, which covers no label;
   * @param isFine whether to draw every pixel, even if slow.
   */
  constructor(canvas, labels, notice, isFine) {
    this.canvas = canvas;
    this.labelLayer = labels;
    this.notice = notice;
    const isSoftware = drawsInSoftware();
    this.detail = new Detail({isSoftware, isFixed: isFine});
    const antialias = isFine || !isSoftware;
    this.renderer = new THREE.WebGLRenderer({canvas, antialias, alpha: true});
    this.renderer.setClearColor(0, 0);
    this.scene = new THREE.Scene();
    this.floor = new Floor();
    this.cameraModels = new CameraModels();
    this.scene.add(this.floor, this.cameraModels);
    this.eye = new THREE.PerspectiveCamera(42, 1, NEAR_MM, FAR_MM);
    this.eye.up.set(0, 0, 1);
    this.orbit = new Orbit(canvas);
    this.figures = new Map();
    this.layers = {voxels: true, body: true, joints: true, cameras: true, trails: true};
    this.through = null;
    this.labels = new Map();
    onTheme(() => this.recolor());
    new ResizeObserver(() => this.resize()).observe(canvas.parentElement);
    this.resize();
  }

  recolor() {
    this.floor.recolor();
    this.cameraModels.redraw();
    for (const figure of this.figures.values()) figure.recolor();
  }

  resize() {
    const {clientWidth: width, clientHeight: height} = this.canvas.parentElement;
    this.renderer.setPixelRatio(this.detail.ratio(window.devicePixelRatio));
    this.renderer.setSize(Math.max(1, width), Math.max(1, height), false);
    this.width = Math.max(1, width);
    this.height = Math.max(1, height);
  }

  /** Sets the cameras' poses; the first time, fits the view to them. */
  setCameras(cameras) {
    const isFirst = this.cameraModels.cameras.length === 0;
    this.cameraModels.setCameras(cameras);
    const radius = Math.max(2000, ...cameras.map((camera) => Math.hypot(...camera.position_mm)));
    this.floor.setReach(1.9 * radius);
    if (isFirst && cameras.length > 0) this.orbit.setHome([0, 0, 750], radius);
    if (this.through && !cameras.some((camera) => camera.name === this.through))
      this.seeThrough(null);
  }

  get cameras() {
    return this.cameraModels.cameras;
  }

  /** @return the figure of a key; created on first use. */
  figure(key, options) {
    if (!this.figures.has(key)) {
      const figure = new Figure(options);
      for (const [name, isOn] of Object.entries(this.layers)) figure.setLayer(name, isOn);
      figure.setShadow(this.through === null);
      this.figures.set(key, figure);
      this.scene.add(figure, figure.voxels);
    }
    return this.figures.get(key);
  }

  removeFigure(key) {
    const figure = this.figures.get(key);
    if (!figure) return;
    this.scene.remove(figure, figure.voxels);
    figure.dispose();
    this.figures.delete(key);
  }

  setLayer(name, isOn) {
    this.layers[name] = isOn;
    for (const figure of this.figures.values()) figure.setLayer(name, isOn);
  }

  /** Views the studio through a camera; null: freely. */
  seeThrough(name) {
    this.through = name;
    this.cameraModels.hide(name);
    this.floor.setSolid(name === null);
    for (const figure of this.figures.values()) figure.setShadow(name === null);
  }

  placeEye() {
    const camera = this.cameras.find((one) => one.name === this.through);
    if (camera) return this.placeEyeIn(camera);
    this.eye.position.set(...this.orbit.eye);
    this.eye.lookAt(...this.orbit.target);
    this.eye.aspect = this.width / this.height;
    // On a tall screen, the room's width must fit.
    this.eye.fov = this.eye.aspect > 1 ? 42 : 2 * Math.atan(0.5 / this.eye.aspect) * 180 / Math.PI;
    return this.eye.updateProjectionMatrix();
  }

  /** @return the camera's picture within the view, in CSS pixels. */
  pictureBox() {
    const camera = this.cameras.find((one) => one.name === this.through);
    if (!camera) return null;
    const {left, right, top, bottom} = picturesTangents(camera);
    const scale = Math.min(this.width / (right - left), this.height / (bottom - top));
    const [width, height] = [scale * (right - left), scale * (bottom - top)];
    return {left: (this.width - width) / 2, top: (this.height - height) / 2, width, height};
  }

  placeEyeIn(camera) {
    const {left, right, top, bottom} = picturesTangents(camera);
    const box = this.pictureBox();
    const growX = (this.width / box.width - 1) / 2 * (right - left);
    const growY = (this.height / box.height - 1) / 2 * (bottom - top);
    const r = camera.rotation;
    const axes = new THREE.Matrix4().makeBasis(
        new THREE.Vector3(r[0], r[1], r[2]), new THREE.Vector3(-r[3], -r[4], -r[5]),
        new THREE.Vector3(-r[6], -r[7], -r[8]));
    this.eye.position.set(...camera.position_mm);
    this.eye.quaternion.setFromRotationMatrix(axes);
    this.eye.projectionMatrix.makePerspective(
        NEAR_MM * (left - growX), NEAR_MM * (right + growX), -NEAR_MM * (top - growY),
        -NEAR_MM * (bottom + growY), NEAR_MM, FAR_MM);
    this.eye.projectionMatrixInverse.getInverse(this.eye.projectionMatrix);
  }

  render(nowMs) {
    if (this.detail.tick(nowMs)) this.resize();
    this.cameraModels.visible = this.layers.cameras;
    this.placeEye();
    this.renderer.render(this.scene, this.eye);
    this.placeLabels();
  }

  placeLabels() {
    const wanted = new Map();
    if (this.layers.cameras) {
      for (const camera of this.cameras) {
        if (camera.name === this.through) continue;
        const look = this.cameraModels.lookOf(camera.name);
        const state = this.cameraModels.looks.get(camera.name);
        const text = ['streaming', 'in the take'].includes(state) ?
            camera.name :
            `${look.mark} ${camera.name} ${state ?? ''}`;
        wanted.set(`camera ${camera.name}`, {text, place: camera.position_mm, lift: 170});
      }
    }
    for (const [axis, place] of [['x', [560, 0, 0]], ['y', [0, 560, 0]], ['z', [0, 0, 560]]]) {
      wanted.set(`axis ${axis}`, {text: axis, place, lift: 0});
    }
    for (const [key, figure] of this.figures) {
      if (!figure.visible || !figure.label) continue;
      const place = [0, 1, 2].map(
          (axis) => figure.shown.points[3 + axis] + figure.position.getComponent(axis));
      wanted.set(`figure ${key}`, {text: figure.label, place, lift: 260});
    }
    this.showLabels(wanted);
  }

  showLabels(wanted) {
    for (const [key, element] of this.labels) {
      if (wanted.has(key)) continue;
      element.remove();
      this.labels.delete(key);
    }
    for (const [key, {text, place, lift}] of wanted) {
      if (!this.labels.has(key)) {
        this.labels.set(key, this.labelLayer.appendChild(make('span', {class: key.split(' ')[0]})));
      }
      const element = this.labels.get(key);
      const at = new THREE.Vector3(place[0], place[1], place[2] + lift).project(this.eye);
      element.hidden = !(Math.abs(at.z) < 1);
      setText(element, text);
      if (element.hidden) continue;
      const x = (at.x + 1) / 2 * this.width;
      const y = this.belowNotice(element, x, (1 - at.y) / 2 * this.height);
      element.style.transform =
          `translate(${x.toFixed(1)}px, ${y.toFixed(1)}px) translate(-50%, -50%)`;
    }
  }

  /** @return the height of a label's middle, lowered if the notice would cover the label. */
  belowNotice(label, x, y) {
    if (this.notice.hidden) return y;
    const {offsetTop, offsetWidth, offsetHeight} = this.notice;
    const isBeside = Math.abs(x - this.width / 2) > (offsetWidth + label.offsetWidth) / 2;
    return isBeside ? y : Math.max(y, offsetTop + offsetHeight + label.offsetHeight / 2);
  }
}

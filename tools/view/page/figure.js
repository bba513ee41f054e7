// One person or result: body, joints and sticks, trails, voxels, shadow; the rival in doubt.

import {CapsuleMesh} from './capsule_mesh.js';
import {dashesOf, isDoubtful} from './doubt.js';
import {rgb} from './theme.js';
import * as THREE from './three.js';
import {VoxelMesh} from './voxel_mesh.js';

const TRAIL_MS = 1500;
const TRAIL_STEP_MS = 25;
const TRAIL_POINTS = ['fingertips_l', 'fingertips_r', 'foot_l', 'foot_r'];
const PARTS = 10;
const RIVAL_MM = 9;
const CONTACT_MM = 26;  // radius of a dot
const HEEL_MM = 28;     // radii of the flesh of a foot
const TOE_MM = 20;
const LEAST_CONTACT = 0.5;  // a contact that holds rather than not
const OLD_OPACITY = 0.3;
const DOUBT_OPACITY = 0.55;
// A doubtful body's colour is mixed with the ground's, so that it is paler, not only thinner.
const DOUBT_PALENESS = 0.45;

export class Figure extends THREE.Group {
  /**
   * @param options color: name of a theme colour; ownSticks: sticks in a shade of it, to compare
   * several; onlySticks: no body, as for truth.
   */
  constructor({color, ownSticks = false, onlySticks = false}) {
    super();
    this.color = color;
    this.ownSticks = ownSticks;
    this.onlySticks = onlySticks;
    this.body = new CapsuleMesh(64, {transparent: true});
    this.sticks = new CapsuleMesh(
        128, {thin: true, transparent: true, depthTest: false, depthWrite: false, glow: 0.7});
    this.rival =
        new CapsuleMesh(128, {thin: true, transparent: true, depthWrite: false, glow: 0.9});
    this.trails = new CapsuleMesh(
        4 * (TRAIL_MS / TRAIL_STEP_MS + 2),
        {thin: true, transparent: true, depthWrite: false, glow: 0.8});
    this.contacts =
        new CapsuleMesh(4, {thin: true, transparent: true, depthWrite: false, glow: 0.9});
    this.voxels = new VoxelMesh();
    this.shadow = (onlySticks ? this.sticks : this.body).makeShadow();
    this.shadow.renderOrder = -1;
    // Sticks lie inside the body and are drawn over it; the truth is drawn over everything.
    this.sticks.renderOrder = onlySticks ? 3 : 2;
    this.shownLayers = {body: true, joints: true, trails: true, voxels: true};
    this.rival.renderOrder = 2;
    this.add(this.shadow, this.contacts, this.body, this.sticks, this.rival, this.trails);
    this.castsShadow = true;
    this.setModel({point_names: [], bones: []});
    this.recolor();
  }

  /** Sets the body's description: names of points, and their connections. */
  setModel({point_names: names, bones}) {
    this.bones = bones;
    this.feet = ['foot_l', 'foot_r'].map((name) => names.indexOf(name));
    this.trailPoints = TRAIL_POINTS.map((name) => names.indexOf(name)).filter((i) => i >= 0);
  }

  recolor() {
    this.tint = rgb(this.color);
    const ground = rgb('ground');
    this.paleTint = this.tint.map((value, i) => value + DOUBT_PALENESS * (ground[i] - value));
    this.stickTint = this.onlySticks ? this.tint :
        this.ownSticks               ? this.tint.map((value) => 0.45 * value) :
                                       rgb('stick');
    this.shadow.material.uniforms.flatColor.value.setRGB(...rgb('shadow'));
    this.voxels.setPalette(
        Array.from({length: PARTS + 1}, (_, i) => rgb(i < PARTS ? `part-${i}` : 'part-none')));
  }

  /** Shows or hides a layer: body, joints, trails or voxels. */
  setLayer(name, isOn) {
    this.shownLayers[name] = isOn;
  }

  /** Over a camera's picture the floor is hidden, and so is its shadow. */
  setShadow(isOn) {
    this.castsShadow = isOn;
  }

  /**
   * Shows a pose; null: nobody. A faded pose is known to be old. A pose in doubt is pale, and its
   * rival is dashed.
   */
  show(pose, {faded = false} = {}) {
    this.visible = pose !== null && pose.hasPose;
    this.shown = this.visible ? pose : null;
    if (!this.visible) return;
    this.isPale = isDoubtful(pose);
    this.showBody(pose, faded ? OLD_OPACITY : this.isPale ? DOUBT_OPACITY : 1);
    this.showSticks(pose, faded ? 0.35 : 1);
    this.showContacts(pose);
    this.showRival(this.isPale && !faded ? pose.rival : null);
    const source = this.onlySticks ? this.sticks : this.body;
    this.shadow.visible = this.castsShadow && source.visible;
  }

  /** @return the pose with its points as they are drawn; null: nobody is. */
  drawnPose() {
    if (!this.shown) return null;
    const {timeMs, frame, points} = this.shown;
    return {timeMs, frame, points: this.sticks.lastStarts(points.length / 3)};
  }

  /** @return place, heel and toe of each foot whose heel and toe are known. */
  feetOf({points, contacts}) {
    const at = (i) => [...contacts.subarray(4 * i, 4 * i + 3)];
    const feet = this.feet.map(
        (foot, side) => [[...points.subarray(3 * foot, 3 * foot + 3)], at(side), at(2 + side)]);
    return feet.filter(
        ([, heel, toe], side) => this.feet[side] >= 0 && Number.isFinite(heel[0] + toe[0]));
  }

  showBody({capsules, ...pose}, opacity) {
    this.body.clear();
    if (capsules.length / 8 > this.body.capacity) this.body.reserve(capsules.length / 8);
    for (let i = 0; i + 8 <= capsules.length; i += 8) {
      this.body.add(...capsules.subarray(i, i + 8), this.isPale ? this.paleTint : this.tint);
    }
    for (const [, heel, toe] of capsules.length > 0 ? this.feetOf(pose) : [])
      this.body.add(...heel, HEEL_MM, ...toe, TOE_MM, this.isPale ? this.paleTint : this.tint);
    this.body.commit();
    this.body.visible = this.shownLayers.body && this.body.count > 0;
    this.body.material.uniforms.opacity.value = opacity;
    this.body.material.depthWrite = opacity === 1;
  }

  showSticks(pose, opacity) {
    const {points} = pose;
    this.sticks.clear();
    const at = (i) => points.subarray(3 * i, 3 * i + 3);
    const radius = this.onlySticks ? 13 : 7;
    for (const [i, j] of this.bones) {
      this.sticks.add(...at(i), radius, ...at(j), radius, this.stickTint);
    }
    for (const corners of this.feetOf(pose)) {
      corners.forEach(
          (a, i) => this.sticks.add(...a, radius, ...corners[(i + 1) % 3], radius, this.stickTint));
    }
    for (let i = 0; 3 * i < points.length; ++i) {
      const size = radius * (i < PARTS && !this.onlySticks ? 1.3 : 2);
      this.sticks.add(...at(i), size, ...at(i), size, this.stickTint);
    }
    this.sticks.commit();
    this.sticks.visible = this.shownLayers.joints && this.sticks.count > 0;
    this.sticks.material.uniforms.opacity.value = opacity;
  }

  /** Draws a dot on the floor under each heel and toe that touches it. */
  showContacts({contacts}) {
    this.contacts.clear();
    for (let i = 0; i < contacts.length; i += 4) {
      const [x, y, , probability] = contacts.subarray(i, i + 4);
      if (probability >= LEAST_CONTACT)
        this.contacts.add(x, y, 0, CONTACT_MM, x, y, 0, CONTACT_MM, this.tint);
    }
    this.contacts.commit();
    this.contacts.visible = this.shownLayers.joints && this.contacts.count > 0;
  }

  /** Draws the likeliest other pose in dashed lines; null: there is none. */
  showRival(rival) {
    this.rival.clear();
    const at = (i) => [...rival.points.subarray(3 * i, 3 * i + 3)];
    const dashes = rival ? this.bones.flatMap(([i, j]) => dashesOf(at(i), at(j))) : [];
    if (dashes.length > this.rival.capacity) this.rival.reserve(dashes.length);
    for (const [a, b] of dashes) this.rival.add(...a, RIVAL_MM, ...b, RIVAL_MM, this.tint);
    this.rival.commit();
    this.rival.visible = this.shownLayers.joints && this.rival.count > 0;
  }

  /** Draws the paths of hands and feet. @param poseAt capture time [ms] → pose or null. */
  showTrails(timeMs, poseAt) {
    this.trails.clear();
    if (this.visible && this.shownLayers.trails) {
      // Fixed time steps: the trail stays in place while its head moves on.
      const first = Math.ceil((timeMs - TRAIL_MS) / TRAIL_STEP_MS) * TRAIL_STEP_MS;
      let before = poseAt(first);
      for (let t = first + TRAIL_STEP_MS; before; t += TRAIL_STEP_MS) {
        const here = poseAt(Math.min(t, timeMs));
        this.addTrail(before, here, 1 - (timeMs - t) / TRAIL_MS);
        if (t >= timeMs) break;
        before = here;
      }
    }
    this.trails.commit();
  }

  /** Places the voxels, which outlast a pose: they are shown during acquisition. */
  showVoxels(timeMs, poseAt) {
    const then = this.voxels.message ? poseAt(this.voxels.message.timeMs) : null;
    this.voxels.place(timeMs, then, poseAt(timeMs));
    this.voxels.visible = this.voxels.visible && this.shownLayers.voxels;
  }

  addTrail(before, here, youth) {
    if (!here || !before.hasPose || !here.hasPose) return;
    const share = Math.max(0.05, Math.min(1, youth));
    for (const i of this.trailPoints) {
      this.trails.add(
          ...before.points.subarray(3 * i, 3 * i + 3), 9 * share,
          ...here.points.subarray(3 * i, 3 * i + 3), 9 * share, this.tint, 0.75 * share);
    }
  }

  dispose() {
    for (const mesh
             of [this.body, this.sticks, this.rival, this.trails, this.contacts, this.voxels,
                 this.shadow]) {
      mesh.geometry.dispose();
      mesh.material.dispose();
    }
  }
}

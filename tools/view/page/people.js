// The people of the live studio: their poses of the last seconds, and how they stand in the scene.

import {LiveClock} from './live_clock.js';
import {PoseHistory} from './pose_history.js';
import {figureColor} from './theme.js';

export const OLD_MS = 250;   // An older pose is never shown without saying so.
const HIDE_BODY_MS = 10000;  // What is older helps nobody.
const MOST_PEOPLE = 8;
// By how much a state says: with several people the best one is the studio's.
const RANK = ['searching', 'lost', 'acquiring', 'tracking'];

export class People {
  /** @param scene the 3-D scene, or null where there is no WebGL. */
  constructor(scene) {
    this.scene = scene;
    this.clock = new LiveClock();
    this.histories = new Map();  // person → PoseHistory
    this.body = null;
    this.shown = null;  // the first person's pose that the scene shows
  }

  /** Takes a decoded pose, just arrived. */
  takePose(pose, nowMs) {
    const wasPutBack = this.clock.arrived(nowMs, pose.timeMs, pose.publishMs);
    if (wasPutBack) [...this.histories.keys()].forEach((one) => this.forget(one));
    if (!this.histories.has(pose.person)) {
      if (this.histories.size >= MOST_PEOPLE) return;
      this.histories.set(pose.person, new PoseHistory());
    }
    this.histories.get(pose.person).add(pose);
  }

  takeVoxels(voxels) {
    if (this.histories.has(voxels.person)) this.figure(voxels.person)?.voxels.take(voxels);
  }

  takeBody(body) {
    this.body = body;
    for (const figure of this.scene?.figures.values() ?? []) figure.setModel(body);
  }

  figure(person) {
    const figure = this.scene?.figure(person, {color: figureColor(person)});
    if (figure && this.body && figure.bones !== this.body.bones) figure.setModel(this.body);
    return figure;
  }

  /** Poses everybody for now. @return the age of the oldest body shown [ms], null if none is. */
  draw(nowMs) {
    const showMs = this.clock.showTime(nowMs);
    this.forgetWhoLeft();
    this.shown = null;
    let oldest = null;
    for (const [person, history] of this.histories) {
      const ageMs = this.drawPerson(person, history, showMs ?? history.newest.timeMs, nowMs);
      if (ageMs !== null) oldest = Math.max(oldest ?? 0, ageMs);
    }
    return oldest;
  }

  /** Forgets people of whom others' poses have long outlived the last. */
  forgetWhoLeft() {
    const newestMs =
        Math.max(...[...this.histories.values()].map((history) => history.newest.timeMs));
    for (const [person, history] of this.histories) {
      if (history.newest.timeMs <= newestMs - HIDE_BODY_MS) this.forget(person);
    }
  }

  forget(person) {
    this.histories.delete(person);
    this.scene?.removeFigure(person);
  }

  drawPerson(person, history, showMs, nowMs) {
    let pose = history.at(showMs);
    // Whoever is lost stays where last seen, faded; whoever has left is gone.
    if (pose && !pose.hasPose && pose.state === 'lost') pose = history.lastBody(showMs);
    let ageMs = pose ? this.ageMs(pose.timeMs, nowMs) : Infinity;
    if (!pose?.hasPose || ageMs > HIDE_BODY_MS) [pose, ageMs] = [null, null];
    this.shown = this.shown ?? pose;
    const figure = this.figure(person);
    if (figure) {
      figure.label = this.histories.size > 1 ? `person ${person + 1}` : '';
      figure.show(pose, {faded: ageMs > OLD_MS});
      figure.showTrails(pose?.timeMs ?? 0, (t) => history.at(t));
      figure.showVoxels(showMs, (t) => history.at(t));
    }
    return ageMs;
  }

  /** @return how long ago something was captured [ms]; 0 while clocks are not known. */
  ageMs(timeMs, nowMs) {
    return this.clock.isKnown ? this.clock.serverNow(nowMs) - timeMs : 0;
  }

  /** @return the state of whoever is followed best, '' before the first pose. */
  state() {
    const states = [...this.histories.values()].map((history) => history.newest.state);
    return states.sort((a, b) => RANK.indexOf(b) - RANK.indexOf(a))[0] ?? '';
  }

  /** @return the newest pose of the first who has one, or null. */
  newestBody() {
    const newest = [...this.histories.values()].map((history) => history.newest);
    return newest.find((pose) => pose.hasPose) ?? null;
  }
}

// The people of the live studio: recent poses, and their figures in the scene.

import {doubtText, withDoubt} from './doubt.js';
import {LiveClock} from './live_clock.js';
import {PoseHistory} from './pose_history.js';
import {figureColor} from './theme.js';

export const OLD_MS = 250;   // An older pose is always marked as old.
const HIDE_BODY_MS = 10000;  // Older bodies are useless.
// Ranking of states: with several people, the studio has the best one's.
const RANK = ['searching', 'lost', 'bridged', 'acquiring', 'tracking'];

export class People {
  /** @param scene the 3-D scene, or null without WebGL. */
  constructor(scene) {
    this.scene = scene;
    this.clock = new LiveClock();
    this.histories = new Map();  // colour → PoseHistory; the person tracked longest is first
    this.told = new Map();       // id → description by mocap view
    this.body = null;
    this.shown = null;  // the first person's pose in the scene
    this.hull = scene?.figure('hull', {color: 'stick'});
    this.hull?.show(null);
  }

  /** Takes the decoded poses of a new set. People not in it have left. */
  takePoses(poses, nowMs) {
    if (poses.length === 0) return;
    // Poses from before the clock was set back lie in its future.
    const wasPutBack = this.clock.arrived(nowMs, poses[0].timeMs, poses[0].publishMs);
    if (wasPutBack) this.forgetAll();
    const histories = new Map(poses.map((pose) => [pose.person, this.historyWith(pose)]));
    for (const person of this.histories.keys()) {
      if (!histories.has(person)) this.scene?.removeFigure(person);
    }
    this.histories = histories;
  }

  forgetAll() {
    for (const person of this.histories.keys()) this.scene?.removeFigure(person);
    this.histories = new Map();
  }

  historyWith(pose) {
    const known = this.histories.get(pose.person);
    // A person in acquisition has no number yet. A colour may pass to another person.
    const isSame = known && [pose.id, 0].includes(known.newest.id);
    const history = isSame ? known : new PoseHistory();
    history.add(pose);
    return history;
  }

  takePeople({people}) {
    this.told = new Map(people.map((person) => [person.id, person]));
  }

  takeVoxels(voxels) {
    this.hull?.voxels.take(voxels);
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

  /**
   * Poses everyone for now. @return the age of the oldest shown body [ms], null if none is shown.
   */
  draw(nowMs) {
    const showMs = this.clock.showTime(nowMs);
    this.shown = null;
    let oldest = null;
    for (const [person, history] of this.histories) {
      const ageMs = this.drawPerson(person, history, showMs ?? history.newest.timeMs, nowMs);
      if (ageMs !== null) oldest = Math.max(oldest ?? 0, ageMs);
    }
    // With several people, voxels belong to nobody.
    const [first, second] = this.histories.values();
    const sole = second ? null : first;
    this.hull?.showVoxels(showMs ?? 0, (t) => sole?.at(t) ?? null);
    return oldest;
  }

  drawPerson(person, history, showMs, nowMs) {
    let pose = history.at(showMs);
    // A lost person stays at the last position, faded. One who left disappears.
    if (pose && !pose.hasPose && pose.state === 'lost') pose = history.lastBody(showMs);
    let ageMs = pose ? this.ageMs(pose.timeMs, nowMs) : Infinity;
    if (!pose?.hasPose || ageMs > HIDE_BODY_MS) [pose, ageMs] = [null, null];
    const figure = this.figure(person);
    if (figure) {
      const {id} = history.newest;
      const label = this.histories.size > 1 ? this.labelOf(id) : this.nameOf(id);
      figure.label = pose ? withDoubt(label, pose) : label;
      figure.show(pose, {faded: ageMs > OLD_MS});
      figure.showTrails(pose?.timeMs ?? 0, (t) => history.at(t));
    }
    this.shown ??= figure ? figure.drawnPose() : pose;
    return ageMs;
  }

  nameOf(id) {
    return this.told.get(id)?.name ?? '';
  }

  labelOf(id) {
    return this.nameOf(id) || `person ${id}`;
  }

  /** @return the panel's description of each person, in the order of the set. */
  rows(nowMs) {
    const serverNowMs = this.clock.isKnown ? this.clock.serverNow(nowMs) : null;
    return [...this.histories].map(([person, {newest}]) => {
      const told = this.told.get(newest.id);
      return {
        id: newest.id,
        color: figureColor(person),
        label: this.labelOf(newest.id),
        state: newest.state,
        residualMm: newest.hasPose ? newest.residualMm : null,
        doubt: newest.hasPose ? doubtText(newest) : '',
        followedS: told && serverNowMs !== null ? (serverNowMs - told.since_ms) / 1000 : null,
        hasCome: told?.has_come ?? false,
      };
    });
  }

  /** @return the age of a capture time [ms]; 0 while clocks are unknown. */
  ageMs(timeMs, nowMs) {
    return this.clock.isKnown ? this.clock.serverNow(nowMs) - timeMs : 0;
  }

  /** @return the best state of all people, '' before the first pose. */
  state() {
    const states = [...this.histories.values()].map((history) => history.newest.state);
    return states.sort((a, b) => RANK.indexOf(b) - RANK.indexOf(a))[0] ?? '';
  }

  /** @return the newest pose of the first person who has one, or null. */
  newestBody() {
    const newest = [...this.histories.values()].map((history) => history.newest);
    return newest.find((pose) => pose.hasPose) ?? null;
  }
}

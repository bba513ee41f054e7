// The studio as it is now: messages in, scene and panel out.

import {byId, setText} from './dom.js';
import {Actions} from './actions.js';
import {LatencyPlot} from './latency_plot.js';
import {LiveClock} from './live_clock.js';
import {PoseHistory} from './pose_history.js';
import {Socket} from './socket.js';
import {StatePanel, verdictOf} from './state_panel.js';
import {fixed, percent} from './text.js';
import {figureColor} from './theme.js';
import {decodePicture, decodePose, decodeVoxels, kindOf, PICTURE, POSE, VOXELS} from './wire.js';

const OLD_MS = 250;           // An older pose is never shown without saying so.
const HIDE_BODY_MS = 10000;   // What is older helps nobody.
const OLD_PICTURE_MS = 2000;
const TELL_MS = 250;          // Words and numbers change four times a second at most.
const STATE_HOLDS_MS = 1500;
const MOST_PEOPLE = 8;
const LEAST_TRUST = 0.5;
const MOST_OFF_PX = 2;
// By how much a state says: with several people the best one is the studio's.
const RANK = ['searching', 'lost', 'acquiring', 'tracking'];

/** What is said of a camera: its state, or that its silhouettes do not fit the others'. */
export function lookOfCamera({state, trust, off_px: offPx}) {
  if (state !== 'streaming') return state;
  const isOff = trust !== null && (trust < LEAST_TRUST || Math.abs(offPx ?? 0) > MOST_OFF_PX);
  return isOff ? 'not trusted' : 'streaming';
}

function factsOf(camera) {
  const parts = [`${fixed(camera.frames_per_second, 1)} /s`];
  if (camera.trust !== null) parts.push(`trust ${percent(camera.trust)}`);
  if (camera.off_px !== null && camera.trust !== null) parts.push(`off ${fixed(camera.off_px, 1)} px`);
  if (camera.light !== null) parts.push(`light ${percent(camera.light)}`);
  for (const name of ['dropped', 'late', 'torn']) {
    if (camera[name] > 0) parts.push(`${name} ${camera[name]}`);
  }
  return parts.join(' · ');
}

export class Live {
  constructor(scene, pictures, tools) {
    Object.assign(this, {scene, pictures, tools});
    this.clock = new LiveClock();
    this.people = new Map(); // person → PoseHistory
    this.shown = null;
    this.body = null;
    this.status = null;
    this.service = null;
    this.serviceMs = null;
    this.poseMs = null;
    this.toldMs = 0;
    this.notice = {pictures: '', silence: '', control: ''};
    this.pictureTimes = new Map();
    this.panel = new StatePanel();
    this.latency = new LatencyPlot();
    this.actions = new Actions();
  }

  async start() {
    this.socket = new Socket(`ws://${location.host}/live`, {
      open: () => this.opened(),
      text: (message) => this.takeText(message),
      binary: (buffer) => this.takeBinary(buffer),
      closed: () => {},
    });
  }

  opened() {
    this.clock.reset();
    this.actions.check();
  }

  takeText(message) {
    const take = {
      studio: () => this.takeStudio(message),
      body: () => this.takeBody(message),
      status: () => this.takeStatus(message),
      service: () => this.takeService(message),
      notice: () => this.takeNotice(message),
    }[message?.type];
    take?.();
  }

  takeStudio({name, cameras}) {
    this.cameras = cameras;
    setText(byId('title'), name);
    this.tools.setCameras(cameras);
  }

  takeBody(body) {
    const isNew = JSON.stringify(body) !== this.bodyText;
    if (!isNew) return;
    this.bodyText = JSON.stringify(body);
    this.body = body;
    for (const figure of this.scene?.figures.values() ?? []) figure.setModel(body);
    this.panel.setBody(body);
  }

  takeStatus(status) {
    this.status = status;
    this.panel.setStatus(status);
    this.latency.take(status.stages);
    this.scene?.cameraModels.setLooks(new Map(Object.entries(this.cameraStates())));
  }

  takeService(service) {
    this.service = service;
    this.serviceMs = performance.now();
    const serverNowMs = this.clock.isKnown ? this.clock.serverNow(this.serviceMs) : Date.now();
    this.panel.setService(service, serverNowMs / 1000);
    this.actions.setRecording(service.recording.state);
  }

  takeNotice(notice) {
    this.notice = notice;
    this.panel.setNotice(notice);
    this.actions.setNotice(notice.control);
  }

  takeBinary(buffer) {
    try {
      const kind = kindOf(buffer);
      if (kind === POSE) this.takePose(decodePose(buffer));
      else if (kind === VOXELS) this.takeVoxels(decodeVoxels(buffer));
      else if (kind === PICTURE) this.takePicture(decodePicture(buffer));
    } catch (error) {
      // A message that is cut off; the next one comes soon.
      if (!(error instanceof RangeError)) throw error;
    }
  }

  takePose(pose) {
    const nowMs = performance.now();
    this.poseMs = nowMs;
    this.clock.arrived(nowMs, pose.timeMs, pose.publishMs);
    if (!this.people.has(pose.person)) {
      if (this.people.size >= MOST_PEOPLE) return;
      this.people.set(pose.person, new PoseHistory());
    }
    this.people.get(pose.person).add(pose);
  }

  takeVoxels(voxels) {
    if (this.people.has(voxels.person)) this.figure(voxels.person)?.voxels.take(voxels);
  }

  takePicture(picture) {
    const camera = this.cameras?.[picture.camera];
    if (!camera) return;
    this.pictureTimes.set(camera.name, picture.timeMs);
    this.pictures.take(picture);
  }

  figure(person) {
    const figure = this.scene?.figure(person, {color: figureColor(person)});
    if (figure && this.body && figure.bones !== this.body.bones) figure.setModel(this.body);
    return figure;
  }

  draw(nowMs, fps) {
    const timeMs = this.clock.showTime(nowMs);
    this.shown = null;
    let shownAgeMs = null;
    this.forgetWhoLeft();
    for (const [person, history] of this.people) {
      const ageMs = this.drawPerson(person, history, timeMs, nowMs);
      if (ageMs !== null) shownAgeMs = Math.max(shownAgeMs ?? 0, ageMs);
    }
    this.tellAge(shownAgeMs);
    if (nowMs - this.toldMs < TELL_MS) return;
    this.toldMs = nowMs;
    this.tell(nowMs, fps);
  }

  /** Forgets people of whom others' poses have long outlived the last. */
  forgetWhoLeft() {
    const newestMs = Math.max(...[...this.people.values()].map((history) => history.newest.timeMs));
    for (const [person, history] of this.people) {
      if (history.newest.timeMs > newestMs - HIDE_BODY_MS) continue;
      this.people.delete(person);
      this.scene?.removeFigure(person);
    }
  }

  /** @return the age of the body that is shown [ms], null if none is. */
  drawPerson(person, history, timeMs, nowMs) {
    const serverNowMs = this.clock.isKnown ? this.clock.serverNow(nowMs) : history.newest.timeMs;
    const showMs = timeMs ?? history.newest.timeMs;
    let pose = history.at(showMs);
    // Whoever is lost stays where last seen, faded; whoever has left is gone.
    if (pose && !pose.hasPose && pose.state === 'lost') pose = history.lastBody(showMs);
    const ageMs = pose ? serverNowMs - pose.timeMs : Infinity;
    if (!pose?.hasPose || ageMs > HIDE_BODY_MS) pose = null;
    const figure = this.figure(person);
    figure?.show(pose, {faded: ageMs > OLD_MS});
    if (figure) figure.label = this.people.size > 1 ? `person ${person + 1}` : '';
    figure?.showTrails(pose ? pose.timeMs : 0, (t) => history.at(t));
    figure?.showVoxels(showMs, (t) => history.at(t));
    if (pose && this.shown === null) this.shown = pose;
    return pose ? ageMs : null;
  }

  tellAge(ageMs) {
    const banner = byId('old');
    const isOld = ageMs !== null && ageMs > OLD_MS;
    banner.hidden = !isOld;
    if (isOld) setText(banner, `last pose ${fixed(ageMs / 1000, 1)} s ago`);
  }

  tell(nowMs, fps) {
    const since = (ms) => ms === null ? null : (nowMs - ms) / 1000;
    const newest = [...this.people.values()].map((history) => history.newest).filter(Boolean);
    this.panel.setVerdict(verdictOf({
      isOpen: this.socket.isOpen,
      sinceClosedS: (nowMs - this.socket.closedMs) / 1000,
      silence: this.notice.silence,
      serviceAgeS: since(this.serviceMs),
      poseAgeS: since(this.poseMs),
      complaints: this.service?.complaints ?? [],
    }));
    this.panel.setState(this.state() || (this.poseMs === null ? 'waiting' : 'not known'));
    this.panel.setFit(newest.find((pose) => pose.hasPose) ?? null);
    setText(byId('page-fps'), fixed(fps, 0));
    setText(byId('connection'), this.socket.isOpen ? '' : 'not connected');
    this.tellCameras(nowMs);
  }

  tellCameras(nowMs) {
    const looks = this.cameraStates();
    for (const card of this.pictures.cards) {
      const camera = this.status?.cameras.find((one) => one.name === card.name);
      const look = looks[card.name];
      const timeMs = this.pictureTimes.get(card.name);
      const ageMs = timeMs && this.clock.isKnown ? this.clock.serverNow(nowMs) - timeMs : null;
      let veil = '';
      if (look === 'lost' || look === 'ended') veil = look;
      else if (ageMs === null || ageMs > OLD_PICTURE_MS) {
        veil = card.picture ? `${fixed(ageMs / 1000, 0)} s old` : 'no picture';
      }
      card.tell({look, facts: camera ? factsOf(camera) : '', veil});
    }
  }

  state() {
    // A state of which nothing has been heard is none.
    if (!(performance.now() - this.poseMs < STATE_HOLDS_MS)) return '';
    const states = [...this.people.values()].map((history) => history.newest?.state ?? 'searching');
    states.sort((a, b) => RANK.indexOf(b) - RANK.indexOf(a));
    return states[0] ?? '';
  }

  shownPose() {
    return this.shown;
  }

  poseOf(frame) {
    return this.people.get(0)?.ofFrame(frame) ?? null;
  }

  shownFrame() {
    return this.shown?.frame ?? null;
  }

  pictureFrames() {
    return Object.fromEntries(this.pictureTimes);
  }

  cameraStates() {
    return Object.fromEntries((this.status?.cameras ?? []).map((camera) =>
        [camera.name, lookOfCamera(camera)]));
  }
}

// The live studio: passes messages to scene and panel.

import {Actions} from './actions.js';
import {factsOf, lookOfCamera} from './camera_text.js';
import {byId, setText} from './dom.js';
import {LatencyPlot, STAGES} from './latency_plot.js';
import {OLD_MS, People} from './people.js';
import {Socket} from './socket.js';
import {StatePanel, conclusionOf} from './state_panel.js';
import {ageText, fixed} from './text.js';
import {decodeAll, decodeKeypoints, decodePicture, decodePose, decodeVoxels, KEYPOINTS, kindOf, PICTURE, POSE, VOXELS} from './wire.js';

const OLD_PICTURE_MS = 2000;
const TELL_MS = 250;  // Text and numbers change at most four times a second.
const STATE_HOLDS_MS = 1500;
const STATUS_HOLDS_S = 3.5;

export class Live {
  constructor(scene, pictures, tools) {
    Object.assign(this, {scene, pictures, tools});
    this.people = new People(scene);
    this.cameras = [];
    this.status = null;
    this.statusMs = null;
    this.poseMs = null;
    this.toldMs = 0;
    this.notice = {pictures: '', silence: '', control: ''};
    this.pictureTimes = new Map();
    this.keypoints = new Map();  // number of the camera → views
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
    this.people.clock.reset();
    this.actions.check();
  }

  takeText(message) {
    const take = {
      studio: () => this.takeStudio(message),
      body: () => this.takeBody(message),
      people: () => this.people.takePeople(message),
      status: () => this.takeStatus(message),
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
    // It comes every second, usually unchanged.
    const text = JSON.stringify(body);
    if (text === this.bodyText) return;
    this.bodyText = text;
    this.people.takeBody(body);
    this.panel.setBody(body);
  }

  takeStatus(status) {
    this.status = status;
    this.statusMs = performance.now();
    const {clock} = this.people;
    const serverNowMs = clock.isKnown ? clock.serverNow(this.statusMs) : Date.now();
    this.panel.setStatus(status, serverNowMs / 1000);
    this.latency.take(STAGES.map((name) => ({name, ...status[name]})));
    this.actions.setRecording(status.recording.state);
  }

  takeNotice(notice) {
    this.notice = notice;
    this.panel.setNotice(notice);
    this.actions.setNotice(notice.control);
  }

  takeBinary(buffer) {
    try {
      const kind = kindOf(buffer);
      if (kind === POSE)
        this.takePoses(decodeAll(buffer, decodePose));
      else if (kind === VOXELS)
        this.people.takeVoxels(decodeVoxels(buffer));
      else if (kind === PICTURE)
        this.takePicture(decodePicture(buffer));
      else if (kind === KEYPOINTS)
        this.takeKeypoints(decodeAll(buffer, decodeKeypoints));
    } catch (error) {
      // A truncated message; the next one comes soon.
      if (!(error instanceof RangeError)) throw error;
    }
  }

  takePoses(poses) {
    this.poseMs = performance.now();
    this.people.takePoses(poses, this.poseMs);
  }

  takePicture(picture) {
    const camera = this.cameras[picture.camera];
    if (!camera) return;
    this.pictureTimes.set(camera.name, picture.timeMs);
    this.pictures.take({...picture, keypoints: this.keypoints.get(picture.camera) ?? []});
  }

  /** Keeps the views of one camera for its next pictures. */
  takeKeypoints(views) {
    this.keypoints.set(views[0].camera, views);
    this.pictures.tellKeypoints();
  }

  draw(nowMs, fps) {
    this.tellAge(this.people.draw(nowMs));
    if (nowMs - this.toldMs < TELL_MS) return;
    this.toldMs = nowMs;
    this.tell(nowMs, fps);
  }

  tellAge(ageMs) {
    const isOld = ageMs !== null && ageMs > OLD_MS;
    byId('old').hidden = !isOld;
    if (isOld) setText(byId('old'), `last pose ${fixed(ageMs / 1000, 1)} s ago`);
  }

  tell(nowMs, fps) {
    const since = (ms) => ms === null ? null : (nowMs - ms) / 1000;
    this.panel.setConclusion(conclusionOf({
      isOpen: this.socket.isOpen,
      sinceClosedS: since(this.socket.closedMs),
      silence: this.notice.silence,
      serviceAgeS: since(this.statusMs),
      poseAgeS: since(this.poseMs),
      complaints: this.status?.complaints ?? [],
    }));
    this.panel.setState(this.state() || (this.poseMs === null ? 'waiting' : 'unknown'));
    this.panel.setFit(this.people.newestBody());
    const people = this.people.rows(nowMs);
    this.panel.setPeople(people);
    this.actions.setPeople(people);
    setText(byId('page-fps'), fixed(fps, 0));
    setText(byId('connection'), this.socket.isOpen ? '' : 'not connected');
    this.tellStatusAge(since(this.statusMs));
    this.tellCameras(nowMs);
  }

  /**
   * Shows when the panel's figures are old. The cameras' state is then unknown, also in the scene.
   */
  tellStatusAge(ageS) {
    const isOld = ageS > STATUS_HOLDS_S;
    setText(byId('figures-title'), isOld ? `As of ${ageText(ageS)} ago` : 'Now');
    for (const id of ['figures', 'latency']) byId(id).classList.toggle('stale', isOld);
    this.scene?.cameraModels.setLooks(new Map(Object.entries(this.cameraStates())));
  }

  tellCameras(nowMs) {
    const looks = this.cameraStates();
    for (const card of this.pictures.cards) {
      const camera = this.status?.cameras.find((one) => one.name === card.name);
      const look = looks[card.name];
      const timeMs = this.pictureTimes.get(card.name);
      const ageMs = timeMs === undefined ? null : this.people.ageMs(timeMs, nowMs);
      let veil = '';
      if (look === 'lost' || look === 'ended')
        veil = look;
      else if (!card.picture || ageMs === null)
        veil = 'no picture';
      else if (ageMs > OLD_PICTURE_MS)
        veil = ageMs < 100000 ? `${fixed(ageMs / 1000)} s old` : `${ageText(ageMs / 1000)} old`;
      card.tell({look: look ?? 'unknown', facts: camera ? factsOf(camera) : '', veil});
    }
  }

  /** @return the state; '' without recent messages. */
  state() {
    return performance.now() - this.poseMs < STATE_HOLDS_MS ? this.people.state() : '';
  }

  shownPose() {
    return this.people.shown;
  }

  poseOf(frame) {
    const [first] = this.people.histories.values();
    return first?.ofFrame(frame) ?? null;
  }

  shownPeople() {
    return this.people.rows(performance.now());
  }

  shownFrame() {
    return this.shownPose()?.frame ?? null;
  }

  pictureFrames() {
    return Object.fromEntries(this.pictureTimes);
  }

  cameraStates() {
    const isOld = performance.now() - this.statusMs > 1000 * STATUS_HOLDS_S;
    return Object.fromEntries(
        (this.status?.cameras ??
         []).map((camera) => [camera.name, isOld ? 'unknown' : lookOfCamera(camera)]));
  }
}

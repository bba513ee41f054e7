// A recorded take with its results: playback, steps, and comparison with the truth.

import {Chunks} from './chunks.js';
import {byId, setText} from './dom.js';
import {bindKeys} from './keys.js';
import {interpolate} from './pose_history.js';
import {ResultPanel} from './result_panel.js';
import {SeenFetcher} from './seen_fetcher.js';
import {figureColor} from './theme.js';
import {frameAt, PlayHead} from './timeline.js';
import {TimelineView} from './timeline_view.js';
import {decodeAll, decodePose, KEYPOINTS, PICTURE, STATES, VOXELS} from './wire.js';

const APART_MM = 1200;

async function fetchBytes(url) {
  const answer = await fetch(url);
  if (!answer.ok) throw new Error(`${url}: ${answer.status}`);
  return answer.arrayBuffer();
}

export class Replay {
  constructor(scene, pictures, tools) {
    Object.assign(this, {scene, pictures, tools});
    this.shown = null;
    this.over = 0;
    this.hidden = new Set();
    this.pictureTimes = new Map();
    this.lastMs = null;
  }

  async start() {
    const take = JSON.parse(new TextDecoder().decode(await fetchBytes('/take.json')));
    this.take = take;
    this.head = new PlayHead(take.times_ms);
    this.tools.setCameras(take.studio.cameras);
    this.scene?.cameraModels.setLooks(new Map(Object.entries(this.cameraStates())));
    this.tracks = take.results.map(
        (result, k) => this.makeTrack(
            k, `result=${k}`, result.body,
            {color: figureColor(k), ownSticks: take.results.length > 1}));
    const {body} = take.results[0] ?? {body: {point_names: [], bones: []}};
    take.truth?.people.forEach((name, i) => {
      const track =
          this.makeTrack(`truth ${i}`, `truth=${i}`, body, {color: 'truth', onlySticks: true});
      this.tracks.push({...track, isTruth: true});
    });
    this.setApart(false);
    this.timeline = new TimelineView(take, this.head);
    this.panel = new ResultPanel(take, {
      onShow: (key, isOn) => isOn ? this.hidden.delete(key) : this.hidden.add(key),
      onOver: (k) => this.over = k,
      onApart: (isApart) => this.setApart(isApart),
    });
    this.hull = this.scene?.figure('hull', {color: 'stick'});
    this.hull?.show(null);
    this.fetcher = new SeenFetcher(fetchBytes, (seen) => this.takeSeen(seen));
    this.bind();
  }

  makeTrack(key, query, body, options) {
    const figure = this.scene?.figure(key, options);
    figure?.setModel(body);
    const chunks = new Chunks(
        this.take.times_ms.length,
        async (from, count) => decodeAll(
            await fetchBytes(`/poses.bin?${query}&from=${from}&count=${count}`), decodePose));
    return {key, figure, chunks};
  }

  bind() {
    const {head} = this;
    bindKeys([' '], ['Space'], 'play or pause', () => head.toggle());
    bindKeys(
        ['ArrowLeft', 'ArrowRight'], ['←', '→'], 'previous or next frame; with Shift ten',
        (key, event) => head.step((key === 'ArrowLeft' ? -1 : 1) * (event.shiftKey ? 10 : 1)));
    bindKeys(
        ['Home', 'End'], ['Home', 'End'], 'first or last frame',
        (key) => head.seek(key === 'Home' ? 0 : head.last));
    bindKeys(
        [',', '.'], [',', '.'], 'slower or faster',
        (key) => head.changeSpeed(key === ',' ? -1 : 1));
  }

  /** Shows results side by side, as bodies would hide one another. */
  setApart(isApart) {
    this.take.results.forEach((result, k) => {
      const {figure} = this.tracks[k];
      if (!figure) return;
      figure.position.set(isApart ? APART_MM * result.group : 0, 0, 0);
      figure.label = isApart ? result.name : result.person.replace('-', ' ');
    });
  }

  takeSeen(seen) {
    this.pictureTimes.clear();
    for (const voxels of seen.filter(({kind}) => kind === VOXELS)) this.hull?.voxels.take(voxels);
    const views = seen.filter(({kind}) => kind === KEYPOINTS);
    if (views.length > 0) this.pictures.tellKeypoints();
    for (const picture of seen.filter(({kind}) => kind === PICTURE)) {
      const camera = this.take.studio.cameras[picture.camera];
      if (!camera) continue;
      this.pictureTimes.set(camera.name, picture.timeMs);
      const keypoints = views.filter((view) => view.camera === picture.camera);
      this.pictures.take({...picture, keypoints});
    }
    this.tellCameras();
  }

  tellCameras() {
    for (const card of this.pictures.cards) {
      const timeMs = this.pictureTimes.get(card.name);
      // Adding zero turns -0 into 0.
      const sinceS = Math.round(timeMs - this.take.times_ms[0]) / 1000 + 0;
      const facts = timeMs === undefined ? '' : `${sinceS.toFixed(3)} s`;
      const veil = timeMs === undefined ? 'no picture' : '';
      card.tell({look: 'in the take', facts, veil});
    }
  }

  /** @return the pose of a track at a time within the take, null if there is none. */
  poseAt({chunks}, timeMs) {
    const {timesMs} = this.head;
    const frame = frameAt(timesMs, timeMs);
    const pose = chunks.get(frame);
    const next = chunks.get(frame + 1);
    if (!pose || !next || timesMs[frame] >= timeMs) return pose;
    return interpolate(
        pose, next, (timeMs - timesMs[frame]) / (timesMs[frame + 1] - timesMs[frame]));
  }

  draw(nowMs) {
    this.head.advance(nowMs - (this.lastMs ?? nowMs));
    this.lastMs = nowMs;
    const {frame, timeMs} = this.head;
    let isLoading = false;
    this.tracks.forEach((track) => {
      track.chunks.want(frame);
      const pose = this.poseAt(track, timeMs);
      isLoading ||= pose === null;
      this.drawTrack(track, pose, timeMs);
    });
    const [first] = this.tracks;
    this.shown = first?.figure ? first.figure.drawnPose() : first && this.poseAt(first, timeMs);
    byId('old').hidden = !isLoading && !this.fetcher.hasFailed;
    setText(
        byId('old'), this.fetcher.hasFailed ? 'mocap view does not answer; start it again' :
                                              'poses are being loaded');
    this.hull?.showVoxels(this.head.timesMs[frame], () => null);
    this.fetcher.want(frame, this.over);
    this.timeline.draw();
    this.panel.show(frame, this.head.last);
  }

  drawTrack({key, isTruth, figure, chunks}, pose, timeMs) {
    if (!figure) return;
    figure.show(this.hidden.has(isTruth ? 'truth' : key) ? null : pose);
    figure.showTrails(timeMs, (t) => t < this.head.timesMs[0] ? null : this.poseAt({chunks}, t));
  }

  state() {
    return STATES[this.take?.results[0]?.states[this.head.frame]] ?? '';
  }

  shownPose() {
    return this.shown;
  }

  poseOf(frame) {
    return this.tracks?.[0]?.chunks.get(frame) ?? null;
  }

  shownPeople() {
    return (this.take?.results ?? []).map((result, k) => ({
                                            label: result.name,
                                            color: figureColor(k),
                                            state: STATES[result.states[this.head.frame]] ?? '',
                                          }));
  }

  shownFrame() {
    return this.head?.frame ?? null;
  }

  pictureFrames() {
    return Object.fromEntries(this.pictureTimes);
  }

  cameraStates() {
    return Object.fromEntries(
        (this.take?.studio.cameras ?? []).map((camera) => [camera.name, 'in the take']));
  }
}

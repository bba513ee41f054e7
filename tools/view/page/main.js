// `mocap view` in the browser: asks what to show, and starts it.

import {byId, setText} from './dom.js';
import {bindKeys, startKeys} from './keys.js';
import {Live} from './live.js';
import {Pictures} from './pictures.js';
import {Replay} from './replay.js';
import {StudioScene} from './scene.js';
import {startTheme, toggleTheme} from './theme.js';
import {ViewTools} from './view_tools.js';

const RETRY_MS = 2000;
const FPS_WINDOW_MS = 1000;

/** Counts frames drawn in the last second. */
class FrameCounter {
  constructor() {
    this.times = [];
  }

  tick(nowMs) {
    this.times.push(nowMs);
    while (this.times[0] < nowMs - FPS_WINDOW_MS) this.times.shift();
  }

  get rate() {
    const span = this.times.at(-1) - this.times[0];
    return span > 0 ? 1000 * (this.times.length - 1) / span : 0;
  }
}

async function askWhatToShow() {
  for (;;) {
    try {
      const answer = await fetch('/view.json');
      if (answer.ok) return await answer.json();
    } catch {
      // The server is not running; the request is repeated below.
    }
    setText(byId('connection'), 'mocap view does not answer. Retrying.');
    await new Promise((resolve) => setTimeout(resolve, RETRY_MS));
  }
}

function makeScene() {
  try {
    // #detail=full is for the script that takes a picture of the page without a graphics card.
    const isFine = new URLSearchParams(location.hash.slice(1)).get('detail') === 'full';
    return new StudioScene(byId('scene'), byId('labels'), byId('old'), isFine);
  } catch (error) {
    byId('no-webgl').hidden = false;
    console.warn(`no 3-D: ${error.message}`);
    return null;
  }
}

function openHelp() {
  const help = byId('help');
  if (!help.open) help.showModal();
}

function startPageKeys() {
  byId('help-button').addEventListener('click', openHelp);
  bindKeys(['l'], ['L'], 'light or dark', toggleTheme);
  bindKeys(['?'], ['?'], 'this list', openHelp);
  startKeys();
}

/** Read-only state for tests and curious users. */
function expose(mode, show, tools, counter) {
  window.mocapView = Object.freeze({
    mode,                               // 'live' or 'replay'
    state: () => show.state(),          // 'searching', 'acquiring', 'tracking', 'lost', ''
    shownPose: () => show.shownPose(),  // {timeMs, frame, points: Float32Array(69)} in the scene
    poseOf: (frame) => show.poseOf(frame),  // the same as received, or null
    people: () => show.shownPeople(),       // the tracked people, as in the panel
    shownFrame: () => show.shownFrame(),    // replay: index of the frame; live: its number, or null
    pictureFrames: () => show.pictureFrames(),       // camera → capture time [ms] of its picture
    cameraStates: () => show.cameraStates(),         // camera → its label
    cameraColor: (name) => tools.cameraColor(name),  // '#rrggbb' in the scene
    fps: () => counter.rate,                         // frames drawn per second by this page
  });
}

async function start() {
  startTheme();
  const {mode, title} = await askWhatToShow();
  document.documentElement.dataset.mode = mode;
  document.title = `${title} – mocapd`;
  setText(byId('title'), title);
  setText(byId('connection'), '');
  const scene = makeScene();
  const pictures = new Pictures(byId('pictures'), (name) => tools.seeThrough(name));
  const tools = new ViewTools(scene, pictures);
  const counter = new FrameCounter();
  const show =
      mode === 'replay' ? new Replay(scene, pictures, tools) : new Live(scene, pictures, tools);
  startPageKeys();
  expose(mode, show, tools, counter);
  await show.start();
  const draw = () => {
    requestAnimationFrame(draw);
    const nowMs = performance.now();
    if (scene && !scene.detail.isDue(nowMs)) return;
    counter.tick(nowMs);
    show.draw(nowMs, counter.rate);
    tools.draw(nowMs);
    pictures.draw();
  };
  requestAnimationFrame(draw);
}

start();

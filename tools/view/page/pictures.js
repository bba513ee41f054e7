// The strip of cameras: each picture with trimap, body and keypoints, and the camera's state.

import {CAMERA_LOOKS} from './camera_models.js';
import {byId, fitCanvas, make, setText} from './dom.js';
import {drawKeypoints} from './keypoints.js';
import {drawLines, drawTrimap} from './picture_lines.js';
import {percent} from './text.js';
import {onTheme} from './theme.js';

/** @return how much of the people a camera does not know. */
function unknownText(share) {
  return share < 0 ? '' : `${percent(share)} of the people unknown`;
}

/** One camera of the strip. */
class CameraCard {
  constructor(camera, number, onChoose) {
    this.name = camera.name;
    this.action = `View through ${camera.name}`;
    this.picture = null;  // the last drawn one, decoded
    this.bitmap = null;
    this.isDrawn = true;
    this.next = null;  // the newest, waiting while another is decoded
    this.isDecoding = false;
    this.canvas = make('canvas', {role: 'img', 'aria-label': `Picture of ${camera.name}`});
    this.canvas.style.aspectRatio = `${camera.size_px[0]} / ${camera.size_px[1]}`;
    this.veil = make('span', {class: 'veil'});
    this.button = make(
        'button', {
          class: 'picture',
          type: 'button',
          'aria-pressed': 'false',
          'aria-label': this.action
        },
        this.canvas, this.veil);
    this.button.addEventListener('click', () => onChoose(camera.name));
    this.mark = make('span', {class: 'mark', 'aria-hidden': 'true'});
    this.look = make('span', {class: 'look'});
    this.unknown = make('p', {class: 'unknown'});
    this.facts = make('p', {class: 'facts'});
    const key = number <= 9 ? make('kbd', {text: number, 'aria-hidden': 'true'}) : '';
    this.element = make(
        'li', {class: 'camera'}, this.button,
        make(
            'p', {class: 'camera-name'}, this.mark, make('strong', {text: camera.name}), this.look,
            key),
        this.unknown, this.facts);
  }

  take(picture) {
    this.next = picture;
    if (!this.isDecoding) this.decode();
  }

  async decode() {
    this.isDecoding = true;
    while (this.next) {
      const picture = this.next;
      this.next = null;
      try {
        const bitmap = await createImageBitmap(new Blob([picture.jpeg], {type: 'image/jpeg'}));
        this.bitmap?.close();
        this.bitmap = bitmap;
        this.picture = {...picture, jpeg: null};
        this.isDrawn = false;
      } catch {
        // A damaged picture is ignored: the card shows the age of the last one.
      }
    }
    this.isDecoding = false;
  }

  draw(hasKeypoints) {
    this.isDrawn = true;
    if (this.picture) setText(this.unknown, unknownText(this.picture.unknownShare));
    if (!this.bitmap || this.canvas.clientWidth === 0) return;
    const {clientWidth: width, clientHeight: height} = this.canvas;
    const context = fitCanvas(this.canvas);
    context.drawImage(this.bitmap, 0, 0, width, height);
    drawLines(context, this.picture, width, height);
    if (!hasKeypoints) return;
    context.scale(width / this.picture.widthPx, height / this.picture.heightPx);
    drawKeypoints(context, this.picture, width / this.picture.widthPx);
  }

  clear() {
    this.next = null;
    this.picture = null;
    this.bitmap?.close();
    this.bitmap = null;
    fitCanvas(this.canvas);
  }

  /**
   * @param look key of CAMERA_LOOKS; @param facts lines of text; @param veil why it is grey, or ''.
   */
  tell({look, facts, veil}) {
    const {mark, color: name} = CAMERA_LOOKS[look] ?? CAMERA_LOOKS['unknown'];
    setText(this.mark, mark);
    this.element.dataset.tone = name;
    setText(this.look, look === 'in the take' ? '' : look);
    setText(this.facts, facts);
    setText(this.veil, veil);
    this.button.setAttribute('aria-label', veil === '' ? this.action : `${veil}. ${this.action}`);
    this.element.classList.toggle('old', veil !== '');
  }
}

export class Pictures {
  /** @param list the list's element; @param onChoose called with a camera's name. */
  constructor(list, onChoose) {
    this.list = list;
    this.onChoose = onChoose;
    this.cards = [];
    this.hasKeypoints = true;
    onTheme(() => this.redraw());
    new ResizeObserver(() => this.redraw()).observe(list);
  }

  redraw() {
    for (const card of this.cards) card.draw(this.hasKeypoints);
  }

  /** Tells what keypoints are, once there are some. */
  tellKeypoints() {
    byId('keypoint-legend').hidden = false;
  }

  /** Shows or hides keypoints. */
  setKeypoints(isOn) {
    this.hasKeypoints = isOn;
    this.redraw();
  }

  setCameras(cameras) {
    const names = cameras.map((camera) => camera.name).join('\n');
    if (names === this.names) return;
    this.names = names;
    for (const card of this.cards) card.clear();
    this.cards = cameras.map((camera, i) => new CameraCard(camera, i + 1, this.onChoose));
    this.list.replaceChildren(...this.cards.map((card) => card.element));
    this.list.style.setProperty('--cameras', cameras.length);
  }

  /** Takes a decoded picture, with the keypoints to draw over it. */
  take(picture) {
    this.cards[picture.camera]?.take(picture);
  }

  /** Draws all new pictures together, as a browser composes the page after each. */
  draw() {
    for (const card of this.cards) {
      if (!card.isDrawn) card.draw(this.hasKeypoints);
    }
  }

  card(name) {
    return this.cards.find((card) => card.name === name);
  }

  /** Marks the camera through which the scene is viewed. */
  choose(name) {
    for (const card of this.cards) {
      card.button.setAttribute('aria-pressed', String(card.name === name));
    }
  }

  /** Draws a camera's picture with its overlays behind the scene. @return whether there is one. */
  drawBehind(name, canvas, box) {
    const card = this.card(name);
    canvas.hidden = !box || !card?.bitmap;
    if (canvas.hidden) return false;
    const context = fitCanvas(canvas);
    context.drawImage(card.bitmap, box.left, box.top, box.width, box.height);
    const scale = box.width / card.picture.widthPx;
    context.save();
    context.translate(box.left, box.top);
    context.scale(scale, box.height / card.picture.heightPx);
    drawTrimap(context, card.picture, scale);
    if (this.hasKeypoints) drawKeypoints(context, card.picture, scale);
    context.restore();
    return true;
  }
}

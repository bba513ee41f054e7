import assert from 'node:assert/strict';
import test from 'node:test';

import {decodeAll, decodeKeypoints, decodePicture, decodePose, decodeSeen, decodeVoxels, kindOf, splitLines} from '../../../../tools/view/page/wire.js';

function poseBytes({person = 0, id = 0, capsules = 2, frame = 7, rival = 0} = {}) {
  const buffer = new ArrayBuffer(392 + 32 * capsules + (rival > 0 ? 276 : 0));
  const view = new DataView(buffer);
  [1, person, 2, 1].forEach((value, i) => view.setUint8(i, value));
  view.setUint16(4, 23, true);
  view.setUint16(6, capsules, true);
  [1.7e12 + 0.25, 1.7e12 + 20, frame].forEach(
      (value, i) => view.setFloat64(8 + 8 * i, value, true));
  view.setFloat32(32, 9.5, true);
  view.setUint32(36, 4200, true);
  for (let i = 0; i < 69; ++i) view.setFloat32(40 + 4 * i, i, true);
  for (let i = 0; i < 8 * capsules; ++i) view.setFloat32(316 + 4 * i, 100 + i, true);
  const idAt = 316 + 32 * capsules;
  view.setUint32(idAt, id, true);
  view.setFloat32(idAt + 4, 0.75, true);
  view.setFloat32(idAt + 8, rival, true);
  for (let i = 0; rival > 0 && i < 69; ++i) view.setFloat32(idAt + 12 + 4 * i, 200 + i, true);
  for (let i = 0; i < 16; ++i) view.setFloat32(buffer.byteLength - 64 + 4 * i, 300 + i, true);
  return buffer;
}

function pictureBytes({camera = 0, trimap = [], body = [], jpeg = [0xff, 0xd8]} = {}) {
  const length = 32 + 4 * (trimap.length + body.length) + jpeg.length;
  const buffer = new ArrayBuffer(8 * Math.ceil(length / 8));
  const view = new DataView(buffer);
  view.setUint8(0, 3);
  view.setUint8(1, camera);
  view.setUint16(2, 640, true);
  view.setUint16(4, 480, true);
  view.setFloat64(8, 1234.5, true);
  view.setUint32(16, trimap.length, true);
  view.setUint32(20, body.length, true);
  view.setUint32(24, jpeg.length, true);
  view.setFloat32(28, 0.5, true);
  [...trimap, ...body].forEach((value, i) => view.setFloat32(32 + 4 * i, value, true));
  new Uint8Array(buffer).set(jpeg, 32 + 4 * (trimap.length + body.length));
  return buffer;
}

function joined(...buffers) {
  return new Uint8Array(buffers.flatMap((buffer) => [...new Uint8Array(buffer)])).buffer;
}

test('a pose is read field by field', () => {
  const pose = decodePose(poseBytes({person: 3, id: 300}));
  assert.equal(pose.person, 3);
  assert.equal(pose.id, 300);
  assert.equal(pose.state, 'tracking');
  assert.equal(pose.hasPose, true);
  assert.equal(pose.timeMs, 1.7e12 + 0.25);
  assert.equal(pose.publishMs, 1.7e12 + 20);
  assert.equal(pose.frame, 7);
  assert.equal(pose.residualMm, 9.5);
  assert.equal(pose.voxels, 4200);
  assert.deepEqual([...pose.points.slice(66)], [66, 67, 68]);
  assert.deepEqual([...pose.capsules.slice(0, 2)], [100, 101]);
  assert.equal(pose.capsules.length, 16);
  assert.equal(pose.probability, 0.75);
  assert.equal(pose.rival, null);
  assert.deepEqual([...pose.contacts.slice(12)], [312, 313, 314, 315]);
});

test('a rival is read with its points', () => {
  const {rival} = decodePose(poseBytes({rival: 0.25}));
  assert.equal(rival.probability, 0.25);
  assert.equal(rival.points.length, 69);
  assert.deepEqual([...rival.points.slice(66)], [266, 267, 268]);
  assert.equal(decodePose(poseBytes({rival: 0.25})).contacts[0], 300);
});

test('poses that stand one after the other are told apart by their capsules and rivals', () => {
  const buffer =
      joined(poseBytes({capsules: 0, frame: 1, rival: 0.5}), poseBytes({capsules: 3, frame: 2}));
  assert.deepEqual(decodeAll(buffer, decodePose).map((pose) => pose.frame), [1, 2]);
});

test('a message that is cut off is a RangeError, wherever it is cut', () => {
  const whole = poseBytes({rival: 0.25});
  for (let end = 0; end < whole.byteLength; end += 7) {
    assert.throws(() => decodePose(whole.slice(0, end)), RangeError);
  }
  assert.throws(
      () => decodePicture(pictureBytes({jpeg: new Array(100).fill(1)}).slice(0, 64)), RangeError);
  assert.throws(() => decodeVoxels(new ArrayBuffer(31)), RangeError);
});

test('counts that promise more than there is are refused', () => {
  const buffer = new ArrayBuffer(40);
  new DataView(buffer).setUint32(4, 0xffffffff, true);
  assert.throws(() => decodeVoxels(buffer), RangeError);
});

test('voxels keep their cells, and none is 65535', () => {
  const buffer = new ArrayBuffer(32 + 16);
  const view = new DataView(buffer);
  view.setUint8(0, 2);
  view.setUint32(4, 2, true);
  view.setFloat32(16, 30, true);
  [-500, 250, 0].forEach((value, i) => view.setFloat32(20 + 4 * i, value, true));
  [1, 2, 3, 9, 4, 5, 6, -1].forEach((value, i) => view.setInt16(32 + 2 * i, value, true));
  const voxels = decodeVoxels(buffer);
  assert.equal(voxels.sizeMm, 30);
  assert.deepEqual(voxels.originMm, [-500, 250, 0]);
  assert.deepEqual([...voxels.cells], [1, 2, 3, 9, 4, 5, 6, 65535]);
});

test('pictures that stand one after the other are found behind their padding', () => {
  const buffer = joined(
      pictureBytes({
        camera: 4,
        trimap: [3, 0, 1, 2, 3, 4, 5, 6, 1, 1, 11, 12],
        body: [2, 1, 7, 8, 9, 10],
        jpeg: [1, 2, 3]
      }),
      pictureBytes({camera: 5}));
  const [first, second] = decodeAll(buffer, decodePicture);
  assert.equal(first.widthPx, 640);
  assert.equal(first.unknownShare, 0.5);
  assert.equal(first.timeMs, 1234.5);
  assert.deepEqual(first.silhouette.map((line) => [...line.points]), [[1, 2, 3, 4, 5, 6]]);
  assert.deepEqual(first.unknown.map((line) => [...line.points]), [[11, 12]]);
  assert.equal(first.body[0].side, 1);
  assert.deepEqual([...first.jpeg], [1, 2, 3]);
  assert.equal(second.camera, 5);
});

function keypointBytes({camera = 0, person = 0, points = [9, 1, 2, 0.5]} = {}) {
  const buffer = new ArrayBuffer(16 + 4 * points.length);
  const view = new DataView(buffer);
  view.setUint8(0, 4);
  view.setUint8(1, camera);
  view.setUint16(2, points.length / 4, true);
  view.setUint32(4, person, true);
  view.setFloat64(8, 1234.5, true);
  points.forEach((value, i) => view.setFloat32(16 + 4 * i, value, true));
  return buffer;
}

test('keypoints are read view by view, and between the pictures of a take', () => {
  const first = keypointBytes({camera: 3, person: 300, points: [9, 1, 2, 0.5, 10, 3, 4, 1]});
  const views = decodeAll(joined(first, keypointBytes()), decodeKeypoints);
  assert.equal(views[0].camera, 3);
  assert.equal(views[0].person, 300);
  assert.equal(views[0].timeMs, 1234.5);
  assert.deepEqual([...views[0].points], [9, 1, 2, 0.5, 10, 3, 4, 1]);
  assert.deepEqual([...views[1].points], [9, 1, 2, 0.5]);
  const seen = decodeAll(joined(pictureBytes(), first, pictureBytes()), decodeSeen);
  assert.deepEqual(seen.map(({kind}) => kind), [3, 4, 3]);
  for (let end = 0; end < first.byteLength; ++end)
    assert.throws(() => decodeKeypoints(first.slice(0, end)), RangeError);
});

test('a line tells a side, and whose it is of several people', () => {
  const [alone, left] = splitLines(new Float32Array([1, 2, 0, 0, 1, 4 * 3 + 1, 0, 0]));
  assert.deepEqual([alone.side, alone.person], [2, null]);
  assert.deepEqual([left.side, left.person], [1, 2]);
});

test('lines that are cut off, or have no points, end the list', () => {
  assert.equal(splitLines(new Float32Array([2, 0, 1, 1, 2, 2, 9, 0, 1])).length, 1);
  assert.equal(splitLines(new Float32Array([0, 0, 0, 0])).length, 0);
  assert.equal(splitLines(new Float32Array([NaN, 0, 0, 0])).length, 0);
});

test('an empty message is of no kind', () => {
  assert.equal(kindOf(new ArrayBuffer(0)), 0);
  assert.equal(kindOf(poseBytes()), 1);
});

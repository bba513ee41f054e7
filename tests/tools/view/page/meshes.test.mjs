import './fake_page.mjs';
import './three_of_debian.mjs';

import assert from 'node:assert/strict';
import test from 'node:test';

const page = '../../../../tools/view/page/';
const {CapsuleMesh} = await import(`${page}capsule_mesh.js`);
const {VoxelMesh} = await import(`${page}voxel_mesh.js`);
const {Figure} = await import(`${page}figure.js`);
const {CameraModels} = await import(`${page}camera_models.js`);

// A light ground, as pale bodies are mixed with it.
globalThis.getComputedStyle = () =>
    ({getPropertyValue: (name) => name === '--ground' ? '#ffffff' : '#204080'});

const MODEL = {
  point_names: ['torso', 'fingertips_l', 'foot_r'],
  bones: [[0, 1], [0, 2]]
};

function poseAt(timeMs, {capsules = 1, hasPose = true} = {}) {
  return {
    timeMs,
    frame: timeMs,
    hasPose,
    points: Float32Array.from([0, 0, 1000, timeMs, 0, 1200, 0, 100, 50]),
    capsules: new Float32Array(8 * capsules).fill(1),
    contacts: new Float32Array(16).fill(NaN),
  };
}

function figureOf(options = {}) {
  const figure = new Figure({color: 'figure-0', ...options});
  figure.setModel(MODEL);
  return figure;
}

test('a capsule with an unknown place is left out, as are those beyond the capacity', () => {
  const mesh = new CapsuleMesh(2);
  mesh.add(NaN, 0, 0, 5, 1, 1, 1, 5, [1, 0, 0]);
  mesh.commit();
  assert.equal(mesh.visible, false);
  for (const x of [1, 2, 3]) mesh.add(x, 0, 0, 5, x, 1, 1, 5, [1, 0, 0]);
  mesh.commit();
  assert.equal(mesh.geometry.maxInstancedCount, 2);
  assert.deepEqual([...mesh.lastStarts(2)], [1, 0, 0, 2, 0, 0]);
});

test('the drawn pose is read from what is drawn', () => {
  const figure = figureOf();
  figure.show(poseAt(500));
  assert.deepEqual(figure.drawnPose().points, poseAt(500).points);
  figure.show(null);
  assert.equal(figure.drawnPose(), null);
  figure.show(poseAt(500, {hasPose: false}));
  assert.equal(figure.visible, false);
});

test('a foot that touches the floor has a dot under it', () => {
  const figure = figureOf();
  figure.show(poseAt(500));
  assert.equal(figure.contacts.visible, false);
  const contacts =
      Float32Array.from([10, 20, 5, 0.9, 30, 40, 5, 0.2, 50, 60, 5, 0.5, 0, 0, 0, NaN]);
  figure.show({...poseAt(500), contacts});
  assert.deepEqual([...figure.contacts.lastStarts(2)], [10, 20, 0, 50, 60, 0]);
  assert.equal(figure.contacts.visible, true);
  figure.setLayer('joints', false);
  figure.show({...poseAt(500), contacts});
  assert.equal(figure.contacts.visible, false);
});

test('a foot goes from its place over its heel to its toe', () => {
  const figure = figureOf();
  figure.show(poseAt(500));
  const without = [figure.sticks.count, figure.body.count];
  const contacts = new Float32Array(16).fill(NaN);
  contacts.set([30, 40, 5, 0.9], 4);
  contacts.set([70, 80, 5, 0.9], 12);
  figure.show({...poseAt(500), contacts});
  assert.deepEqual([figure.sticks.count, figure.body.count], [without[0] + 3, without[1] + 1]);
  const sticks = [...figure.sticks.lastStarts(3 + 3)].slice(0, 9);
  assert.deepEqual(sticks, [0, 100, 50, 30, 40, 5, 70, 80, 5]);
});

test('a pose in doubt is pale, and its rival is dashed', () => {
  const figure = figureOf();
  const doubtful = {
    ...poseAt(500),
    probability: 0.6,
    rival: {probability: 0.3, points: Float32Array.from([0, 0, 1000, 0, 500, 1200, 0, 100, 50])}
  };
  const tintOf = (mesh) => [...mesh.geometry.attributes.tint.array.slice(0, 3)];
  figure.show(poseAt(500));
  const usual = tintOf(figure.body);
  assert.equal(figure.body.material.uniforms.opacity.value, 1);
  assert.equal(figure.rival.visible, false);
  figure.show(doubtful);
  tintOf(figure.body).forEach((value, i) => assert.ok(value > usual[i] + 0.1, 'not paler'));
  assert.ok(figure.body.material.uniforms.opacity.value < 1);
  assert.ok(figure.rival.count > 10, `${figure.rival.count} dashes`);
  assert.equal(figure.rival.visible, true);
  assert.deepEqual(tintOf(figure.rival), usual);
  figure.show({...doubtful, probability: 0.97});
  assert.deepEqual(tintOf(figure.body), usual);
  assert.equal(figure.rival.visible, false);
});

test('a rival of more dashes than ever gets its room', () => {
  const figure = figureOf();
  const points = Float32Array.from([0, 0, 0, 20000, 0, 0, 0, 0, 0]);
  figure.show({...poseAt(500), probability: 0.6, rival: {probability: 0.3, points}});
  assert.ok(figure.rival.count > 200);
  assert.equal(Math.max(...figure.rival.geometry.attributes.b.array), 20000);
});

test('a body of more capsules than ever gets its room', () => {
  const figure = figureOf();
  figure.show(poseAt(0, {capsules: 200}));
  assert.equal(figure.body.count, 200);
});

test('layers are hidden one by one, and a body that is hidden has no shadow', () => {
  const figure = figureOf();
  figure.setLayer('body', false);
  figure.show(poseAt(0));
  assert.equal(figure.body.visible, false);
  assert.equal(figure.shadow.visible, false);
  assert.equal(figure.sticks.visible, true);
  figure.setLayer('body', true);
  figure.setShadow(false);
  figure.show(poseAt(0));
  assert.equal(figure.body.visible, true);
  assert.equal(figure.shadow.visible, false);
});

test('an old pose is drawn pale', () => {
  const figure = figureOf();
  figure.show(poseAt(0), {faded: true});
  assert.ok(figure.body.material.uniforms.opacity.value < 0.5);
  assert.equal(figure.body.material.depthWrite, false);
});

test('a trail keeps its corners while its head moves on', () => {
  const figure = figureOf();
  figure.show(poseAt(3000));
  const cornersAt = (timeMs) => {
    figure.showTrails(timeMs, poseAt);
    const {array} = figure.trails.geometry.attributes.a;
    return Array.from({length: figure.trails.count}, (_, i) => array[4 * i]).filter((x) => x > 0);
  };
  const before = new Set(cornersAt(3000));
  const kept = cornersAt(3010).filter((x) => before.has(x));
  assert.ok(before.size >= 59, `${before.size}`);
  assert.ok(kept.length >= before.size - 1);
});

test('a trail ends where the person was not seen', () => {
  const figure = figureOf();
  figure.show(poseAt(3000));
  figure.showTrails(3000, (t) => poseAt(t, {hasPose: t < 2000 || t > 2500}));
  const {array} = figure.trails.geometry.attributes.b;
  for (let i = 0; i < figure.trails.count; ++i) {
    assert.ok(!(array[4 * i] >= 2000 && array[4 * i] <= 2500));
  }
});

test('voxels move with their part from their own time to the shown one', () => {
  const voxels = new VoxelMesh();
  voxels.take({count: 1, cells: new Uint16Array(4), originMm: [0, 0, 0], sizeMm: 25, timeMs: 1000});
  const then = {hasPose: true, points: new Float32Array(30)};
  const now = {hasPose: true, points: new Float32Array(30).fill(7)};
  now.points[3 * 4] = NaN;
  voxels.place(1100, then, now);
  const {value: moved} = voxels.material.uniforms.moved;
  assert.ok(voxels.visible);
  assert.deepEqual(moved[2].toArray(), [7, 7, 7]);
  assert.deepEqual(moved[4].toArray(), [0, 0, 0], 'a part of unknown place stays');
  voxels.place(1100, null, now);
  assert.deepEqual(moved[2].toArray(), [0, 0, 0], 'without a pose of their time they stay');
});

test('voxels that are too old are not shown', () => {
  const voxels = new VoxelMesh();
  voxels.take({count: 1, cells: new Uint16Array(4), originMm: [0, 0, 0], sizeMm: 25, timeMs: 1000});
  voxels.place(1999, null, null);
  assert.ok(voxels.visible);
  voxels.place(2001, null, null);
  assert.ok(!voxels.visible);
});

test('voxels need memory for the most that came', () => {
  const voxels = new VoxelMesh();
  for (const count of [10, 3, 500]) {
    const cells = new Uint16Array(4 * count).fill(count);
    voxels.take({count, cells, originMm: [0, 0, 0], sizeMm: 25, timeMs: 0});
    assert.equal(voxels.geometry.drawRange.count, count);
    assert.equal(voxels.geometry.attributes.cell.array[4 * count - 1], count);
  }
});

test('cameras are coloured by state; one of an unknown state is grey', () => {
  const models = new CameraModels();
  models.setCameras(['a', 'b'].map((name) => ({
                                     name,
                                     position_mm: [0, 0, 2000],
                                     rotation: [1, 0, 0, 0, 1, 0, 0, 0, 1],
                                     corners_mm: new Array(4).fill([100, 100, 100]),
                                   })));
  models.setLooks(new Map([['a', 'lost']]));
  assert.equal(models.lookOf('a').color, 'bad');
  assert.equal(models.lookOf('b').color, 'muted');
  const both = models.mesh.count;
  models.hide('a');
  assert.equal(models.mesh.count, both / 2, 'nobody sees the camera he looks through');
});

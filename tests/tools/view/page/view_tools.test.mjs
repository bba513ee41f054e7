import assert from 'node:assert/strict';
import test from 'node:test';

import {freshElement} from './fake_page.mjs';

const {ViewTools} = await import('../../../../tools/view/page/view_tools.js');

function figureAt(point, {visible = true, apart = 0} = {}) {
  return {
    visible,
    shown: {points: point},
    position: {getComponent: (axis) => axis === 0 ? apart : 0},
  };
}

function open(figures = []) {
  for (const id of ['layers', 'view-from', 'stage']) freshElement(id);
  const scene = {
    through: null,
    seeThrough: (name) => scene.through = name,
    setCameras() {},
    figures: new Map(figures.entries()),
    orbit: {
      target: [0, 0, 900],
      distance: 7000,
      zoom: (factor) => scene.orbit.distance *= factor,
    },
  };
  const chosen = [];
  const pictures = {setCameras() {}, choose: (name) => chosen.push(name)};
  const tools = new ViewTools(scene, pictures);
  tools.setCameras([{name: 'front'}, {name: 'left'}]);
  return {tools, scene, chosen};
}

test('a camera chosen twice gives the free view again', () => {
  const {tools, scene, chosen} = open();
  for (const name of ['left', 'front', 'front']) tools.seeThrough(name);
  assert.equal(scene.through, null);
  assert.deepEqual(chosen, ['left', 'front', null]);
  assert.equal(document.getElementById('view-from').value, '');
});

test('the list has every camera, and tells the present one', () => {
  const {tools} = open();
  const list = document.getElementById('view-from');
  assert.deepEqual(
      list.all('option').map(({textContent}) => textContent),
      ['Free view', 'From front', 'From left']);
  tools.seeThrough('left');
  tools.setCameras([{name: 'front'}, {name: 'left'}]);
  assert.equal(list.value, 'left');
});

test('looking at people puts all that are shown in the middle, and farther away if apart', () => {
  const near = open([figureAt([1000, 0, 1000])]);
  near.tools.seeThrough('left');
  near.tools.lookAtPeople();
  assert.deepEqual(near.scene.orbit.target, [1000, 0, 1000]);
  assert.equal(near.scene.through, null);
  const apart = open([
    figureAt([1000, 0, 1000]), figureAt([1000, 0, 1000], {apart: 2000}),
    figureAt([9000, 0, 1000], {visible: false})
  ]);
  apart.tools.lookAtPeople();
  assert.deepEqual(apart.scene.orbit.target, [2000, 0, 1000]);
  assert.ok(apart.scene.orbit.distance > near.scene.orbit.distance + 2000);
});

test('with nobody there the view stays', () => {
  const {tools, scene} = open();
  tools.lookAtPeople();
  assert.equal(scene.orbit.distance, 7000);
});

test('without WebGL the page goes on', () => {
  const tools = new ViewTools(null, {setCameras() {}, choose() {}});
  tools.setCameras([{name: 'front'}]);
  tools.seeThrough('front');
  tools.lookAtPeople();
  tools.draw(0);
  assert.equal(tools.cameraColor('front'), null);
});

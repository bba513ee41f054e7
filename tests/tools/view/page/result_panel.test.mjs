import assert from 'node:assert/strict';
import test from 'node:test';

import {freshElement} from './fake_page.mjs';

const {ResultPanel} = await import('../../../../tools/view/page/result_panel.js');
const TRACKING = 2;
const LOST = 3;

function result(name, more = {}) {
  return {
    name,
    group: 0,
    person: '',
    states: [TRACKING, TRACKING, LOST],
    error_mm: [10, 20, null],
    residual_mm: [5, 6, null],
    probability: [1, null, null],
    joints: ['hand_l', 'hip_r'],
    joint_error_mm: [[30, 50, null], [1, 2, null]],
    ...more
  };
}

function open(results, truth = {
  people: ['']
}) {
  const page = {panel: freshElement('replay-panel'), legend: freshElement('legend')};
  const done = [];
  const tell = (name) => (...values) => done.push([name, ...values]);
  const panel = new ResultPanel(
      {results, truth}, {onShow: tell('show'), onOver: tell('over'), onApart: tell('apart')});
  return {panel, page, done};
}

/** @return what a result's row tells: [[name, value], ...]. */
function factsOf({element}) {
  const names = element.all('dt').map((one) => one.textContent);
  return names.map((name, i) => [name, element.all('dd')[i].textContent]);
}

function jointRows(page) {
  return page.panel.all('tbody')[0].all('tr').map(
      (row) => row.children.map((cell) => cell.textContent));
}

function change(input, isOn) {
  input.checked = isOn;
  input.dispatchEvent(new Event('change'));
}

test('a frame tells state, error and residual; none is a dash, not a zero', () => {
  const {panel} = open([result('a')]);
  panel.show(1, 2);
  assert.deepEqual(factsOf(panel.rows[0]), [
    ['State', 'tracking'], ['Error now', '20.0 mm'], ['Mean error', '15.0 mm'], ['Fit', '6.0 mm']
  ]);
  panel.show(2, 2);
  assert.deepEqual(
      factsOf(panel.rows[0]),
      [['State', 'lost'], ['Error now', '– mm'], ['Mean error', '15.0 mm'], ['Fit', '– mm']]);
});

test('a frame in doubt tells how sure its pose is', () => {
  const {panel} = open([result('a', {probability: [0.6, 0.97, null]})]);
  const states = [0, 1].map((frame) => {
    panel.show(frame, 2);
    return factsOf(panel.rows[0])[0][1];
  });
  assert.deepEqual(states, ['tracking, 60\u00a0%\u00a0sure', 'tracking']);
});

test('without truth there is no error and no table of joints', () => {
  const {panel, page} = open([result('a', {error_mm: [], joints: [], joint_error_mm: []})], null);
  panel.show(0, 2);
  assert.deepEqual(factsOf(panel.rows[0]), [['State', 'tracking'], ['Fit', '5.0 mm']]);
  assert.equal(page.panel.all('table').length, 0);
  assert.ok(page.legend.hidden);
});

test('two results are compared joint by joint, by name and not by place', () => {
  const other = {joints: ['hip_r'], joint_error_mm: [[4, 6, 8]], group: 1};
  const {page} = open([result('a'), result('b', other)]);
  assert.deepEqual(jointRows(page), [['hand left', '40.0', '–'], ['hip right', '1.5', '6.0']]);
  assert.deepEqual(page.legend.all('li').map((one) => one.textContent), ['a', 'b', 'truth']);
});

test('a joint that is chosen is marked and drawn', () => {
  const {panel, page} = open([result('a')]);
  const [hand, hip] = page.panel.all('button');
  assert.equal(hand.attributes['aria-pressed'], 'true');
  hip.dispatchEvent(new Event('click'));
  assert.equal(hand.attributes['aria-pressed'], 'false');
  assert.equal(hip.attributes['aria-pressed'], 'true');
  assert.equal(panel.canvas.attributes['aria-label'], 'hip right: error along the take [mm]');
});

test('of several people the first is shown in detail, another one or all by choice', () => {
  const people = ['person-1', 'person-2'].map((person) => result(person, {person}));
  people[1].joint_error_mm = [[7, 7, 7], [8, 8, 8]];
  const {page} = open(people, {people: ['x', 'y']});
  assert.deepEqual(jointRows(page)[0], ['hand left', '40.0']);
  const [list] = page.panel.all('select');
  for (const [value, row] of [['1', ['hand left', '7.0']], ['', ['hand left', '40.0', '7.0']]]) {
    list.value = value;
    list.dispatchEvent(new Event('change'));
    assert.deepEqual(jointRows(page)[0], row);
  }
});

test('of several people each tells who it truly is; a phantom is nobody', () => {
  const people = [result('p1', {person: 'p1', true_person: 1}), result('p2', {person: 'p2'})];
  const {panel} = open(people, {people: ['x', 'y']});
  assert.deepEqual(factsOf(panel.rows[0])[1], ['True person', 'y']);
  assert.deepEqual(factsOf(panel.rows[1])[1], ['True person', 'nobody']);
});

test('results and truth can be hidden, and set side by side', () => {
  const {panel, page, done} = open([result('a'), result('b', {group: 1})]);
  change(panel.rows[1].element.all('input')[0], false);
  const others = page.panel.children.slice(3).map((element) => element.all('input')[0]);
  change(others[0], false);
  change(others[1], true);
  assert.deepEqual(done, [['show', 1, false], ['show', 'truth', false], ['apart', true]]);
});

test('of two results one is drawn over the pictures; people of one result are together', () => {
  const radios = ({panel}) => panel.rows.map(
      ({element}) => element.all('input').filter((one) => one.attributes.type === 'radio').length);
  assert.deepEqual(radios(open([result('a'), result('b', {group: 1})])), [1, 1]);
  assert.deepEqual(
      radios(open([result('p1', {person: 'p1'}), result('p2', {person: 'p2'})])), [0, 0]);
});

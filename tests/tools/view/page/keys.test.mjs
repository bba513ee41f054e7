import assert from 'node:assert/strict';
import test from 'node:test';

import {FakeElement, freshElement} from './fake_page.mjs';

const {bindKeys, startKeys} = await import('../../../../tools/view/page/keys.js');
startKeys();

/** Presses a key. @return whether the page used it. */
function press(key, {on = new FakeElement('body'), ...more} = {}) {
  const event = Object.assign(new Event('keydown', {cancelable: true}), {key, ...more});
  Object.defineProperty(event, 'target', {value: on});
  document.dispatchEvent(event);
  return event.defaultPrevented;
}

function element(tag, type) {
  return Object.assign(new FakeElement(tag), {attributes: type ? {type} : {}});
}

test('a bound key acts, and another one is left to the browser', () => {
  const pressed = [];
  bindKeys(['q', 'Q'], ['Q'], 'asks', (key) => pressed.push(key));
  assert.ok(press('q'));
  assert.ok(press('Q'));
  assert.ok(!press('z'));
  assert.deepEqual(pressed, ['q', 'Q']);
});

test('the list has each binding once, with its keys', () => {
  const list = freshElement('key-list');
  bindKeys(['ArrowLeft', 'ArrowRight'], ['←', '→'], 'frame back or on', () => {});
  assert.deepEqual(list.all('kbd').map((key) => key.textContent), ['←', '→']);
  assert.equal(list.all('dd')[0].textContent, 'frame back or on');
});

test('keys with Ctrl, Alt or Meta are the browser\'s', () => {
  let count = 0;
  bindKeys(['r'], ['R'], 'counts', () => ++count);
  for (const modifier of ['ctrlKey', 'altKey', 'metaKey'])
    assert.ok(!press('r', {[modifier]: true}));
  assert.equal(count, 0);
});

test('who types, chooses or has a dialog open does not steer the page', () => {
  let count = 0;
  bindKeys(['x', ' ', 'ArrowLeft'], [], 'counts', () => ++count);
  const dialog = element('dialog');
  const inDialog = element('p');
  dialog.append(inDialog);
  for (const [key, on] of [
           ['x', element('input', 'text')], ['x', element('input')], ['x', element('textarea')],
           ['ArrowLeft', element('select')], ['x', inDialog], [' ', element('button')],
           [' ', element('input', 'checkbox')], ['ArrowLeft', element('input', 'radio')]]) {
    assert.ok(!press(key, {on}), `${key} on ${on.tag} ${on.attributes.type}`);
  }
  assert.equal(count, 0);
  for (const [key, on] of [
           ['x', element('input', 'checkbox')], ['x', element('button')],
           ['ArrowLeft', element('button')]]) {
    assert.ok(press(key, {on}), `${key} on ${on.tag}`);
  }
  assert.equal(count, 3);
});

test('an action may leave a key to the browser', () => {
  bindKeys(['y'], ['Y'], 'declines', () => false);
  assert.ok(!press('y'));
});

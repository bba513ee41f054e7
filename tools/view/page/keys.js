// Keys of the page, and their list, which "?" shows.

import {byId, make} from './dom.js';

const bindings = new Map();

/**
 * Binds keys to an action. @param keys as in KeyboardEvent.key; @param shown their text in the
 * list.
 */
export function bindKeys(keys, shown, text, action) {
  for (const key of keys) bindings.set(key, action);
  byId('key-list')
      .append(make('dt', {}, ...shown.map((key) => make('kbd', {text: key}))), make('dd', {text}));
}

// Keys that the focused element uses: typing, choosing, pressing.
function isTaken(event) {
  const target = event.target;
  if (!(target instanceof Element)) return false;
  if (target.closest('dialog')) return true;
  if (target.matches('input:not([type=checkbox]):not([type=radio]), textarea, select')) return true;
  if (event.key === ' ') return target.matches('button, summary, input');
  return target.matches('input[type=radio]') && event.key.startsWith('Arrow');
}

export function startKeys() {
  document.addEventListener('keydown', (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey || isTaken(event)) return;
    const action = bindings.get(event.key);
    if (!action || action(event.key, event) === false) return;
    event.preventDefault();
  });
}
